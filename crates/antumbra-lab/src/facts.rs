//! What results say of shadow maps, scene and machine.

use crate::{
    gpu::Gpu,
    results::{
        AdapterFacts, BoundsFacts, CameraFacts, LensFacts, Lifetime, LightFacts, MemoryItem, MemoryResult,
        Program, RunFacts, SceneFacts, ViewFacts, Work,
    },
    session::Session,
    shot::Shot,
};
use antumbra::{Memory, ShadowMap, View};
use antumbra_scene::{Light, Projection};
use anyhow::{Context, Result};

/// What a shadow map takes, as results say it.
#[must_use]
pub fn memory(memory: &Memory) -> MemoryResult {
    MemoryResult {
        items: memory.items.clone(),
        kept_bytes: memory.bytes(Lifetime::Kept),
        transient_bytes: memory.bytes(Lifetime::Transient),
    }
}

/// What a shadow map takes whatever runs it.
#[must_use]
pub fn work(shadows: &ShadowMap) -> Work {
    let memory = shadows.memory();
    let of_texels = |i: &&MemoryItem| i.format != "buffer" || i.width > 1;
    let kept = memory.items.iter().filter(of_texels).filter(|i| i.lifetime == Lifetime::Kept);
    let side = |length: u32, mip: u32| u64::from((length >> mip).max(1));
    let size = shadows.size();
    let finest = (side(size.width, 0) * side(size.height, 0)) as f64;
    let (mut plain, mut with_mips) = (0.0, 0.0);
    for item in kept {
        let texels: u64 = (0..item.mips).map(|mip| side(item.width, mip) * side(item.height, mip)).sum();
        let share = (side(item.width, 0) * side(item.height, 0)) as f64 / texels as f64;
        plain += share * item.bytes as f64 / finest;
        with_mips += item.bytes as f64 / finest;
    }
    Work {
        bytes_per_texel: plain,
        bytes_per_texel_with_mips: with_mips,
        lookups: shadows.description().fetches,
        passes: shadows.passes().into_iter().map(String::from).collect(),
    }
}

/// The program that measures.
#[must_use]
pub fn program() -> Program {
    Program { name: "antumbra".into(), version: env!("CARGO_PKG_VERSION").into() }
}

/// What was run.
pub(crate) fn run(gpu: &Gpu, session: &Session<'_>, command: Vec<String>) -> Result<RunFacts> {
    let shot = session.shot();
    Ok(RunFacts {
        program: program(),
        command,
        scene: scene(shot)?,
        resolution: shot.resolution,
        map_size: shot.map_size,
        kernel_texels: shot.kernel,
        bias: shot.bias.to_string(),
        views: views(session.views()),
        adapter: adapter(gpu),
        notes: session.notes(),
    })
}

/// What was rendered.
fn scene(shot: &Shot) -> Result<SceneFacts> {
    let bounds = shot.geometry.bounds().context("the scene has no triangles")?;
    let camera = &shot.camera;
    Ok(SceneFacts {
        name: shot.name.clone(),
        triangles: shot.geometry.triangle_count() as u64,
        light: match shot.light {
            Light::Directional { direction } => LightFacts::Directional { direction: direction.to_array() },
            Light::Spot { position, direction, outer_angle } => LightFacts::Spot {
                position: position.to_array(),
                direction: direction.to_array(),
                outer_angle_deg: outer_angle.to_degrees(),
            },
        },
        camera: CameraFacts {
            position: camera.position.to_array(),
            target: camera.target.to_array(),
            up: camera.up.to_array(),
            lens: match camera.projection {
                Projection::Perspective { fov_y } => LensFacts::FovYDeg(fov_y.to_degrees()),
                Projection::Orthographic { height } => LensFacts::Height(height),
            },
        },
        origin: shot.geometry.placement.origin.to_array(),
        bounds: BoundsFacts { min: bounds.min.to_array(), max: bounds.max.to_array() },
    })
}

/// The light's views.
fn views(views: &[View]) -> Vec<ViewFacts> {
    let facts = |v: &View| ViewFacts { texel_world: v.texel_world, depth_world: v.depth_world };
    views.iter().map(facts).collect()
}

/// What a GPU says of itself.
#[must_use]
pub fn adapter(gpu: &Gpu) -> AdapterFacts {
    // The software driver's precision depends on this variable, so it belongs to the driver's name.
    let tuning = std::env::var("GALLIVM_PERF").ok().filter(|_| gpu.info.device_type == wgpu::DeviceType::Cpu);
    let tuning = tuning.map(|value| format!(" GALLIVM_PERF={value}")).unwrap_or_default();
    AdapterFacts {
        name: gpu.info.name.clone(),
        driver: format!("{} {}{tuning}", gpu.info.driver, gpu.info.driver_info).trim().into(),
        backend: gpu.info.backend.to_string(),
        device_type: format!("{:?}", gpu.info.device_type).to_lowercase(),
        features: gpu.features(),
    }
}

/// Largest memory that this process held, where Linux tells.
pub(crate) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kib| kib * 1024)
}
