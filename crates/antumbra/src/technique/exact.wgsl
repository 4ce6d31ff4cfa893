//! needs ray

/// Corner `k` of triangle `n`.
fn exact_corner(corners: texture_2d_array<f32>, n: u32, view: u32, k: u32) -> vec3f {
    return textureLoad(corners, vec2u(n % 2048u, n / 2048u), 3u * view + k, 0).xyz;
}

/// Whether triangle `n` has no hole where the ray meets it. Its corners lie around the ray. // cut-outs
fn exact_stops(corners: texture_2d_array<f32>, n: u32, view: u32, a: vec3f, b: vec3f, c: vec3f) -> bool { // cut-outs
    let at = vec2u(n % 2048u, n / 2048u); // cut-outs
    if textureLoad(corners, at, 3u * view, 0).w == 0.0 { // cut-outs
        return true; // cut-outs
    } // cut-outs
    let record = at + vec2u(0u, textureDimensions(corners).y / 2u); // cut-outs
    let with_a = textureLoad(corners, record, 3u * view, 0); // cut-outs
    let with_b = textureLoad(corners, record, 3u * view + 1u, 0); // cut-outs
    return shadow_stops(a, b, c, with_a, with_b, textureLoad(corners, record, 3u * view + 2u, 0)); // cut-outs
} // cut-outs

/// 0 if any triangle of the list of the receiver's texel is between it and the light, else 1. `depth` is
/// projected depth, in which triangles are planes under any light.
fn exact_visibility(ranges: texture_2d_array<u32>, numbers: texture_2d_array<u32>, corners: texture_2d_array<f32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = textureDimensions(ranges);
    let point = uv * vec2f(size);
    let texel = min(vec2u(max(point, vec2f(0.0))), size - 1u);
    let end = textureLoad(ranges, texel, 2u * view + 1u, 0).x;
    let layers = textureNumLayers(numbers) / (textureNumLayers(ranges) / 2u);
    for (var i = textureLoad(ranges, texel, 2u * view, 0).x; i < end; i += 1u) {
        let row = i / 2048u;
        let n = textureLoad(numbers, vec2u(i % 2048u, row % 2048u), layers * view + row / 2048u, 0).x;
        let ray = vec3f(point, 0.0);
        let a = exact_corner(corners, n, view, 0u) - ray;
        let b = exact_corner(corners, n, view, 1u) - ray;
        let c = exact_corner(corners, n, view, 2u) - ray;
        if ray_depth(a, b, c) < depth {
            if !exact_stops(corners, n, view, a, b, c) { continue; } // cut-outs
            return 0.0;
        }
    }
    return 1.0;
}
