//! Which pixels the exponential map's classifiers find.

use super::{Random, SIZE, shadow_map};
use antumbra::technique;
use antumbra_testing::ask::{compute, depth_texture};
use antumbra_testing::{Gpu, broken::Broken};

const COUNT: usize = 4096;

/// Classes of receivers of all slopes and footprints, some in front of what the map holds and some behind.
fn classes(gpu: &Gpu, technique: &dyn antumbra::Technique) -> Vec<bool> {
    // Slopes, steps and single texels.
    let depth = depth_texture(gpu, SIZE, |x, y| match (x / 8 + y / 8) % 3 {
        0 => 0.3 + 0.004 * x as f32 + 0.002 * y as f32,
        1 => 0.5 + 0.003 * ((x * 7 + y * 13) % 11) as f32,
        _ => 0.6,
    });
    let shadows = shadow_map(gpu, technique, &depth, SIZE.into());
    let mut random = Random::new(11);
    let rows: Vec<f32> = (0..COUNT)
        .flat_map(|_| {
            let across = random.range(-9.0, -1.0).exp2();
            let down = random.range(-9.0, -1.0).exp2();
            [random.range(-1.0, 1.0), random.range(-1.0, 1.0), random.range(0.25, 0.75), across, down]
        })
        .collect();
    let user = "
        @group(1) @binding(0) var<storage, read> rows: array<f32>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
            if id.x * 5u >= arrayLength(&rows) { return; }
            let at = 5u * id.x;
            let position = vec3f(rows[at], rows[at + 1u], rows[at + 2u]);
            let normal = vec3f(0.0, 0.0, -1.0);
            let ddx = vec3f(rows[at + 3u], 0.0, 0.0);
            results[id.x] = f32(shadow_class(position, normal, ddx, vec3f(0.0, -rows[at + 4u], 0.0)));
        }";
    let found = compute(gpu, &shadows, user, bytemuck::cast_slice(&rows), COUNT, COUNT);
    found.into_iter().map(|class| class != 0.0).collect()
}

/// Pixels that the first finds and the second does not, and those that the first finds.
fn missed(first: &[bool], second: &[bool]) -> [usize; 2] {
    let both = || first.iter().zip(second).filter(|(a, _)| **a);
    [both().filter(|(_, b)| !**b).count(), both().count()]
}

pub(crate) fn zmax_misses_nothing(gpu: &Gpu) {
    for rest in [
        "kernel=1,sampling=nearest",
        "kernel=5,sampling=bilinear",
        "kernel=1,sampling=trilinear",
        "kernel=5,sampling=trilinear",
        "kernel=3,sampling=fitted",
        "kernel=3,sampling=anisotropic",
        "kernel=1,sampling=anisotropic,c=20",
        "kernel=5,sampling=trilinear,storage=log32",
        "kernel=5,sampling=trilinear,storage=log_half",
        "kernel=3,sampling=trilinear,epsilon=0.01",
        "kernel=7,sampling=summed",
    ] {
        let of = |classifier| technique::parse(&format!("esm.classifier={classifier},{rest}")).unwrap();
        let threshold = classes(gpu, of("threshold").as_ref());
        let [missed_here, found] = missed(&threshold, &classes(gpu, of("zmax").as_ref()));
        assert!(found > 50 && missed_here == 0, "{rest}: {missed_here} of {found} missed");
    }
    let threshold = classes(gpu, technique::parse("esm.kernel=3,sampling=anisotropic").unwrap().as_ref());
    let zmax = "esm.classifier=zmax,kernel=3,sampling=anisotropic";
    for broken in [
        Broken::new(zmax).uniform("offset", 0.02),
        Broken::saying(zmax, "let level = esm_level(farthest, view, ddx, ddy);", "let level = 0.0;"),
    ] {
        let [missed, _] = missed(&threshold, &classes(gpu, &broken));
        assert!(missed > 0, "negative control");
    }
}
