//! Memory for triangles follows from the scene; what the device refuses is invalid or left out, and the
//! others go on.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{Capacity, technique::Bias};
use antumbra_lab::{gpu::Gpu, prepared::Prepared, results::Refused, session::Session, shot::Shot, specs};
use antumbra_render::GpuScene;
use antumbra_scene::procedural;
use antumbra_testing::{Trials, settings};
use std::sync::Arc;

const RESOLUTION: [u32; 2] = [16, 12];

fn main() {
    let mut trials = Trials::default();
    trials.add("a scene knows how many triangles its maps must hold", |gpu| {
        for (name, pieces) in [("spheres", 1), ("spot", 2)] {
            let (scene, shot) = uploaded(&adopted(gpu), name);
            assert_eq!(
                scene.capacity().triangles as usize,
                pieces * shot.geometry.triangle_count(),
                "{name}"
            );
        }
    });
    trials.add("maps that are too small are allocated anew", |gpu| {
        let gpu = adopted(gpu);
        let enough = uploaded(&gpu, "spheres").0.capacity().triangles;
        for spec in settings::keeping_ids() {
            let session = prepare(&gpu, "spheres", few(5), &[spec]).unwrap();
            let [prepared] = session.prepared() else { panic!("{session:?}") };
            assert_eq!((prepared.shadows.capacity().triangles, prepared.invalid()), (enough, None));
        }
    });
    trials.add("where that is refused they are invalid", |_| {
        let gpu = opened();
        let mut session = prepare(&gpu, "contact", few(16), &["hard", "dpm.keeps=1"]).unwrap();
        let invalid: Vec<_> = session.prepared().iter().map(Prepared::invalid).collect();
        assert!(session.left_out().is_empty(), "{:?}", session.left_out());
        assert_eq!(invalid[0], None);
        assert!(invalid[1].as_ref().unwrap().contains("17 triangles, with memory for 16"), "{invalid:?}");
        session.leave_out_invalid();
        let [left_out] = session.left_out() else { panic!("{:?}", session.left_out()) };
        assert!(left_out.spec.starts_with("dpm") && session.prepared().len() == 1, "{left_out}");
    });
    trials.add("what is refused is left out, and the others stay", |_| {
        let gpu = opened();
        let session = prepare(&gpu, "contact", few(17), &["dpm", "hard", "spsm"]).unwrap();
        let kept: Vec<_> =
            session.prepared().iter().map(|p| (p.entry, p.shadows.technique().about().name)).collect();
        assert_eq!(kept, [(1, "hard"), (2, "spsm")]);
        let [left_out] = session.left_out() else { panic!("{:?}", session.left_out()) };
        assert_eq!(left_out.spec, "dpm");
        assert!(left_out.reason.contains("storage"), "{left_out}");
        let error = prepare(&gpu, "contact", few(17), &["dpm"]).unwrap_err();
        assert!(error.is::<Refused>() && error.to_string().contains("dpm: "), "{error}");
    });
    trials.run();
}

/// A device whose bindings hold the corners of 16 triangles (the scene has 17), and no buffer more than
/// keeping triangles takes.
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

fn uploaded(gpu: &Gpu, name: &str) -> (GpuScene, Shot) {
    let scene = procedural::by_name(name).unwrap().scene(1);
    let shot = Shot {
        name: name.into(),
        geometry: Arc::new(scene.flatten()),
        tree: Default::default(),
        camera: scene.main_camera(),
        light: scene.main_light(),
        resolution: RESOLUTION,
        map_size: 8,
        kernel: 3,
        cascades: 1,
        bias: Bias::Auto,
    };
    (shot.upload(gpu).unwrap(), shot)
}

fn prepare<'g>(gpu: &'g Gpu, name: &str, capacity: Capacity, specs: &[&str]) -> anyhow::Result<Session<'g>> {
    let (mut scene, shot) = uploaded(gpu, name);
    scene.set_capacity(capacity);
    let specs: Vec<String> = specs.iter().map(|s| (*s).into()).collect();
    let mut session = Session::on(gpu, &shot, scene)?;
    session.prepare(shot.map_size, &shot.entries(&specs::techniques(&specs, 3).unwrap()))?;
    Ok(session)
}
