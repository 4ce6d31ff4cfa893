@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(1) var base_color: texture_2d<f32>;
@group(2) @binding(2) var base_sampler: sampler;
@group(3) @binding(0) var<storage, read> attributes: array<f32>;

/// Texture coordinates and alpha of a vertex: normal, texture coordinates and colour are nine floats.
fn cutout_attributes(vertex: u32) -> vec3f {
    return vec3f(attributes[9u * vertex + 3u], attributes[9u * vertex + 4u], attributes[9u * vertex + 8u]);
}

/// What `shadow_covers` hears of the triangle: its mask.
fn caster_tag(triangle: u32) -> u32 {
    return material.mask;
}

fn caster_covers(triangle: u32, weights: vec3f) -> bool {
    let corners = mat3x3f(
        cutout_attributes(caster_vertex(triangle, 0u)),
        cutout_attributes(caster_vertex(triangle, 1u)),
        cutout_attributes(caster_vertex(triangle, 2u)),
    );
    let at = corners * weights;
    return material.base_color.a * at.z * textureSampleLevel(base_color, base_sampler, at.xy, 0.0).a >= material.cutoff;
}
