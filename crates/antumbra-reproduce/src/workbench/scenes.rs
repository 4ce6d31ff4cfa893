//! The scenes that were built so far.

use super::Workbench;
use crate::study::ShotKey;
use antumbra::technique::Bias;
use antumbra_lab::{progress::Progress, shot::Shot};
use antumbra_scene::{Camera, Light, Scene, procedural};
use anyhow::{Context, Result};
use glam::Vec3;
use std::{cell::RefCell, collections::BTreeMap, sync::Arc};

/// The fence in a sun that is low.
const LOW_SUN: &str = "fence in low sun";
/// The backyard without its leaves and grass.
const LEAFLESS: &str = "backyard without leaves";

/// Width of the light-space ideal's kernel where an experiment names none, texels.
const KERNEL: u32 = 5;

/// Shots of scenes with their own camera and light, by name.
#[derive(Debug, Default)]
pub(super) struct Scenes(RefCell<BTreeMap<&'static str, Shot>>);

impl Scenes {
    /// A scene with its own camera and light; built when it is asked for first.
    fn own(&self, name: &'static str, progress: &dyn Progress) -> Result<Shot> {
        let known = self.0.borrow().get(name).cloned();
        if let Some(shot) = known {
            return Ok(shot);
        }
        progress.step(&format!("build the scene {name}"));
        let scene = scene(name)?;
        let shot = Shot {
            name: name.into(),
            geometry: Arc::new(scene.flatten()),
            tree: Default::default(),
            camera: scene.main_camera(),
            light: scene.main_light(),
            resolution: [1, 1],
            map_size: 1,
            kernel: KERNEL,
            cascades: 1,
            bias: Bias::Auto,
        };
        self.0.borrow_mut().insert(name, shot.clone());
        Ok(shot)
    }
}

/// A procedural scene, or a variant of one that an experiment needs.
fn scene(name: &str) -> Result<Scene> {
    let base = match name {
        LOW_SUN => "fence",
        LEAFLESS => "backyard",
        own => own,
    };
    let entry = procedural::by_name(base).with_context(|| format!("no scene is called {name}"))?;
    let mut scene = entry.scene(procedural::Procedural::DEFAULT_SEED);
    match name {
        // Lower, so that light that passes objects has passed fences before.
        LOW_SUN => {
            scene.lights = vec![Light::Directional { direction: Vec3::new(0.62, -0.25, -0.72).normalize() }]
        }
        LEAFLESS => {
            scene.leave_out(&["leaves", "grass", "herb"])?;
        }
        _ => {}
    }
    Ok(scene)
}

impl Workbench<'_> {
    /// What a key names, with maps of `map` texels.
    pub(super) fn shot_of(&self, key: &ShotKey, map: u32) -> Result<Shot> {
        let ShotKey { scene, distance, cascades, resolution } = *key;
        let own = self.scenes.own(scene, self.progress)?;
        let Camera { position, target, .. } = own.camera;
        let camera = Camera { position: target + (position - target) * distance, ..own.camera };
        Ok(Shot { camera, resolution, map_size: map, cascades, ..own })
    }
}
