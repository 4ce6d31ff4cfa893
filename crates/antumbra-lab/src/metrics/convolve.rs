//! Separable convolution of planes, for SSIM and ꟻLIP.

use rayon::prelude::*;

/// An image of f32 with its width; rows are `values.len() / width`.
#[derive(Clone)]
pub(super) struct Field {
    pub(super) width: usize,
    pub(super) values: Vec<f32>,
}

/// What lies outside the image.
#[derive(Clone, Copy)]
pub(super) enum Border {
    /// Nothing: 0.
    Zero,
    /// The nearest pixel inside.
    Clamp,
}

impl Field {
    /// One value per pixel from one value per pixel of two fields.
    pub(super) fn zip(&self, other: &Self, f: impl Fn(f32, f32) -> f32 + Sync) -> Self {
        let values = self.values.par_iter().zip(&other.values).map(|(&a, &b)| f(a, b)).collect();
        Self { width: self.width, values }
    }

    /// Σ over (i, j) of `across[i] · down[j] · value(x + i − r, y + j − r)`: correlation with the
    /// product of two kernels of odd length 2r + 1.
    pub(super) fn correlate(&self, across: &[f32], down: &[f32], border: Border) -> Self {
        let rows = self.map_rows(|y, x| self.sum_across(x, y, across, border));
        rows.map_rows(|y, x| rows.sum_down(x, y, down, border))
    }

    fn map_rows(&self, f: impl Fn(usize, usize) -> f32 + Sync) -> Self {
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_exact_mut(self.width).enumerate().for_each(|(y, row)| {
            row.iter_mut().enumerate().for_each(|(x, value)| *value = f(y, x));
        });
        Self { width: self.width, values }
    }

    fn sum_across(&self, x: usize, y: usize, kernel: &[f32], border: Border) -> f32 {
        let (row, radius) = (y * self.width, kernel.len() / 2);
        if x >= radius && x + radius < self.width {
            let start = row + x - radius;
            return kernel.iter().zip(&self.values[start..start + kernel.len()]).map(|(k, v)| k * v).sum();
        }
        let at = |i: usize| inside(x + i, radius, self.width, border).map_or(0.0, |x| self.values[row + x]);
        kernel.iter().enumerate().map(|(i, k)| k * at(i)).sum()
    }

    fn sum_down(&self, x: usize, y: usize, kernel: &[f32], border: Border) -> f32 {
        let (radius, height) = (kernel.len() / 2, self.values.len() / self.width);
        let at =
            |j: usize| inside(y + j, radius, height, border).map_or(0.0, |y| self.values[y * self.width + x]);
        kernel.iter().enumerate().map(|(j, k)| k * at(j)).sum()
    }
}

/// `shifted − radius` if it is a pixel of the image, or what the border puts there.
fn inside(shifted: usize, radius: usize, length: usize, border: Border) -> Option<usize> {
    match border {
        Border::Zero => shifted.checked_sub(radius).filter(|&i| i < length),
        Border::Clamp => Some(shifted.saturating_sub(radius).min(length - 1)),
    }
}

/// exp(−x²/2σ²) for x in −radius..=radius, scaled to sum 1.
pub(super) fn gaussian(sigma: f64, radius: usize) -> Vec<f32> {
    let offsets = || (0..=2 * radius).map(|i| i as f64 - radius as f64);
    let weight = |x: f64| (-x * x / (2.0 * sigma * sigma)).exp();
    let sum: f64 = offsets().map(weight).sum();
    offsets().map(|x| (weight(x) / sum) as f32).collect()
}
