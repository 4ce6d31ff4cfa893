//! Claims of techniques that compare depth.

use crate::scene::*;
use antumbra::{Capabilities, Options, Size, technique, technique::Bias};
use antumbra_testing::{
    Gpu,
    ask::{Receiver, depth_layers, depth_texture, shadow_map, visibility},
};
use glam::Vec2;

pub(crate) fn hard_has_two_levels(gpu: &Gpu) {
    let hard = picture(gpu, "hard", Bias::Auto);
    assert_eq!(levels(&hard), 2);
    assert_eq!(mean(&at(&hard, open)), 1.0);
    assert_eq!(largest(&at(&hard, |u, v| in_disc(u, v, -0.03))), 0.0);
}

pub(crate) fn pcf_has_as_many_levels_as_taps(gpu: &Gpu) {
    let nearest = levels(&picture(gpu, "pcf.kernel=3,weights=box,taps=nearest", Bias::Auto));
    assert!((5..=10).contains(&nearest), "{nearest} levels from 9 taps");
    let bilinear = levels(&picture(gpu, "pcf.kernel=3,weights=box", Bias::Auto));
    assert!(bilinear > 20, "{bilinear} levels from interpolated taps");
}

/// Largest difference of pixels side by side along the disc's rim.
pub(crate) fn roughness(picture: &[f32]) -> f32 {
    let rim = |i: usize| {
        let uv = receivers()[i].uv;
        in_disc(uv.x, uv.y, 0.03) && !in_disc(uv.x, uv.y, -0.03) && !in_sheet(uv.x, uv.y, 0.05)
    };
    let pairs = (1..picture.len()).filter(|i| i % SIDE as usize != 0 && rim(*i));
    pairs.map(|i| (picture[i] - picture[i - 1]).abs()).fold(0.0, f32::max)
}

pub(crate) fn bicubic_has_the_smoothest_edge_of_four_lookups(gpu: &Gpu) {
    let edge = |spec| roughness(&picture(gpu, spec, Bias::Auto));
    let (bicubic, bilinear, grid) = (edge("bicubic"), edge("pcf.kernel=1"), edge("pcf.kernel=3,weights=box"));
    assert!(bicubic < 0.8 * bilinear, "{bicubic}, one lookup {bilinear}");
    assert!(bicubic < 0.45 && grid < 0.45, "{bicubic}, four merged lookups {grid}");
}

/// Along the ramp's straight side a fixed disk answers the same everywhere, a turned one scatters.
pub(crate) fn poisson_turns_bands_into_noise(gpu: &Gpu) {
    let wide = |spin| picture(gpu, &format!("poisson.kernel=6,points=8,spin={spin}"), Bias::Auto);
    let scatter = |picture: &[f32]| {
        let column = |u: f32| (u * SIDE as f32) as u32;
        let side = (column(0.6)..column(0.7)).map(|x| {
            let values: Vec<f32> =
                (column(0.63)..column(0.72)).map(|y| picture[(y * SIDE + x) as usize]).collect();
            largest(&values) - values.iter().fold(1.0, |a: f32, b| a.min(*b))
        });
        side.fold(0.0, f32::max)
    };
    let (fixed, noise) = (wide("fixed"), wide("noise"));
    assert!(scatter(&fixed) < 1e-3, "{}", scatter(&fixed));
    assert!(scatter(&noise) > 0.15, "{}", scatter(&noise));
    // The noise does not move the shadow.
    assert!((mean(&noise) - mean(&fixed)).abs() < 2e-3, "{} {}", mean(&noise), mean(&fixed));
}

pub(crate) fn footprint_grows_with_the_pixel(gpu: &Gpu) {
    let texel = |i: u32| (i as f32 + 0.5) / 64.0;
    let depth = depth_texture(gpu, SIZE, |x, y| nearest(texel(x), texel(y)));
    let technique = technique::parse("footprint.budget=64").unwrap();
    let shadows = shadow_map(gpu, technique.as_ref(), &depth, SIZE.into());
    let edge = |texels: f32| {
        let receivers: Vec<Receiver> = receivers()
            .into_iter()
            .map(|r| Receiver { footprint: Vec2::splat(texels / SIZE.width as f32), ..r })
            .collect();
        roughness(&visibility(gpu, &shadows, &receivers))
    };
    let (small, large) = (edge(0.5), edge(6.0));
    assert!(large < 0.4 * small, "a pixel of half a texel {small}, of six {large}");
}

/// Whether every value is a whole number of steps.
pub(crate) fn in_steps_of(picture: &[f32], step: f32) -> bool {
    picture.iter().all(|v| (v / step - (v / step).round()).abs() < 1e-3)
}

/// 17 sums of 16 comparisons. In bytes a phase counts 63 for the texel in alpha and 64 for the others: 29.
pub(crate) fn packed_has_all_its_levels(gpu: &Gpu) {
    let [two, four] = ["packed", "packed.grid=4"].map(|spec| picture(gpu, spec, Bias::Auto));
    assert!(levels(&two) == 5 && in_steps_of(&two, 1.0 / 4.0), "{} levels of 2×2", levels(&two));
    assert!(levels(&four) == 17 && in_steps_of(&four, 1.0 / 16.0), "{} levels of 4×4", levels(&four));
    // Of each 2×2 block, which a phase packs, none, the texel that goes to alpha, the others, all, one, or two others.
    let blocks = [0b0000_u32, 0b0010, 0b1101, 0b1111, 0b0001, 0b0101];
    let depth = depth_texture(gpu, Size::square(128), |x, y| {
        let mixed = (y / 2 * 64 + x / 2).wrapping_mul(2_654_435_761);
        let block = (mixed ^ mixed >> 15).wrapping_mul(2_246_822_519) >> 16;
        if blocks[block as usize % 6] >> (y % 2 * 2 + x % 2) & 1 == 1 { 0.2 } else { 1.0 }
    });
    let shown = |spec: &str| {
        let technique = technique::parse(spec).unwrap();
        let shadows = shadow_map(gpu, technique.as_ref(), &depth, Size::square(128).into());
        let corners = (0..62 * 62).map(|i| (2.0 + Vec2::new((i % 62) as f32, (i / 62) as f32) * 2.0) / 128.0);
        let receivers: Vec<_> = corners.map(|uv| Receiver::point(uv.x, uv.y, 0.5)).collect();
        levels(&visibility(gpu, &shadows, &receivers))
    };
    assert_eq!(shown("packed.grid=4"), 17);
    assert_eq!(shown("packed.grid=4,accumulation=bytes"), 29);
    // 0, 63 or 64, 127 or 128, 191 or 192, 255.
    assert_eq!(shown("packed.accumulation=bytes"), 8);
}

pub(crate) fn stratified_has_as_many_levels_as_samples(gpu: &Gpu) {
    for grid in [2_u32, 3, 4] {
        let picture = picture(gpu, &format!("stratified.grid={grid}"), Bias::Auto);
        let samples = grid * grid;
        assert!(in_steps_of(&picture, 1.0 / samples as f32), "{grid}×{grid}");
        assert!(levels(&picture) <= samples as usize + 1 && levels(&picture) > samples as usize / 2);
    }
}

/// n×n samples in a texel are those of a map n times as fine along each axis: their mean is the mean of
/// its n×n texels, exactly.
pub(crate) fn stratified_resolves_as_a_finer_map(gpu: &Gpu) {
    const TEXELS: u32 = 48;
    let seen = |spec: &str, size: u32, receivers: &[Receiver]| {
        let technique = technique::parse(spec).unwrap();
        let offsets = technique.describe(&Capabilities::full()).unwrap().sample_offsets;
        let texel = |i: u32, offset: f32| (i as f32 + 0.5 + offset) / size as f32;
        let depth = depth_layers(gpu, Size::square(size), offsets.len() as u32, |pass, x, y| {
            let offset = offsets[pass as usize];
            nearest(texel(x, offset.x), texel(y, offset.y))
        });
        // Without a bias, whose texels are those of the map.
        let options = Options { bias: Bias::NONE, ..Size::square(size).into() };
        visibility(gpu, &shadow_map(gpu, technique.as_ref(), &depth, options), receivers)
    };
    // Centres of the n×n parts of each texel of the coarse map, texel by texel, between its casters and
    // the ground.
    let parts = |n: u32| -> Vec<Receiver> {
        let at = |texel: u32, part: u32| (texel as f32 + (part as f32 + 0.5) / n as f32) / TEXELS as f32;
        let texels = (1..TEXELS - 1).flat_map(|y| (1..TEXELS - 1).map(move |x| (x, y)));
        texels
            .flat_map(|(x, y)| (0..n * n).map(move |k| Receiver::point(at(x, k % n), at(y, k / n), 0.5)))
            .collect()
    };
    for n in [2, 3, 4] {
        let stratified = seen(&format!("stratified.grid={n}"), TEXELS, &parts(1));
        let of_finer = |times: u32| -> Vec<f32> {
            seen("hard", times * TEXELS, &parts(times)).chunks(times.pow(2) as usize).map(mean).collect()
        };
        let differ = |other: &[f32]| std::iter::zip(&stratified, other).filter(|(a, b)| a != b).count();
        assert_eq!(differ(&of_finer(n)), 0, "{n}×{n}");
        for wrong in [1, n - 1, n + 1] {
            let count = differ(&of_finer(wrong));
            assert!(count > 40, "{n}×{n} samples are those of {wrong}×{wrong} but in {count} texels");
        }
    }
}
