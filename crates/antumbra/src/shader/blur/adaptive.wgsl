/// Variance of the blur in a view, in squares of texels.
fn blur_variance(view: u32) -> f32 {
    return shadow_blur(view);
}
