@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var relative: texture_2d<f32>;
@group(0) @binding(2) var facet: texture_2d<f32>;

@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// Where the plane through `at` with normal `n` is met by a ray from the eye, minus `at`. A plane
/// seen nearly edge-on is taken to be met no more than 32 times as far away.
fn neighbour(at: vec3f, n: vec3f, ray: vec3f, own_ray: vec3f) -> vec3f {
    let own = dot(n, own_ray);
    let rise = select(max(dot(n, ray), own / 32.0), min(dot(n, ray), own / 32.0), own < 0.0);
    return ray * (dot(n, at) / rise) - at;
}

@fragment fn fragment(@builtin(position) position: vec4f) -> @location(0) f32 {
    let pixel = vec2i(position.xy);
    let at = textureLoad(relative, pixel, 0);
    if at.w == 0.0 {
        return nothing;
    }
    let n = textureLoad(facet, pixel, 0).xyz;
    let ray = frame.ray.xyz + frame.ray_right.xyz * position.x + frame.ray_down.xyz * position.y;
    let ddx = neighbour(at.xyz, n, ray + frame.ray_right.xyz, ray);
    let ddy = neighbour(at.xyz, n, ray + frame.ray_down.xyz, ray);
    return answer(frame.eye.xyz + at.xyz, n, ddx, ddy);
}
