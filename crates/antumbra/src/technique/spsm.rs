//! Sub-pixel shadow maps: every texel keeps the nearest triangle that touches it, and lookups find
//! the shadow's edge at sub-texel precision.
//!
//! Casters are drawn conservatively, so that a texel without an occluder is certainly lit. A receiver
//! is lit or shadowed by the triangle of its own texel or of the eight around it wherever that is
//! certain; elsewhere triangles may be missing.
//!
//! As published, [`Spsm::PUBLISHED`], the silhouette is then recovered from those that were kept. With a second layer, of
//! triangles at texels' centres, the centres around decide, which are samples that nothing is missing from: what
//! no kept triangle covers is lit unless most of what surrounds it is shadowed. Gaps between occluders and occluders
//! that are narrower than a texel may vanish, and where many small triangles share a texel edges fray.
//!
//! Lecocq, Marvie, Sourimant, Gautron 2014, "Sub-Pixel Shadow Mapping".

use super::{About, CasterStorage, Class, Constant, Coverage, Description, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    parameter::{Field, Parameter, choice},
};

choice! {
    /// How a triangle is kept in 128 bits.
    Packing {
        /// Three corners, 2 × 16 bits over the map; 16 bits of depth, 2 × 8 bits of slope: as published.
        Map = "map",
        /// Three corners as 16-bit floats relative to the texel; depth and slope likewise.
        Texel = "texel",
        /// Three edges, 13 bits of direction and 13 of distance relative to the texel; 24 bits of
        /// depth, 2 × 12 bits of slope.
        Edges = "edges",
    }
}

impl Packing {
    /// The files of WGSL that it is made of.
    pub(crate) fn slots(self) -> Vec<&'static str> {
        match self {
            Self::Map => vec!["packing_corners", "points_map"],
            Self::Texel => vec!["packing_corners", "points_texel"],
            Self::Edges => vec!["packing_edges"],
        }
    }
}

choice! {
    /// What is done with receivers for which no triangle is certain.
    Uncertain {
        /// With one layer the silhouette is recovered, with two the texels' centres tell.
        Recovered = "recovered",
        /// They are lit: what conservative rasterisation and the stored triangles do by themselves.
        Lit = "lit",
    }
}

/// Sub-pixel shadow map. 1 to 5 lookups where that is enough, up to 9 more per layer, and 9 for the texels'
/// centres, else; with one layer 1 lookup, or 9 more, and up to 5 times 9 more where the silhouette has to be recovered.
/// 16 bytes per texel and layer.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spsm {
    /// How a triangle is kept.
    pub packing: Packing,
    /// 1 as published; 2 adds the triangle at each texel's centre.
    pub layers: u32,
    /// Exponent of the levels of slopes, odd, of the packings that keep corners: 5 as published, 1 for levels that are
    /// equally far apart.
    pub exponent: u32,
    /// Texels along one side of the square whose triangles may shadow a receiver, 3 as published or 5.
    pub neighbours: u32,
    /// What is done with receivers for which no triangle is certain.
    pub uncertain: Uncertain,
    /// Positions along one side of a pixel at which shadows are asked, 1 to 4. With one layer all are compared with a
    /// silhouette that is recovered once, as published; with two those in the corners are asked first, and where these
    /// differ all.
    pub samples: u32,
}

impl Spsm {
    /// As published: `spsm.packing=map,layers=1`.
    pub const PUBLISHED: Self = Self {
        packing: Packing::Map,
        layers: 1,
        exponent: 5,
        neighbours: 3,
        uncertain: Uncertain::Recovered,
        samples: 1,
    };
}

impl Default for Spsm {
    fn default() -> Self {
        Self { packing: Packing::Edges, layers: 2, ..Self::PUBLISHED }
    }
}

const CLASSES: [Class; 3] = [
    Class { name: "shadowed by its own texel's triangle", colour: [90, 110, 160] },
    Class { name: "shadowed by a triangle of 3×3 texels", colour: [40, 160, 60] },
    Class { name: "uncertain", colour: [224, 32, 32] },
];

impl Spsm {
    /// The common file and an ending: what decides where nothing is certain.
    fn wgsl(&self) -> &'static str {
        match self.layers {
            1 => concat!(include_str!("spsm.wgsl"), include_str!("spsm/silhouette.wgsl")),
            _ => concat!(include_str!("spsm.wgsl"), include_str!("spsm/centres.wgsl")),
        }
    }
}

impl Technique for Spsm {
    fn about(&self) -> About {
        About {
            name: "spsm",
            title: "Sub-pixel shadow map",
            family: Family::Geometry,
            paper: "Lecocq, Marvie, Sourimant, Gautron 2014",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new(
                "packing",
                "",
                Field::Choice(&mut self.packing),
                "how a triangle is kept in 128 bits: corners over the map, corners relative to the texel, edges",
            ),
            Parameter::new(
                "layers",
                "",
                Field::Count(&mut self.layers, 1..=2),
                "triangles per texel: one that touches it, as published; with 2 also the one at its centre",
            ),
            Parameter::new(
                "exponent",
                "",
                Field::Odd(&mut self.exponent, 1..=9),
                "exponent of the levels of slopes, for the packings that keep corners: 5 as published, 1 for even levels",
            ),
            Parameter::new(
                "neighbours",
                "texels",
                Field::Odd(&mut self.neighbours, 3..=5),
                "side of the square whose triangles may shadow a receiver: 3 as published",
            ),
            Parameter::new(
                "uncertain",
                "",
                Field::Choice(&mut self.uncertain),
                "receivers for which no triangle is certain: by the silhouette or, with 2 layers, centres; or lit",
            ),
            Parameter::new(
                "samples",
                "",
                Field::Count(&mut self.samples, 1..=4),
                "positions along one side of a pixel at which shadows are asked, of one silhouette with 1 layer",
            ),
        ]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let caster =
            CasterStorage::NearestTriangle(&[Coverage::Touched, Coverage::Centre][..self.layers.min(2) as usize]);
        let mut constants = vec![
            Constant::Count("spsm_layers", self.layers),
            Constant::Count("spsm_samples", self.samples),
            Constant::Count("spsm_neighbours", self.neighbours),
            Constant::Count("spsm_recovers", u32::from(self.uncertain == Uncertain::Recovered)),
        ];
        if self.packing != Packing::Edges {
            constants.push(Constant::Number("quantizer_exponent", self.exponent as f32));
        }
        Ok(Description {
            slots: self.packing.slots(),
            constants,
            classes: &CLASSES,
            // Its own and those around it per layer; the centres, or with one layer each step of the silhouette,
            // take nine more.
            fetches: 1 + self.neighbours * self.neighbours * self.layers,
            ..Description::triangles(self.about(), self.wgsl(), caster)
        })
    }
    fn variants(&self) -> Vec<&'static str> {
        vec![
            "packing=map,layers=1",
            "packing=texel,samples=2",
            "packing=map,layers=1,exponent=1",
            "packing=edges,layers=1,neighbours=5",
        ]
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's steps in f64.
#[doc(hidden)]
pub mod reference {
    /// Q of Eq. 3, before rounding: 0 to 254.
    #[must_use]
    pub fn quantize(slope: f64, exponent: i32) -> f64 {
        127.0 * (1.0 + (std::f64::consts::FRAC_2_PI * slope.atan()).powi(exponent))
    }

    /// The slope of a level, Eq. 4 with the signed root.
    #[must_use]
    pub fn dequantize(level: f64, exponent: i32) -> f64 {
        let power = level / 127.0 - 1.0;
        (std::f64::consts::FRAC_PI_2 * power.signum() * power.abs().powf(1.0 / f64::from(exponent))).tan()
    }

    /// Twice the area of (a, b, c).
    fn area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// Weights of a triangle's corners at a point.
    fn weights(corners: [[f64; 3]; 3], point: [f64; 2]) -> [f64; 3] {
        let at = corners.map(|c| [c[0], c[1]]);
        [0, 1, 2].map(|k| area(point, at[(k + 1) % 3], at[(k + 2) % 3]) / area(at[0], at[1], at[2]))
    }

    /// Algorithm 1: whether a triangle with corners (x, y, depth) is between the light and a receiver.
    #[must_use]
    pub fn intersects(corners: [[f64; 3]; 3], point: [f64; 2], depth: f64) -> bool {
        let weights = weights(corners, point);
        let plane: f64 = (0..3).map(|k| weights[k] * corners[k][2]).sum();
        plane < depth && weights.iter().all(|w| *w >= 0.0)
    }

    /// Quadratic B-spline: weight of a texel's centre in the mean around a point, `away` texels from it.
    #[must_use]
    pub fn weight(away: [f64; 2]) -> f64 {
        let along = |x: f64| if x.abs() < 0.5 { 0.75 - x * x } else { 0.5 * (1.5 - x.abs()).max(0.0).powi(2) };
        along(away[0]) * along(away[1])
    }

    /// Part of a convex polygon on the side of a line where n·x + o ≤ 0.
    #[must_use]
    pub fn clip(polygon: &[[f64; 2]], [nx, ny, o]: [f64; 3]) -> Vec<[f64; 2]> {
        let side = |p: [f64; 2]| nx * p[0] + ny * p[1] + o;
        let mut kept = Vec::new();
        for (i, a) in polygon.iter().enumerate() {
            let b = polygon[(i + 1) % polygon.len()];
            let (here, there) = (side(*a), side(b));
            if here <= 0.0 {
                kept.push(*a);
            }
            if (here <= 0.0) != (there <= 0.0) {
                let s = here / (here - there);
                kept.push([a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])]);
            }
        }
        kept
    }

    /// Consistent minimum depth [§4.2, figure 9]: least of gain·(x, 1) over the part of a triangle that
    /// is in the square of one texel around the origin; infinite if there is none.
    #[must_use]
    pub fn least(corners: [[f64; 2]; 3], gain: [f64; 3]) -> f64 {
        let sides = [[1.0, 0.0, -0.5], [-1.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, -1.0, -0.5]];
        let part = sides.iter().fold(corners.to_vec(), |part, side| clip(&part, *side));
        part.iter().map(|p| gain[0] * p[0] + gain[1] * p[1] + gain[2]).fold(f64::INFINITY, f64::min)
    }

    /// Entry of the table of tangents for a set of shadowed neighbours, bit k for the k-th around a
    /// texel from the right over the one below.
    ///
    /// Neighbours that do not hang together with the texel over common sides are left out [§4.2,
    /// figure 7]: conservative rasterisation guarantees that no edge crosses the texels between. Each
    /// run of the others around the ring that are lit is one border, and its middle the direction away
    /// from the shadow; a run that reaches more than halfway around is two borders.
    ///
    /// Bits 0 to 7: the neighbours that count; 8 to 10: number of tangents, 0 if all are shadowed;
    /// from 11 on, five bits each, their directions in 32nds of a turn, from right over down.
    #[must_use]
    pub fn tangents(pattern: u32) -> u32 {
        let set = |mask: u32, k: u32| mask >> (k % 8) & 1 == 1;
        let sides = pattern & 0b0101_0101;
        let hangs = |k: &u32| set(pattern, *k) && (k.is_multiple_of(2) || set(sides, k + 7) || set(sides, k + 1));
        let kept = (0..8).filter(hangs).fold(0, |mask, k| mask | 1 << k);
        let mut directions = Vec::new();
        let starts = (0..8).filter(|k| !set(kept, *k) && set(kept, k + 7));
        for start in if kept == 0 { vec![0] } else { starts.collect::<Vec<u32>>() } {
            let length = (0..8).take_while(|i| !set(kept, start + i)).count() as u32;
            let pieces = if length > 5 { 2 } else { 1 };
            // In quarters of a neighbour, which is an eighth of a turn.
            directions.extend((0..pieces).map(|i| 4 * start + 30 + 2 * length * (2 * i + 1) / pieces));
        }
        let count = directions.len() as u32;
        let packed = directions.iter().enumerate().fold(0, |all, (i, d)| all | (d % 32) << (11 + 5 * i));
        kept | count << 8 | packed
    }
}

#[cfg(test)]
mod tests {
    use super::reference::{dequantize, quantize, tangents, weight};

    /// Degrees from one level to the next around a slope.
    fn resolution(degrees: f64, exponent: i32) -> f64 {
        let level = quantize(degrees.to_radians().tan(), exponent);
        let angle = |level: f64| dequantize(level, exponent).atan().to_degrees();
        angle(level + 0.5) - angle(level - 0.5)
    }

    /// The paper says 0.17° at 80°, a fourth of what equally distant levels have [§3.4]. By its Eq. 3 it is 0.227°, less
    /// than a third, and 0.17° only at 86°.
    #[test]
    fn steep_slopes_have_finer_levels() {
        let near = |degrees, exponent, expected: f64| (resolution(degrees, exponent) - expected).abs() < 5e-4;
        assert!(near(80.0, 1, 0.7087) && near(40.0, 1, 0.7087), "{}", resolution(80.0, 1));
        assert!(near(80.0, 5, 0.2271), "{}", resolution(80.0, 5));
        assert!(near(86.0, 5, 0.1700), "{}", resolution(86.0, 5));
        assert!(resolution(40.0, 5) > resolution(40.0, 1));
        for (level, exponent) in (1..254).flat_map(|level| [1, 3, 5, 9].map(|exponent| (f64::from(level), exponent))) {
            assert!((quantize(dequantize(level, exponent), exponent) - level).abs() < 1e-6);
        }
    }

    #[test]
    fn specs_name_what_was_published() {
        let spec = crate::technique::spec(&super::Spsm::PUBLISHED);
        assert_eq!(spec, "spsm.packing=map,layers=1");
    }

    #[test]
    fn weights_of_all_texels_are_one_in_sum() {
        for at in [[0.0, 0.0], [0.3, -0.5], [-0.12, 0.49]] {
            let texels = (0..25).map(|i| [f64::from(i % 5 - 2) - at[0], f64::from(i / 5 - 2) - at[1]]);
            assert!((texels.map(weight).sum::<f64>() - 1.0).abs() < 1e-12);
        }
        assert!(weight([0.0, 0.0]) > weight([0.4, 0.0]) && weight([1.4, 0.0]) > weight([1.6, 0.0]));
    }

    fn directions(entry: u32) -> Vec<u32> {
        (0..(entry >> 8 & 7)).map(|i| entry >> (11 + 5 * i) & 31).collect()
    }

    #[test]
    fn tangents_of_known_patterns() {
        // Right half shadowed: away from it is left. Below: up. All, none.
        assert_eq!(directions(tangents(0b1100_0111)), [16]);
        assert_eq!(directions(tangents(0b0001_1111)), [24]);
        assert_eq!(directions(tangents(0b1111_1111)), [0; 0]);
        assert_eq!(directions(tangents(0)).len(), 2);
        // A bar from left to right has a border above and one below.
        assert_eq!(directions(tangents(0b0001_0001)), [8, 24]);
        // A missing corner is a border of its own.
        assert_eq!(directions(tangents(0b1111_1101)), [4]);
    }

    #[test]
    fn neighbours_that_hang_on_nothing_do_not_count() {
        // The upper left corner alone, and beside a shadowed right side.
        assert_eq!(tangents(0b0010_0000) & 255, 0);
        assert_eq!(tangents(0b0010_0001), tangents(0b0000_0001));
        assert_eq!(tangents(0b0011_0001) & 255, 0b0011_0001);
    }

    #[test]
    fn tangents_turn_with_the_pattern() {
        for pattern in 1..256_u32 {
            let turned = (pattern << 2 | pattern >> 6) & 255;
            let mut expected: Vec<u32> = directions(tangents(pattern)).iter().map(|d| (d + 8) % 32).collect();
            let mut found = directions(tangents(turned));
            expected.sort_unstable();
            found.sort_unstable();
            if tangents(pattern) & 255 != 0 {
                assert_eq!(found, expected, "{pattern:08b}");
            }
        }
    }
}
