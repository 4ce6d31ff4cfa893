//! From arguments to triangles, a camera and a light.

use crate::{
    file_arguments::FileArguments,
    names,
    output::note,
    scene_arguments::{Arrangement, SceneArguments, ViewArguments},
    views,
};
use antumbra::technique::Bias;
use antumbra_lab::{default_view, shot::Shot};
use antumbra_scene::{Camera, Geometry, Light, Projection, Scene, import, procedural};
use antumbra_truth::SharedTree;
use anyhow::{Context, Result, anyhow, bail};
use glam::DVec3;
use std::{path::Path, sync::Arc};

/// Checks the numbers, which is quick.
pub(crate) fn check(arguments: &SceneArguments) -> Result<()> {
    bias(&arguments.bias)?;
    check_view(&arguments.view)
}

/// The same where a scene is not given with its bias.
pub(crate) fn check_view(arguments: &ViewArguments) -> Result<()> {
    resolution(&arguments.resolution)?;
    if arguments.size == 0 {
        bail!("--size 0: a shadow map has at least 1 texel");
    }
    if !(1..=31).contains(&arguments.kernel) {
        bail!("--kernel {}: allowed are 1 to 31 texels", arguments.kernel);
    }
    if !(1..=8).contains(&arguments.cascades) {
        bail!("--cascades {}: allowed are 1 to 8", arguments.cascades);
    }
    Ok(())
}

/// Loads and checks everything before any work is done.
pub(crate) fn load(arguments: &SceneArguments) -> Result<Shot> {
    Ok(Shot { bias: bias(&arguments.bias)?, ..load_view(&arguments.scene, &arguments.view)? })
}

/// The same with [`Bias::Auto`].
pub(crate) fn load_view(name: &str, arguments: &ViewArguments) -> Result<Shot> {
    let resolution = resolution(&arguments.resolution)?;
    let mut scene = open(name, arguments.seed, &arguments.file)?;
    arrange(&mut scene, &arguments.arrangement)?;
    if arguments.camera.is_none() && scene.cameras.is_empty() {
        scene.strays().iter().for_each(|strays| note(strays));
    }
    scene.validate().with_context(|| name.to_string())?;
    let camera = match &arguments.camera {
        None => scene.cameras.first().copied(),
        Some(text) => views::camera(text, &scene).map(Some).with_context(|| format!("--camera {text}"))?,
    };
    let light = match &arguments.light {
        None => scene.lights.first().copied(),
        Some(text) => views::light(text, &scene).map(Some).with_context(|| format!("--light {text}"))?,
    };
    let geometry = Geometry { single_sided: arguments.arrangement.single_sided, ..scene.flatten() };
    let tree = SharedTree::default();
    let (camera, light) = complete(&scene, (&geometry, &tree), camera, light)?;
    if arguments.cascades > 1 && matches!(light, Light::Spot { .. }) {
        note(&format!("--cascades {}: a spot has one view; cascades are a sun's", arguments.cascades));
    }
    Ok(Shot {
        name: name.into(),
        geometry: Arc::new(geometry),
        tree,
        camera,
        light,
        resolution,
        map_size: arguments.size,
        kernel: arguments.kernel,
        cascades: arguments.cascades,
        bias: Bias::Auto,
    })
}

fn bias(text: &str) -> Result<Bias> {
    text.parse().with_context(|| format!("--bias {text}"))
}

/// What neither the file nor the command line says, with a note that tells how to say it.
fn complete(
    scene: &Scene,
    (geometry, tree): (&Geometry, &SharedTree),
    camera: Option<Camera>,
    light: Option<Light>,
) -> Result<(Camera, Light)> {
    let chosen = default_view::choose(scene, (geometry, tree), camera, light)?;
    let number = |v: f64| {
        if v == 0.0 || (1e-3..1e9).contains(&v.abs()) { format!("{v:.4}") } else { format!("{v:e}") }
    };
    let numbers = |v: DVec3| [v.x, v.y, v.z].map(number).join(",");
    let Camera { position, target, projection, .. } = chosen.0;
    if let (None, Projection::Perspective { fov_y }) = (camera, projection) {
        let [eye, target] = [position, target].map(|point| numbers(scene.placement.in_file(point)));
        let text = format!("{eye}:{target}:{:.1}", fov_y.to_degrees());
        note(&format!("no camera is given; chosen so that shadows are seen: --camera {text}"));
    }
    if let (None, Light::Directional { direction }) = (light, chosen.1) {
        let text = numbers(scene.placement.direction_in_file(direction));
        note(&format!("no light is given; chosen so that shadows are seen: --light {text}"));
    }
    Ok(chosen)
}

/// Leaves out and turns what the options say.
fn arrange(scene: &mut Scene, arguments: &Arrangement) -> Result<()> {
    let parts = scene.instances.len();
    let left_out = scene.leave_out(&arguments.leave_out).map_err(|unknown| {
        let near = names::similar(&unknown.pattern, unknown.known.iter().map(String::as_str));
        let near = if near.is_empty() { String::new() } else { format!("; similar are {}", near.join(", ")) };
        anyhow!("--leave-out {}: {unknown}{near}", unknown.pattern)
    })?;
    if left_out == parts && parts > 0 {
        bail!(
            "--leave-out {} leaves out all {parts} parts of the scene",
            arguments.leave_out.join(" --leave-out ")
        );
    }
    if left_out > 0 {
        note(&format!("{left_out} of {parts} parts are left out by name"));
    }
    scene.stand(arguments.up.into());
    if arguments.single_sided && scene.materials.iter().all(|m| m.double_sided) {
        note("--single-sided changes nothing: no material of the scene is single-sided");
    }
    Ok(())
}

/// A built-in scene or a file, as it comes; whoever changes it validates it again.
pub(crate) fn open(name: &str, seed: u64, file: &FileArguments) -> Result<Scene> {
    if let Some(procedural) = procedural::by_name(name) {
        file.check_built_in(name)?;
        return Ok(procedural.scene(seed));
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        let known: Vec<&str> = procedural::all().iter().map(|p| p.name).collect();
        let nearest = names::nearest(name, known.iter().copied());
        let hint = nearest.map(|n| format!("; did you mean {n}?")).unwrap_or_default();
        bail!("no built-in scene and no file is called '{name}'; built-in: {}{hint}", known.join(", "));
    }
    if path.is_dir() {
        bail!("{name} is a folder; give a .glb, .gltf or .obj file in it");
    }
    let scene = import::load_with(path, &file.options())?;
    scene.notes.iter().for_each(|text| note(text));
    Ok(scene)
}

fn resolution(text: &str) -> Result<[u32; 2]> {
    let parse = || -> Option<[u32; 2]> {
        let (width, height) = text.split_once('x')?;
        let size = [width.parse().ok()?, height.parse().ok()?];
        size.iter().all(|n| (1..=16384).contains(n)).then_some(size)
    };
    parse().with_context(|| format!("--resolution {text}: write for example 1024x768, each 1 to 16384"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unreadable_resolutions_are_refused() {
        for text in ["", "0x5", "5", "5x", "99999x5", "-3x4"] {
            assert!(resolution(text).is_err(), "{text}");
        }
    }
}
