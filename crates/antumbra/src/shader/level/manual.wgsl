/// The four texels around uv at mip level `level`, with bilinear weights: for formats that the
/// device cannot filter.
fn level_bilinear(map: texture_2d_array<f32>, uv: vec2f, layer: u32, level: u32) -> vec4f {
    let size = vec2i(textureDimensions(map, level));
    let p = uv * vec2f(size) - 0.5;
    let corner = vec2i(floor(p));
    let weight = p - floor(p);
    let low = clamp(corner, vec2i(0), size - 1);
    let high = clamp(corner + 1, vec2i(0), size - 1);
    let top = mix(
        textureLoad(map, low, layer, level),
        textureLoad(map, vec2i(high.x, low.y), layer, level),
        weight.x,
    );
    let bottom = mix(
        textureLoad(map, vec2i(low.x, high.y), layer, level),
        textureLoad(map, high, layer, level),
        weight.x,
    );
    return mix(top, bottom, weight.y);
}

/// One bilinear lookup at a whole mip level, or between two, in the shader.
fn level_filtered(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, layer: u32, level: f32) -> vec4f {
    let last = f32(textureNumLevels(map) - 1u);
    let l = clamp(level, 0.0, last);
    let fine = level_bilinear(map, uv, layer, u32(floor(l)));
    let coarse = level_bilinear(map, uv, layer, u32(ceil(l)));
    return mix(fine, coarse, l - floor(l));
}
