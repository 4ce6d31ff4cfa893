@group(0) @binding(0) var visibility: texture_2d<f32>;
@group(0) @binding(1) var sun: texture_2d<f32>;
@group(0) @binding(2) var rest: texture_2d<f32>;

@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// Filmic curve (Hable's shoulder, fitted by Narkowicz 2015).
fn tone(c: vec3f) -> vec3f {
    return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), vec3f(0.0), vec3f(1.0));
}

@fragment fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let lit = textureLoad(visibility, pixel, 0).x;
    return vec4f(tone(lit * textureLoad(sun, pixel, 0).rgb + textureLoad(rest, pixel, 0).rgb), 1.0);
}
