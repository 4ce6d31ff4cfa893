@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var nearest: sampler;

@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(source)) - 1;
    let low = min(2 * vec2i(position.xy), last);
    let high = min(low + 1, last);
    return 0.25 * (textureLoad(source, low, 0) + textureLoad(source, vec2i(high.x, low.y), 0)
        + textureLoad(source, vec2i(low.x, high.y), 0) + textureLoad(source, high, 0));
}
