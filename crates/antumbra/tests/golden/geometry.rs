//! Claims of techniques that keep triangles.

use crate::scene::*;
use antumbra::{Capacity, Options, Size};
use antumbra_testing::{Gpu, ask::Receiver};
use glam::{Vec2, Vec3};

/// A slanted triangle and one of about a texel beside it.
pub(crate) const SLANTED: [[(f32, f32); 3]; 2] =
    [[(0.2, 0.13), (0.83, 0.42), (0.31, 0.87)], [(0.81, 0.71), (0.86, 0.72), (0.82, 0.74)]];

/// How many of the picture's receivers behind such triangles a technique answers wrongly, from a map so
/// small that many fall into each texel.
pub(crate) fn wrong_behind(gpu: &Gpu, spec: &str, triangles: &[[(f32, f32); 3]]) -> usize {
    wrong_within(gpu, spec, Capacity::default(), triangles)
}

/// The same with that capacity.
pub(crate) fn wrong_within(
    gpu: &Gpu,
    spec: &str,
    capacity: Capacity,
    triangles: &[[(f32, f32); 3]],
) -> usize {
    let corner = |(u, v): (f32, f32)| Vec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, 0.3);
    let corners: Vec<Vec3> = triangles.iter().flatten().map(|c| corner(*c)).collect();
    let receivers: Vec<Receiver> =
        receivers().into_iter().map(|r| Receiver { depth: 0.8, normal: Vec3::NEG_Z, ..r }).collect();
    let covered = |p: Vec2| {
        triangles.iter().any(|t| {
            let [a, b, c] = t.map(|(u, v)| Vec2::new(u, v));
            let side = |a: Vec2, b: Vec2| (b - a).perp_dot(p - a);
            side(a, b) >= 0.0 && side(b, c) >= 0.0 && side(c, a) >= 0.0
        })
    };
    let options = Options::from(Size::square(20)).capacity(capacity);
    let found = behind(gpu, spec, options, &corners, &receivers);
    let differs = |(r, v): (&Receiver, f32)| (v < 0.5) != covered(r.uv);
    receivers.iter().zip(found).filter(|pair| differs(*pair)).count()
}

pub(crate) fn spsm_resolves_edges_below_a_texel(gpu: &Gpu) {
    let wrong = |spec| wrong_behind(gpu, spec, &SLANTED);
    let (published, two) = (wrong("spsm.layers=1"), wrong("spsm"));
    // The silhouette is exact here; texels' centres, which tell with two layers, hold its edge to a fraction
    // of a texel where no stored triangle does.
    assert!(published <= 8 && two <= 16, "{published} and {two} of {} pixels", receivers().len());
    let coarse = wrong("spsm.packing=map");
    assert!(coarse <= 80, "{coarse} with corners over the map");
}

/// At the tips of a large triangle no centre sees it.
pub(crate) fn rgsm_resolves_edges_of_large_triangles(gpu: &Gpu) {
    let wrong = |spec: &str, count| wrong_behind(gpu, &format!("rgsm.missed=lit,{spec}"), &SLANTED[..count]);
    let [own, three, five] = [1, 3, 5].map(|n| wrong(&format!("neighbours={n}"), 1));
    assert!(five <= three && three <= 30, "{three} with 3×3, {five} with 5×5");
    assert!(own > 4 * three, "{own} with the own texel alone");
    // One that lies between two rows of centres leaves nothing.
    let between = [[(0.78, 0.73), (0.92, 0.73), (0.85, 0.77)]];
    let lost = wrong_behind(gpu, "rgsm.missed=lit,neighbours=5", &between);
    let kept = wrong_behind(gpu, "spsm", &between);
    assert!(lost > 30 && kept < 8, "{lost}, and {kept} with conservative rasterisation");
    // Where the receiver casts nothing, the texel's centre answers beside a triangle.
    let centres = wrong_behind(gpu, "rgsm", &SLANTED[..1]);
    assert!(centres > 4 * three, "{centres}");
}

/// Sixty slivers around a point.
pub(crate) fn fan() -> Vec<[(f32, f32); 3]> {
    (0..60)
        .map(|k| {
            let turn = |k: i32| {
                let (sine, cosine) = (k as f32 * std::f32::consts::TAU / 60.0).sin_cos();
                (0.5 + 0.37 * cosine, 0.5 + 0.37 * sine)
            };
            [(0.52, 0.49), turn(k), turn(k + 1)]
        })
        .collect()
}

/// Elsewhere centres of texels hold the edge to a fraction of a texel.
pub(crate) fn dpm_resolves_what_has_room(gpu: &Gpu) {
    let wrong = |spec: &str, triangles: &[[(f32, f32); 3]]| wrong_behind(gpu, spec, triangles);
    let (few, roomy) = (wrong("dpm", &SLANTED), wrong("dpm.keeps=32", &fan()));
    assert!(few <= 1 && roomy <= 1, "{few} behind {}, {roomy} behind a fan", SLANTED.len());
    let one = Capacity { triangles: 1, ..Capacity::default() };
    let (full, cut) = (wrong("dpm.keeps=2", &fan()), wrong_within(gpu, "dpm", one, &fan()));
    assert!(full < 120 && cut > 5 * full.max(10), "{full} of full texels, {cut} with one triangle");
}

/// However small the map and the triangles.
pub(crate) fn exact_resolves_everything(gpu: &Gpu) {
    let fan = fan();
    for triangles in [&SLANTED[..], &fan] {
        let enough = Capacity { triangles: 60, triangles_per_texel: 64 };
        let wrong = wrong_within(gpu, "exact", enough, triangles);
        assert!(wrong <= 1, "{wrong} behind {} triangles", triangles.len());
        let cut = wrong_within(gpu, "exact", Capacity { triangles: 1, ..enough }, triangles);
        assert!(cut > 5, "{cut} with one triangle");
    }
}
