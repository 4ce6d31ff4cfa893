//! needs uphill tile

/// Samples along one side of a texel.
const stratified_grid: u32 = 2;
/// 1 where each pass samples at a place of its own within its cell, 0 where all sample in the middle.
const stratified_random: u32 = 0;

/// The depth of one caster pass, which goes to one channel.
fn stratified_encode(depth: f32, layer: u32) -> vec4f {
    return vec4f(depth);
}

/// How far sample k lies from the middle of its cell, in cells.
fn stratified_jitter(k: u32) -> vec2f {
    if (stratified_random == 0u) {
        return vec2f(0.0);
    }
    let state = k * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    let hash = (word >> 22u) ^ word;
    return vec2f(f32(hash & 0xffffu), f32(hash >> 16u)) / 65536.0 - 0.5;
}

/// Share of the n×n depths in the texel of uv that the receiver is not behind, each compared where it
/// was sampled: sample k lies in the cell of column k mod n and row k / n of the texel. One fetch per four samples.
fn stratified_visibility(samples: texture_2d_array<f32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    const COUNT = stratified_grid * stratified_grid;
    const LAYERS = (COUNT + 3u) / 4u;
    let size = tile_size(view);
    let texel = clamp(floor(uv * size), vec2f(0.0), size - 1.0);
    let n = f32(stratified_grid);
    // To the texel's corner, and from each sample to the next.
    let corner = texel / size - uv;
    let step = 1.0 / (n * size);
    let lean = uphill_lean(view);
    var lit = 0.0;
    for (var layer = 0u; layer < LAYERS; layer += 1u) {
        let four = textureLoad(samples, tile_texel(view, vec2i(texel)), tile_layer(view) * LAYERS + layer, 0);
        for (var channel = 0u; channel < 4u; channel += 1u) {
            let k = 4u * layer + channel;
            let cell = vec2f(f32(k % stratified_grid), f32(k / stratified_grid)) + 0.5;
            let sample = corner + (cell + stratified_jitter(k)) * step;
            lit += select(0.0, 1.0, k < COUNT && uphill_depth(depth, plane, lean, sample) <= four[channel]);
        }
    }
    // Some divisions round n / n up.
    return min(lit / f32(COUNT), 1.0);
}
