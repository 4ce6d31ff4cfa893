//! What becomes of surfaces that let light through, once their vertices are known.

use super::material::Passing;
use crate::import::notes::Notes;
use crate::import::options::Blend;
use crate::{AlphaMode, Instance, Scene};

/// A blended surface is there where its alpha is at least this.
const HALF: f32 = 0.5;

/// Leaves out the instances of surfaces that are there nowhere, makes those opaque that are there
/// everywhere, and says so. Where that would leave nothing all of them stay.
pub(super) fn settle(scene: &mut Scene, passing: &[Passing], blend: Blend, notes: &mut Notes) {
    let said = notes.clone();
    let mut gone = vec![false; scene.materials.len()];
    let mut used = vec![false; scene.materials.len()];
    for instance in &scene.instances {
        used[scene.meshes[instance.mesh].material] = true;
    }
    for (m, passing) in passing.iter().enumerate().filter(|(m, _)| used[*m]) {
        let element = format!("material '{}'", scene.materials[m].name);
        match passing {
            Passing::None => {}
            Passing::All => {
                gone[m] = true;
                notes.add(element, left_out(blend));
            }
            Passing::Blend => match alpha_range(scene, m) {
                [min, _] if min >= HALF => {
                    scene.materials[m].alpha = AlphaMode::Opaque;
                    notes.add(element, "blends; its alpha is ½ or more everywhere, so it casts as if opaque");
                }
                [_, max] if max < HALF => {
                    gone[m] = true;
                    notes.add(element, left_out(blend));
                }
                _ => notes.add(
                    element,
                    "blends; it is there and casts where its alpha is ½ or more (--blend cast: everywhere, \
                     --blend ignore: nowhere)",
                ),
            },
        }
    }
    let meshes = &scene.meshes;
    let kept = |instance: &Instance| !gone[meshes[instance.mesh].material];
    if blend == Blend::Mask && !scene.instances.is_empty() && !scene.instances.iter().any(kept) {
        *notes = said;
        notes.say("everything lets half of the light or more through; it is kept and casts, or nothing would be left");
        scene.materials.iter_mut().for_each(|material| material.alpha = AlphaMode::Opaque);
        return;
    }
    scene.instances.retain(kept);
}

fn left_out(blend: Blend) -> &'static str {
    match blend {
        Blend::Ignore => "lets light through and is left out, as asked for",
        _ => {
            "lets half of the light or more through, so it is left out and casts no shadow (--blend cast keeps it)"
        }
    }
}

/// Least and most alpha that a material can have anywhere: factor, image and vertices together.
fn alpha_range(scene: &Scene, material: usize) -> [f32; 2] {
    let surface = &scene.materials[material];
    let image = surface.base_color_image.and_then(|i| scene.images.get(i)).map_or([1.0; 2], |image| {
        let alphas = image.rgba.iter().skip(3).step_by(4);
        alphas.fold([u8::MAX, 0], |[min, max], &a| [min.min(a), max.max(a)]).map(|a| f32::from(a) / 255.0)
    });
    let colors = scene.meshes.iter().filter(|mesh| mesh.material == material).flat_map(|mesh| &mesh.colors);
    let vertices = colors.fold([f32::MAX, 0.0_f32], |[min, max], c| [min.min(c.w), max.max(c.w)]);
    [0, 1].map(|end| surface.base_color.w * image[end] * vertices[end])
}
