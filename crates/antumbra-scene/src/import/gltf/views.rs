//! Cameras and lights of nodes.

use super::accessor::{Asset, follow};
use super::container;
use super::document::{self, LightUse, Lights, PunctualLight};
use crate::import::error::Problem;
use crate::import::notes::Notes;
use crate::{Camera, Light, Numbered, Projection, Scene};
use glam::{DMat4, DVec3};
use std::f64::consts::FRAC_PI_2;

const LIGHTS: &str = "KHR_lights_punctual";
/// What single precision makes of π/2 may be more than that.
const RIGHT_ANGLE: f64 = FRAC_PI_2 + 1e-6;

impl Asset {
    /// Lists the file's cameras and lights under their own numbers, before any has a place.
    /// Returns the lights.
    pub(super) fn number_views(&self, scene: &mut Scene) -> Result<Vec<PunctualLight>, Problem> {
        let unused = |name: &Option<String>| Numbered {
            name: name.clone().unwrap_or_default(),
            places: Vec::new(),
            reason: "is used by no node of the scene that is shown".into(),
        };
        scene.camera_numbers = self.document.cameras.iter().map(|c| unused(&c.name)).collect();
        let all: Option<Lights> = container::extension(&self.document.extensions, LIGHTS, "document")?;
        let lights = all.unwrap_or_default().lights;
        scene.light_numbers = lights.iter().map(|l| unused(&l.name)).collect();
        Ok(lights)
    }

    /// Adds the camera of a node, if it has one with a picture.
    pub(super) fn add_camera(
        &self,
        scene: &mut Scene,
        node: usize,
        world: DMat4,
        notes: &mut Notes,
    ) -> Result<(), Problem> {
        let Some(index) = self.document.nodes[node].camera else { return Ok(()) };
        let camera = follow(&self.document.cameras, "cameras", index, &format!("nodes[{node}].camera"))?;
        let axes = [-DVec3::Z, DVec3::Y].map(|axis| world.transform_vector3(axis).try_normalize());
        let number = &mut scene.camera_numbers[index];
        match (axes, projection(camera)) {
            ([Some(forward), Some(up)], Some(projection)) if forward.cross(up).length() > 1e-3 => {
                let position = world.w_axis.truncate();
                number.places.push(scene.cameras.len());
                scene.cameras.push(Camera {
                    position: position.as_vec3(),
                    target: (position + forward).as_vec3(),
                    up: up.as_vec3(),
                    projection,
                });
            }
            _ => {
                number.reason = format!(
                    "({}) is left out: only perspective cameras with a yfov between 0 and π and orthographic ones with \
                     a ymag above 0, in an unskewed place, are taken",
                    camera.kind
                );
                notes.add(format!("cameras[{index}]"), number.reason.clone());
            }
        }
        Ok(())
    }

    /// Adds the light of a node, if it has one that is directional or a spot.
    pub(super) fn add_light(
        &self,
        scene: &mut Scene,
        lights: &[PunctualLight],
        (node, world): (usize, DMat4),
        notes: &mut Notes,
    ) -> Result<(), Problem> {
        let element = format!("nodes[{node}]");
        let extensions = &self.document.nodes[node].extensions;
        let Some(used) = container::extension::<LightUse>(extensions, LIGHTS, &element)? else {
            return Ok(());
        };
        let light = follow(lights, "lights", used.light, &format!("{element} light"))?;
        let direction = world.transform_vector3(-DVec3::Z).try_normalize().map(|d| d.as_vec3());
        let angle = light.spot.outer_cone_angle;
        let taken = match (light.kind.as_str(), direction) {
            ("directional", Some(direction)) => Some(Light::Directional { direction }),
            ("spot", Some(direction)) if angle > 0.0 && angle <= RIGHT_ANGLE => Some(Light::Spot {
                position: world.w_axis.truncate().as_vec3(),
                direction,
                outer_angle: (angle as f32).min(Light::MAX_OUTER_ANGLE),
            }),
            _ => None,
        };
        let number = &mut scene.light_numbers[used.light];
        let shown = format!("lights[{}]", used.light);
        let Some(taken) = taken else {
            number.reason = format!(
                "of type '{}' is left out: only directional lights and spots with a cone of 0 to π/2 are taken",
                light.kind
            );
            notes.add(shown, number.reason.clone());
            return Ok(());
        };
        if matches!(taken, Light::Spot { .. }) && angle as f32 > Light::MAX_OUTER_ANGLE {
            notes.add(shown, Light::narrowed(angle as f32));
        }
        number.places.push(scene.lights.len());
        scene.lights.push(taken);
        Ok(())
    }
}

fn projection(camera: &document::Camera) -> Option<Projection> {
    let projection = match (camera.kind.as_str(), &camera.perspective, &camera.orthographic) {
        ("perspective", Some(lens), _) => Projection::Perspective { fov_y: lens.yfov as f32 },
        ("orthographic", _, Some(lens)) => Projection::Orthographic { height: 2.0 * lens.ymag as f32 },
        _ => return None,
    };
    projection.is_usable().then_some(projection)
}
