//! From arguments to triangles, a camera and a light.

use crate::arguments::SceneArguments;
use antumbra_scene::{Camera, Geometry, Light, Scene, import, procedural};
use anyhow::{Context, Result, bail};
use glam::Vec3;
use std::{io::Write, path::Path};

/// All that is needed to render.
#[derive(Debug)]
pub(crate) struct Setting {
    pub(crate) name: String,
    pub(crate) geometry: Geometry,
    pub(crate) camera: Camera,
    pub(crate) light: Light,
    pub(crate) resolution: [u32; 2],
}

/// Checks the numbers, which is quick.
pub(crate) fn check(arguments: &SceneArguments) -> Result<()> {
    resolution(&arguments.resolution)?;
    if arguments.size == 0 {
        bail!("--size 0: a shadow map has at least 1 texel");
    }
    if !(1..=31).contains(&arguments.kernel) {
        bail!("--kernel {}: allowed are 1 to 31 texels", arguments.kernel);
    }
    Ok(())
}

/// Loads and checks everything before any work is done.
pub(crate) fn load(arguments: &SceneArguments) -> Result<Setting> {
    let resolution = resolution(&arguments.resolution)?;
    let scene = open(&arguments.scene, arguments.seed)?;
    scene.validate().with_context(|| arguments.scene.clone())?;
    let camera = match &arguments.camera {
        None => scene.main_camera(),
        Some(text) => camera(text, &scene).with_context(|| format!("--camera {text}"))?,
    };
    let light = match &arguments.light {
        None => scene.main_light(),
        Some(text) => light(text, &scene).with_context(|| format!("--light {text}"))?,
    };
    Ok(Setting { name: arguments.scene.clone(), geometry: scene.flatten(), camera, light, resolution })
}

/// A built-in scene or a file, not yet validated.
pub(crate) fn open(name: &str, seed: u64) -> Result<Scene> {
    if let Some(procedural) = procedural::by_name(name) {
        return Ok(procedural.scene(seed));
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        let known: Vec<&str> = procedural::all().iter().map(|p| p.name).collect();
        let nearest = crate::names::nearest(name, known.iter().copied());
        let hint = nearest.map(|n| format!("; did you mean {n}?")).unwrap_or_default();
        bail!("no built-in scene and no file is called '{name}'; built-in: {}{hint}", known.join(", "));
    }
    if path.is_dir() {
        bail!("{name} is a folder; give a .glb, .gltf or .obj file in it");
    }
    let scene = import::load(path)?;
    for note in &scene.notes {
        // A standard error that nobody reads is no reason to stop.
        let _ = writeln!(std::io::stderr(), "note: {note}");
    }
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

fn vector(text: &str) -> Result<Vec3> {
    let parts: Vec<f32> = text.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    match parts[..] {
        [x, y, z] if text.split(',').count() == 3 && Vec3::new(x, y, z).is_finite() => Ok(Vec3::new(x, y, z)),
        _ => bail!("'{text}' is not three finite numbers x,y,z"),
    }
}

fn degrees(text: &str, most: f32) -> Result<f32> {
    match text.parse::<f32>() {
        Ok(degrees) if degrees > 0.0 && degrees <= most => Ok(degrees.to_radians()),
        _ => bail!("'{text}' is not an angle of more than 0 and at most {most} degrees"),
    }
}

fn camera(text: &str, scene: &Scene) -> Result<Camera> {
    if let Ok(index) = text.parse::<usize>() {
        let count = scene.cameras.len();
        return scene
            .cameras
            .get(index)
            .copied()
            .with_context(|| format!("the file has {count} cameras, from 0"));
    }
    let parts: Vec<&str> = text.split(':').collect();
    let (eye, target, fov_y) = match parts[..] {
        [eye, target] => (vector(eye)?, vector(target)?, 50f32.to_radians()),
        [eye, target, fov] => (vector(eye)?, vector(target)?, degrees(fov, 170.0)?),
        _ => bail!("write eye:target or eye:target:degrees, for example 3,2,5:0,1,0:50"),
    };
    if eye == target {
        bail!("eye and target are the same point {eye}");
    }
    let forward = (target - eye)
        .try_normalize()
        .with_context(|| format!("eye {eye} and target {target} are too near or too far from each other"))?;
    let up = if forward.y.abs() > 0.999 { Vec3::Z } else { Vec3::Y };
    Ok(Camera { position: eye, target, up, fov_y })
}

fn light(text: &str, scene: &Scene) -> Result<Light> {
    if let Ok(index) = text.parse::<usize>() {
        let count = scene.lights.len();
        return scene
            .lights
            .get(index)
            .copied()
            .with_context(|| format!("the file has {count} lights, from 0"));
    }
    let direction = |text: &str| -> Result<Vec3> {
        let direction = vector(text)?;
        direction
            .try_normalize()
            .with_context(|| format!("direction {text} has no length, or one beyond what an f32 holds"))
    };
    let Some(spot) = text.strip_prefix("spot:") else {
        return Ok(Light::Directional { direction: direction(text)? });
    };
    let parts: Vec<&str> = spot.split(':').collect();
    let [position, axis, angle] = parts[..] else {
        bail!("write spot:position:direction:degrees, for example spot:0,4,0:0,-1,0:35");
    };
    Ok(Light::Spot {
        position: vector(position)?,
        direction: direction(axis)?,
        outer_angle: degrees(angle, 80.0)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_and_lights_are_read() {
        let scene = procedural::by_name("contact").unwrap().scene(1);
        let read = camera("3,2,5:0,1,0:50", &scene).unwrap();
        assert_eq!((read.position, read.target), (Vec3::new(3.0, 2.0, 5.0), Vec3::Y));
        assert!((read.fov_y.to_degrees() - 50.0).abs() < 1e-4);
        assert!(camera("-1,2,3:0,0,0", &scene).is_ok() && camera("0", &scene).is_ok());
        assert!(matches!(light("0.3,-1,0", &scene).unwrap(), Light::Directional { .. }));
        assert!(matches!(light("spot:0,4,0:0,-1,0:35", &scene).unwrap(), Light::Spot { .. }));
    }

    #[test]
    fn unreadable_ones_are_refused_with_an_example() {
        let scene = procedural::by_name("contact").unwrap().scene(1);
        for text in [
            "",
            "1,2",
            "1,2,3",
            "1,2,3:1,2,3",
            "1,2,nan:0,0,0",
            "3e38,0,0:-3e38,0,0",
            "1,2,3:0,0,0:0",
            "1,2,3:0,0,0:inf",
            "99",
        ] {
            assert!(camera(text, &scene).is_err(), "{text}");
        }
        for text in ["", "0,0,0", "spot:1,2,3", "spot:0,0,0:0,-1,0:95", "1,2,x", "77"] {
            assert!(light(text, &scene).is_err(), "{text}");
        }
        for text in ["", "0x5", "5", "5x", "99999x5", "-3x4"] {
            assert!(resolution(text).is_err(), "{text}");
        }
    }
}
