/// Layers of the map per view.
const blur_layers: u32 = 1;

/// Variance of the blur in a layer of the map, in squares of texels: that of the view to which it belongs.
fn blur_variance(layer: u32) -> f32 {
    return shadow_blur(layer / blur_layers);
}
