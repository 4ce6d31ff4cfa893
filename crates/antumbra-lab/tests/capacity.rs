//! Memory for triangles follows from the scene; what the device refuses is invalid or left out, and the
//! others go on.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{Capacity, technique::Bias};
use antumbra_lab::{
    compare::{self, Entered},
    gpu::Gpu,
    results::Refused,
    setting::Setting,
    stage::Stage,
};
use antumbra_scene::procedural;
use antumbra_testing::Trials;
use std::sync::Arc;

const RESOLUTION: [u32; 2] = [16, 12];

fn main() {
    let mut trials = Trials::default();
    trials.add("a stage knows how many triangles its maps must hold", |gpu| {
        for (name, pieces) in [("spheres", 1), ("spot", 2)] {
            let (stage, setting) = staged(&adopted(gpu), name);
            assert_eq!(
                stage.capacity().triangles as usize,
                pieces * setting.geometry.triangle_count(),
                "{name}"
            );
        }
    });
    trials.add("maps that are too small are allocated anew", |gpu| {
        let gpu = adopted(gpu);
        let (stage, _) = staged(&gpu, "spheres");
        let enough = stage.capacity().triangles;
        for spec in ["dpm", "exact"] {
            let entered = enter(&gpu, "spheres", few(5), &[spec]).unwrap();
            let [contestant] = &entered.contestants[..] else { panic!("{entered:?}") };
            assert_eq!((contestant.shadows.capacity().triangles, contestant.invalid()), (enough, None));
        }
    });
    trials.add("where that is refused they are invalid", |_| {
        let entered = enter(&opened(), "contact", few(16), &["hard", "dpm.keeps=1"]).unwrap();
        let invalid: Vec<_> = entered.contestants.iter().map(compare::Contestant::invalid).collect();
        assert!(entered.left_out.is_empty(), "{:?}", entered.left_out);
        assert_eq!(invalid[0], None);
        assert!(invalid[1].as_ref().unwrap().contains("17 triangles, with memory for 16"), "{invalid:?}");
    });
    trials.add("what is refused is left out, and the others stay", |_| {
        let entered = enter(&opened(), "contact", few(17), &["dpm", "hard", "spsm"]).unwrap();
        let kept: Vec<_> =
            entered.contestants.iter().map(|c| (c.entry, c.shadows.technique().page().name)).collect();
        assert_eq!(kept, [(1, "hard"), (2, "spsm")]);
        let [left_out] = &entered.left_out[..] else { panic!("{:?}", entered.left_out) };
        assert_eq!(left_out.spec, "dpm");
        assert!(left_out.reason.contains("storage"), "{left_out}");
        let error = enter(&opened(), "contact", few(17), &["dpm"]).unwrap_err();
        assert!(error.is::<Refused>() && error.to_string().contains("dpm: "), "{error}");
    });
    trials.run();
}

/// A device whose bindings hold the corners of 16 triangles (the scene has 17), and no buffer more than keeping
/// triangles takes.
fn opened() -> Gpu {
    let limits = wgpu::Limits {
        max_storage_buffer_binding_size: 16 * 48,
        max_storage_buffers_per_shader_stage: 5,
        max_color_attachment_bytes_per_sample: 48,
        ..wgpu::Limits::default()
    };
    adopted(&antumbra_testing::gpu_with(wgpu::Features::empty(), limits).unwrap())
}

fn adopted(gpu: &antumbra_testing::Gpu) -> Gpu {
    Gpu::adopt(gpu.device.clone(), gpu.queue.clone(), gpu.info.clone())
}

fn few(triangles: u32) -> Capacity {
    Capacity { triangles, ..Capacity::default() }
}

fn staged(gpu: &Gpu, name: &str) -> (Stage, Setting) {
    let scene = procedural::by_name(name).unwrap().scene(1);
    let setting = Setting {
        name: name.into(),
        geometry: Arc::new(scene.flatten()),
        camera: scene.main_camera(),
        light: scene.main_light(),
        resolution: RESOLUTION,
        map_size: 8,
        kernel: 3,
        cascades: 1,
        bias: Bias::Auto,
    };
    (setting.stage(gpu).unwrap(), setting)
}

fn enter(gpu: &Gpu, name: &str, capacity: Capacity, specs: &[&str]) -> anyhow::Result<Entered> {
    let (mut stage, setting) = staged(gpu, name);
    stage.set_capacity(capacity);
    let techniques = compare::techniques(&specs.iter().map(|s| (*s).into()).collect::<Vec<_>>(), 3).unwrap();
    setting.enter(gpu, &stage, &setting.entries(&techniques)).map(|(entered, _)| entered)
}
