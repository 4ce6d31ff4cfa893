//! The automatic bias: no acne, shadows that begin where casters touch, no more error than with the best
//! of the fixed biases. Each bound is also given biases that it must reject.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::technique::Bias;
use antumbra_lab::{
    bias::{self, Ranking, Request, Row},
    gpu::Gpu,
    progress::NoProgress,
    shot::Shot,
    specs,
};
use antumbra_scene::procedural;
use antumbra_testing::Trials;
use std::sync::Arc;

/// Most acne: share of the fully lit pixels.
const ACNE: f64 = 2e-4;
/// Most that shadows may retreat from what casts them where it touches, texels.
const DETACHED: f64 = 1.0;
/// Most error, times that with the best fixed bias.
const WORSE: f64 = 1.1;

/// What users of other programs set.
const FIXED: [&str; 7] = [
    "constant_texels=1",
    "constant_texels=2",
    "slope_texels=1",
    "slope_texels=2",
    "normal_offset_texels=1",
    "receiver_plane=1",
    "constant_texels=1,slope_texels=2",
];

fn main() {
    let mut trials = Trials::default();
    for scene in ["contact", "spheres", "spot", "brabec"] {
        trials.add(format!("{scene}: no technique shadows what is lit"), move |gpu| {
            for row in study(gpu, scene, &["all-comparison"], &["auto"]) {
                assert!(row.acne <= ACNE, "{row:?}");
            }
        });
        trials.add(format!("{scene}: no fixed bias errs less"), move |gpu| {
            let settings: Vec<&str> = [["auto"].as_slice(), &FIXED].concat();
            for ranking in bias::rank_biases(&sharp_study(gpu, scene, &["hard", "pcf"], &settings)) {
                let Ranking { auto, best, others, .. } = ranking;
                let best = best.unwrap().rmse;
                assert!(auto.rmse <= WORSE * best, "{auto:?}, best {best}");
                assert!(others[0].rmse > WORSE * best, "any bias would do: {:?}", others[0]);
            }
        });
    }
    trials.add("contact: shadows begin where casters touch", |gpu| {
        for row in study(gpu, "contact", &["all-comparison"], &["auto"]) {
            assert!(row.detached_texels.unwrap() <= DETACHED, "{row:?}");
        }
    });
    trials.add("rejected: too little and too much", |gpu| {
        let settings = ["none", "receiver_plane=1", "constant_texels=4", "normal_offset_texels=4"];
        let [none, plane, far, aside] = study(gpu, "contact", &["hard"], &settings).try_into().unwrap();
        assert!(none.acne > ACNE && plane.acne > ACNE, "{none:?} {plane:?}");
        assert!(far.detached_texels.unwrap() > DETACHED && aside.detached_texels.unwrap() > DETACHED);
        // A constant bias detaches shadows by itself.
        assert!((far.detached_texels.unwrap() - 4.0).abs() < 0.5, "{far:?}");
    });
    trials.add("rejected: rounding of floats left out", |gpu| {
        // The floor of this scene lies at the far end of a long range of projected depths.
        let terms = "constant_texels=0.05,slope_texels=0.05,receiver_plane=1";
        let settings = [terms.to_string(), format!("{terms},depth_steps=0.5")];
        let rows = sharp_study(gpu, "spot", &["hard"], &settings.each_ref().map(String::as_str));
        // Graphics cards round less.
        let factor = if gpu.is_software() { 10.0 } else { 4.0 };
        assert!(rows[0].acne > factor * rows[1].acne && rows[0].acne > ACNE, "{rows:?}");
    });
    trials.add("coarse depths are covered", |gpu| {
        let specs = ["hard.precision=16", "hard.precision=12", "pcf.precision=12"];
        for row in study(gpu, "contact", &specs, &["auto"]) {
            assert!(row.acne <= ACNE, "{row:?}");
        }
        // Depth that leans has steps as fine as the texels of this map: other terms would cover them.
        let terms = "receiver_plane=1.75";
        let [row] = study(gpu, "contact", &["hard.precision=8"], &[terms]).try_into().unwrap();
        assert!(row.acne > ACNE, "without steps: {row:?}");
    });
    trials.run();
}

fn study(gpu: &antumbra_testing::Gpu, scene: &str, techniques: &[&str], settings: &[&str]) -> Vec<Row> {
    measure(gpu, scene, techniques, settings, (512, [256, 192]))
}

/// With the sizes of the table in `docs/bias.md`.
fn sharp_study(gpu: &antumbra_testing::Gpu, scene: &str, techniques: &[&str], settings: &[&str]) -> Vec<Row> {
    measure(gpu, scene, techniques, settings, (1024, [480, 360]))
}

fn measure(
    gpu: &antumbra_testing::Gpu,
    scene: &str,
    techniques: &[&str],
    settings: &[&str],
    (map_size, resolution): (u32, [u32; 2]),
) -> Vec<Row> {
    let gpu = Gpu::adopt(gpu.device.clone(), gpu.queue.clone(), gpu.info.clone());
    let scene = procedural::by_name(scene).unwrap().scene(1);
    let specs: Vec<String> = techniques.iter().map(|spec| spec.to_string()).collect();
    let settings: Vec<Bias> = settings.iter().map(|text| text.parse().unwrap()).collect();
    let shot = Shot {
        name: scene.name.clone(),
        camera: scene.main_camera(),
        light: scene.main_light(),
        geometry: Arc::new(scene.flatten()),
        tree: Default::default(),
        resolution,
        map_size,
        kernel: 5,
        cascades: 1,
        bias: Bias::Auto,
    };
    let request =
        Request { shot: &shot, techniques: &specs::techniques(&specs, 5).unwrap(), settings: &settings };
    bias::study(&gpu, &request, &NoProgress).unwrap().rows
}
