/// Rust side: `Mask` in `masks.rs`.
struct Mask {
    /// Of its first alpha among those of all images.
    start: u32,
    width: u32,
    height: u32,
    /// 1 where the image repeats along u, 2 along v.
    repeats: u32,
    /// What the image's alpha is multiplied with.
    alpha: f32,
    cutoff: f32,
    /// Number of the scene's first masked triangle.
    first: u32,
}
@group(2) @binding(0) var<storage, read> masks: array<Mask>;
/// Four in each word.
@group(2) @binding(1) var<storage, read> mask_alphas: array<u32>;
/// Texture coordinates and alpha of the corners of masked triangles.
@group(2) @binding(2) var<storage, read> mask_corners: array<vec3f>;

/// The two texels that are read along one axis, and the weight of the second: as `Image::alpha_linear` has it.
fn mask_taps(coordinate: f32, size: u32, repeats: bool) -> vec3f {
    let place = coordinate * f32(size) - 0.5;
    let texels = vec2f(floor(place), floor(place) + 1.0);
    let wrapped = select(texels, texels - f32(size) * floor(texels / f32(size)), repeats);
    return vec3f(clamp(wrapped, vec2f(0.0), vec2f(f32(size - 1u))), place - texels.x);
}

/// Alpha of an image's texel, 0 to 1.
fn mask_texel(mask: Mask, x: f32, y: f32) -> f32 {
    let i = mask.start + u32(y) * mask.width + u32(x);
    return f32((mask_alphas[i / 4u] >> (8u * (i % 4u))) & 255u) / 255.0;
}

fn shadow_covers(material: u32, triangle: u32, weights: vec3f) -> bool {
    let mask = masks[material];
    let i = 3u * (triangle - mask.first);
    let at = mat3x3f(mask_corners[i], mask_corners[i + 1u], mask_corners[i + 2u]) * weights;
    let x = mask_taps(at.x, mask.width, (mask.repeats & 1u) != 0u);
    let y = mask_taps(at.y, mask.height, (mask.repeats & 2u) != 0u);
    let top = mix(mask_texel(mask, x.x, y.x), mask_texel(mask, x.y, y.x), x.z);
    let bottom = mix(mask_texel(mask, x.x, y.y), mask_texel(mask, x.y, y.y), x.z);
    return mask.alpha * at.z * mix(top, bottom, y.z) >= mask.cutoff;
}
