//! Percentage-closer filtering at the points of a Poisson disk.
//!
//! A few bilinear comparisons, irregular but evenly spread, stand for a wide round kernel. Fixed, their
//! pattern bands in wide penumbrae; turned from pixel to pixel, the bands become noise, which eyes and
//! later filters forgive. Cheaper than a grid of the same width, and never as smooth.
//!
//! A Poisson disk is a set of points no two of which are close. These lie on Vogel's spiral, which packs
//! any number of them into a disk more evenly than random darts do, and takes a formula instead of a
//! table; centred, so that no kernel shifts the shadow.
//!
//! Vogel 1979, "A better way to construct the sunflower head"; Jimenez 2014 (noise).

use super::{About, Constant, Description, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    kernel::Width,
    parameter::{Field, Parameter, choice},
    precision::Precision,
};
use glam::DVec2;

choice! {
    /// Whether the disk turns.
    Spin {
        /// The same taps everywhere.
        Fixed = "fixed",
        /// Turned from pixel to pixel by interleaved gradient noise.
        Noise = "noise",
    }
}

/// Poisson-disk percentage-closer filtering. `points` bilinear lookups; 4 bytes per texel (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Poisson {
    /// Diameter of the disk in texels, 0 to 32.
    pub kernel: f32,
    /// Its diameter in world units (under a spot, at unit distance), at most `kernel` texels; 0 for
    /// `kernel` texels.
    pub width: f32,
    /// Number of lookups, 4 to 64.
    pub points: u32,
    /// Whether the disk turns.
    pub spin: Spin,
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Default for Poisson {
    fn default() -> Self {
        Self { kernel: 3.0, width: 0.0, points: 16, spin: Spin::Noise, precision: Precision::Float32 }
    }
}

impl Technique for Poisson {
    fn about(&self) -> About {
        About {
            name: "poisson",
            title: "Poisson-disk percentage-closer filtering",
            family: Family::Comparison,
            paper: "Vogel 1979; Jimenez 2014",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new("kernel", "texels", Field::Number(&mut self.kernel, 0.0..=32.0), "diameter of the disk"),
            Parameter::new(
                "width",
                "world units",
                Field::Number(&mut self.width, 0.0..=1e6),
                "diameter of the disk in the world, at most `kernel` texels; 0: `kernel` texels",
            ),
            Parameter::new("points", "lookups", Field::Count(&mut self.points, 4..=64), "bilinear lookups in the disk"),
            Parameter::new("spin", "", Field::Choice(&mut self.spin), "the same disk everywhere, or turned from pixel to pixel"),
            self.precision.parameter(),
        ]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let spin = match self.spin {
            Spin::Fixed => "spin_fixed",
            Spin::Noise => "spin_noise",
        };
        let (wgsl, linear) = (include_str!("poisson.wgsl"), wgpu::FilterMode::Linear);
        let mut described = Description::comparison(self.about(), wgsl, linear, self.precision);
        described.slots.push(spin);
        described.constants.extend([
            Constant::Count("poisson_points", self.points),
            Constant::Array("poisson_centre", centre(self.points).as_vec2().to_array().to_vec()),
        ]);
        Ok(Description {
            widths: vec![("diameter", Width { texels: self.kernel, world: self.width })],
            filter_radius_texels: self.kernel / 2.0 + 1.0,
            fetches: self.points,
            ..described
        })
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Precision::VARIANTS[..], &["spin=fixed,points=5"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// Mean of the spiral's points in the unit disk.
fn centre(count: u32) -> DVec2 {
    reference::spiral(count).sum::<DVec2>() / f64::from(count)
}

/// Disk and noise in f64.
#[doc(hidden)]
pub mod reference {
    use glam::DVec2;

    /// `count` points in the unit disk, the golden angle apart.
    pub fn spiral(count: u32) -> impl Iterator<Item = DVec2> {
        let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        (0..count).map(f64::from).map(move |i| {
            ((i + 0.5) / f64::from(count)).sqrt() * DVec2::from_angle(golden * i)
        })
    }

    /// The same, centred: what is looked up.
    #[must_use]
    pub fn disk(count: u32) -> Vec<DVec2> {
        spiral(count).map(|p| p - super::centre(count)).collect()
    }

    /// Share of a full turn at the pixel that steps `ddx` and `ddy` lead to from the map's origin to `uv`.
    #[must_use]
    pub fn turn(uv: [f64; 2], ddx: [f64; 2], ddy: [f64; 2]) -> f64 {
        let area = ddx[0] * ddy[1] - ddx[1] * ddy[0];
        let x = (uv[0] * ddy[1] - uv[1] * ddy[0]) / area;
        let y = (ddx[0] * uv[1] - ddx[1] * uv[0]) / area;
        let fraction = |v: f64| v - v.floor();
        fraction(52.982_918_9 * fraction(x * 0.067_110_56 + y * 0.005_837_15))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half the least distance r of N points is at most that of hexagons: r² ≤ 2π/(√3 N) or so.
    #[test]
    fn points_are_centred_and_far_apart() {
        for count in 4..=64 {
            let points = reference::disk(count);
            assert_eq!(points.len(), count as usize);
            assert!(points.iter().all(|p| p.length() <= 1.0 + centre(count).length()));
            assert!(points.iter().sum::<DVec2>().length() < 1e-9);
            let pairs = points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(move |q| (p, q)));
            let least = pairs.map(|(p, q)| p.distance(*q)).fold(f64::INFINITY, f64::min);
            let ideal = (2.0 * std::f64::consts::PI / (3f64.sqrt() * f64::from(count))).sqrt();
            assert!(least > 0.6 * ideal, "{count} points: {least} of {ideal}");
        }
    }

    /// A disk of uniform density has the variance ¼ along each axis.
    #[test]
    fn points_fill_the_disk_evenly() {
        for count in [16, 32, 64] {
            let variance = reference::disk(count).iter().map(|p| *p * *p).sum::<DVec2>() / f64::from(count);
            assert!((variance - 0.25).abs().max_element() < 0.03, "{count} points: {variance}");
        }
    }
}
