//! What results say of shadow maps, scene and machine.

use crate::{
    gpu::Gpu,
    results::{
        AdapterFacts, BoundsFacts, CameraFacts, LensFacts, Lifetime, LightFacts, MemoryItem, MemoryResult,
        Program, RunFacts, SceneFacts, TruthFacts, ViewFacts, Work,
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
    let scene = scene(shot)?;
    Ok(RunFacts {
        program: program(),
        command,
        warnings: extent_warning(&scene.bounds).into_iter().collect(),
        scene,
        resolution: shot.resolution,
        map_size: shot.map_size,
        kernel_texels: shot.kernel,
        bias: shot.bias.to_string(),
        views: views(session.views()),
        adapter: adapter(gpu),
        notes: session.notes(),
    })
}

/// Extents of scenes that 32-bit numbers resolve: shaders take the areas of receivers per unit of world area, which is
/// below what they tell from nothing where a scene is larger; where one is smaller its own areas are.
const EXTENTS: std::ops::Range<f32> = 1e-19..1e14;

/// Said of scenes of any other extent.
fn extent_warning(bounds: &BoundsFacts) -> Option<String> {
    let across = (0..3).map(|k| (bounds.max[k] - bounds.min[k]).abs()).fold(0.0, f32::max);
    (!EXTENTS.contains(&across)).then(|| {
        format!(
            "the scene is {across:e} units across, which 32-bit numbers do not resolve; do not trust these numbers, or \
             scale the scene to {:e} to {:e} units",
            EXTENTS.start, EXTENTS.end
        )
    })
}

/// Said where raster and rays see different things in more than a thousandth of the pixels.
pub(crate) fn coverage_warning(truth: &TruthFacts, resolution: [u32; 2]) -> Option<String> {
    let pixels = u64::from(resolution[0]) * u64::from(resolution[1]);
    let unexplained = truth.coverage_explained.get("unexplained").copied().unwrap_or(0);
    (1000 * unexplained > pixels).then(|| {
        format!(
            "raster and rays see different triangles in {unexplained} of {pixels} pixels, for no good reason; do not \
             trust these scores"
        )
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extents_that_are_not_resolved_are_told() {
        let warning = |across: f32| {
            let bounds =
                BoundsFacts { min: [-across / 2.0, 0.0, 0.0], max: [across / 2.0, 0.1 * across, 0.0] };
            extent_warning(&bounds)
        };
        for across in [1e-18, 1.0, 9e13] {
            assert_eq!(warning(across), None);
        }
        for (across, text) in
            [(0.0, "0e0 units"), (1e-20, "1e-20 units"), (2e14, "2e14 units"), (1e30, "1e30 units")]
        {
            assert!(warning(across).unwrap().contains(text), "{across}: {:?}", warning(across));
        }
    }
}
