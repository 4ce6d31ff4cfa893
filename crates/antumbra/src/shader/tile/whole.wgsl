/// Texels of a view, which has a layer of its own.
fn tile_size(view: u32) -> vec2f {
    return shadow_size();
}

/// The layer in which a view lies.
fn tile_layer(view: u32) -> u32 {
    return view;
}

/// The texel of the texture that is a texel of a view, or the nearest to it that the view has.
fn tile_texel(view: u32, texel: vec2i) -> vec2i {
    return clamp(texel, vec2i(0), vec2i(shadow_size()) - 1);
}

/// Number of a view's texel among those of all layers.
fn tile_index(view: u32, texel: vec2u) -> u32 {
    let size = vec2u(shadow_size());
    return (view * size.y + texel.y) * size.x + texel.x;
}

/// Texture coordinates of a view's point, for lookups of up to four texels: they repeat the view's edge.
fn tile_uv(view: u32, uv: vec2f) -> vec2f {
    return uv;
}

/// The same where four texels meet. What lies beyond the view's edge is not the view's.
fn tile_corner(view: u32, uv: vec2f) -> vec2f {
    return uv;
}

/// Texels of a view at a mip level.
fn tile_level_size(view: u32, level: f32) -> vec2f {
    return vec2f(max(vec2u(shadow_size()) >> vec2u(u32(level)), vec2u(1u)));
}

/// Texture coordinates of a place in a view, in texels of a mip level.
fn tile_place(view: u32, place: vec2f, level: f32) -> vec2f {
    return place / tile_level_size(view, level);
}

/// The coarsest mip level of a view in a texture of so many.
fn tile_coarsest(view: u32, levels: u32) -> f32 {
    return f32(levels - 1u);
}
