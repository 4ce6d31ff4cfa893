
/// The last texel of the view at the level that is read, which has `size` texels. A tile begins where texels of all of its levels
/// do.
fn mips_last(size: vec2u) -> vec2i {
    let finest = vec2u(blur.size);
    let shift = vec2u(firstLeadingBit(max(finest.x, finest.y)) - firstLeadingBit(max(size.x, size.y)));
    let tile = vec4u(blur.tile);
    return vec2i((tile.xy >> shift) + max(tile.zw >> shift, vec2u(1u))) - 1;
}

