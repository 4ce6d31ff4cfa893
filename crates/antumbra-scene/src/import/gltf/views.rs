//! Cameras and lights of nodes.

use super::accessor::{Asset, follow};
use super::container;
use super::document::{self, LightUse, Lights};
use crate::import::error::Problem;
use crate::{Camera, Light, Projection, Scene};
use glam::{DMat4, DVec3};
use std::f64::consts::FRAC_PI_2;

const LIGHTS: &str = "KHR_lights_punctual";

impl Asset {
    /// Adds the camera of a node, if it has one with a picture.
    pub(super) fn add_camera(&self, scene: &mut Scene, node: usize, world: DMat4) -> Result<(), Problem> {
        let Some(index) = self.document.nodes[node].camera else { return Ok(()) };
        let camera = follow(&self.document.cameras, "cameras", index, &format!("nodes[{node}].camera"))?;
        let axes = [-DVec3::Z, DVec3::Y].map(|axis| world.transform_vector3(axis).try_normalize());
        match (axes, projection(camera)) {
            ([Some(forward), Some(up)], Some(projection)) if forward.cross(up).length() > 1e-3 => {
                let position = world.w_axis.truncate();
                scene.cameras.push(Camera {
                    position: position.as_vec3(),
                    target: (position + forward).as_vec3(),
                    up: up.as_vec3(),
                    projection,
                });
            }
            _ => scene.notes.push(format!(
                "cameras[{index}] ({}) is left out: only perspective cameras with a yfov between 0 and π and \
                 orthographic ones with a ymag above 0, in an unskewed place, are taken",
                camera.kind
            )),
        }
        Ok(())
    }

    /// Adds the light of a node, if it has one that is directional or a spot.
    pub(super) fn add_light(&self, scene: &mut Scene, node: usize, world: DMat4) -> Result<(), Problem> {
        let element = format!("nodes[{node}]");
        let extensions = &self.document.nodes[node].extensions;
        let Some(used) = container::extension::<LightUse>(extensions, LIGHTS, &element)? else {
            return Ok(());
        };
        let all: Lights =
            container::extension(&self.document.extensions, LIGHTS, "document")?.unwrap_or_default();
        let light = follow(&all.lights, "lights", used.light, &format!("{element} light"))?;
        let direction = world.transform_vector3(-DVec3::Z).try_normalize().map(|d| d.as_vec3());
        let angle = light.spot.outer_cone_angle;
        let taken = match (light.kind.as_str(), direction) {
            ("directional", Some(direction)) => Some(Light::Directional { direction }),
            ("spot", Some(direction)) if angle > 0.0 && angle <= FRAC_PI_2 => Some(Light::Spot {
                position: world.w_axis.truncate().as_vec3(),
                direction,
                // A cone of exactly 90° has no finite picture.
                outer_angle: angle.min(FRAC_PI_2 - 1e-3) as f32,
            }),
            _ => None,
        };
        match taken {
            Some(light) => scene.lights.push(light),
            None => scene.notes.push(format!(
                "lights[{}] of type '{}' is left out: only directional lights and spots with a cone of 0 to π/2 \
                 are taken",
                used.light, light.kind
            )),
        }
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
