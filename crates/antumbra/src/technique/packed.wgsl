//! needs uphill tile

/// Phases along one side: one for a footprint of 2×2 texels, two for one of 4×4.
const packed_phases: u32 = 1;
/// 1 for phases and their mean in 8 bits, as in the paper's frame buffer.
const packed_in_bytes: u32 = 0;

/// The 3×3 colour convolution of Brabec & Seidel 2001, §4: red from the lower left neighbour, green from
/// the lower middle, blue from the left, alpha from the texel itself. y points down, so lower is + 1.
fn packed_encode(depths: mat3x3f, layer: u32) -> vec4f {
    return vec4f(depths[0][2], depths[1][2], depths[0][1], depths[1][1]);
}

/// What the four depths that the receiver is behind, whose middle lies at `offset` from it, add up to: their share, or
/// in 8 bits 64 each and 63 in alpha, so that all of them make 255 [footnote 2].
fn packed_shadow(four: vec4f, depth: f32, plane: vec2f, lean: vec2f, offset: vec2f, half_texel: vec2f) -> f32 {
    // Lower left, lower right, upper left, upper right.
    let references = vec4f(
        uphill_depth(depth, plane, lean, offset + half_texel * vec2f(-1.0, 1.0)),
        uphill_depth(depth, plane, lean, offset + half_texel),
        uphill_depth(depth, plane, lean, offset - half_texel),
        uphill_depth(depth, plane, lean, offset + half_texel * vec2f(1.0, -1.0)),
    );
    let weights = select(vec4f(0.25), vec4f(64.0, 64.0, 64.0, 63.0), packed_in_bytes == 1u);
    return dot(select(weights, vec4f(0.0), references <= four), vec4f(1.0));
}

/// What an accumulation buffer gives back to a frame buffer of 8 bits, as a share of 255.
fn packed_returned(mean: f32) -> f32 {
    return floor(mean + 0.5) / 255.0;
}

/// Mean of comparisons with the 2×2 or 4×4 texels around the corner that is nearest to uv: one fetch of
/// four depths per phase. A texel's four surround its lower left corner, half a texel away, so the
/// lookup is half a texel up and right [figure 6].
fn packed_visibility(packed: texture_2d_array<f32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let texel = 1.0 / tile_size(view);
    let middle = floor(uv / texel + vec2f(0.5, -0.5));
    let lean = uphill_lean(view);
    var sum = 0.0;
    for (var row = 0u; row < packed_phases; row += 1u) {
        for (var column = 0u; column < packed_phases; column += 1u) {
            let phase = middle + 2.0 * vec2f(f32(column), f32(row)) - f32(packed_phases - 1u);
            let four = textureLoad(packed, tile_texel(view, vec2i(phase)), tile_layer(view), 0);
            let offset = (phase + vec2f(0.0, 1.0)) * texel - uv;
            sum += packed_shadow(four, depth, plane, lean, offset, 0.5 * texel);
        }
    }
    let mean = sum / f32(packed_phases * packed_phases);
    // Some divisions round 255 / 255 up.
    return 1.0 - min(select(mean, packed_returned(mean), packed_in_bytes == 1u), 1.0);
}
