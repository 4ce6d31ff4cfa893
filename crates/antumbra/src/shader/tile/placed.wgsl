/// Texels of a view.
fn tile_size(view: u32) -> vec2f {
    return shadow_place(view).zw;
}

/// The layer in which a view lies.
fn tile_layer(view: u32) -> u32 {
    return shadow_layer(view);
}

/// The texel of the texture that is a texel of a view, or the nearest to it that the view has.
fn tile_texel(view: u32, texel: vec2i) -> vec2i {
    let tile = vec4i(shadow_place(view));
    return tile.xy + clamp(texel, vec2i(0), tile.zw - 1);
}

/// Number of a view's texel among those of all layers.
fn tile_index(view: u32, texel: vec2u) -> u32 {
    let size = vec2u(shadow_size());
    let at = vec2u(shadow_place(view).xy) + texel;
    return (tile_layer(view) * size.y + at.y) * size.x + at.x;
}

/// Texture coordinates of a view's point, for lookups of up to four texels: half a texel inside, where they
/// repeat the view's edge.
fn tile_uv(view: u32, uv: vec2f) -> vec2f {
    let tile = shadow_place(view);
    return (tile.xy + clamp(uv * tile.zw, vec2f(0.5), tile.zw - 0.5)) / shadow_size();
}

/// The same where four texels meet. What lies beyond the view's edge is not the view's.
fn tile_corner(view: u32, uv: vec2f) -> vec2f {
    let tile = shadow_place(view);
    return (tile.xy + uv * tile.zw) / shadow_size();
}

/// Texels of a view at a mip level.
fn tile_level_size(view: u32, level: f32) -> vec2f {
    return vec2f(max(vec2u(shadow_place(view).zw) >> vec2u(u32(level)), vec2u(1u)));
}

/// Texture coordinates of a place in a view, in texels of a mip level. Views begin where texels of all of their
/// levels do.
fn tile_place(view: u32, place: vec2f, level: f32) -> vec2f {
    let shift = vec2u(u32(level));
    let origin = vec2f(vec2u(shadow_place(view).xy) >> shift);
    return (origin + place) / vec2f(max(vec2u(shadow_size()) >> shift, vec2u(1u)));
}

/// The coarsest mip level of a view in a texture of so many.
fn tile_coarsest(view: u32, levels: u32) -> f32 {
    let size = vec2u(shadow_place(view).zw);
    return f32(min(levels - 1u, firstLeadingBit(max(size.x, size.y))));
}
