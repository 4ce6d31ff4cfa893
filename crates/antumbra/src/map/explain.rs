//! What was chosen on a device, in words.

use super::textures::Textures;
use crate::{capabilities::Capabilities, technique::Technique};

/// Formats and paths, one sentence each; `triangles` is the one about kept triangles, if any.
pub(super) fn lines(
    technique: &dyn Technique,
    capabilities: &Capabilities,
    textures: &Textures,
    triangles: Option<String>,
) -> Vec<String> {
    let mut lines = Vec::new();
    if !capabilities.clamps_depth() {
        lines.push(
            "no depth clamping (depth-clip-control): move vertices onto the near plane with caster_pancaked"
                .into(),
        );
    }
    lines.extend(technique.fallbacks(capabilities));
    lines.extend(triangles);
    let parts = technique.parts(capabilities);
    for (i, map) in textures.maps().iter().enumerate() {
        let format = map.texture.format();
        let integers = format.sample_type(None, None) == Some(wgpu::TextureSampleType::Uint);
        let way = match parts.as_slice() {
            // Other maps than the first are not read through `lookup_filtered`.
            _ if i > 0 => "",
            ["lookup_summed", ..] => ", a summed-area table (sixteen loads)",
            ["lookup_nearest", ..] => ", read one texel at a time",
            [_, "level_logarithmic", ..] => ", interpolated as powers by the shader (four loads)",
            [_, "level_manual", ..] => ", interpolated by the shader (four loads)",
            _ if integers => ", read one texel at a time",
            _ => ", interpolated by the sampler",
        };
        lines.push(format!("{} in {format:?}{way}", map.name));
        let together = capabilities.targets_per_pass(format).min(map.layers);
        if together < map.layers {
            lines.push(format!("{} layers of {} in passes of {together}", map.layers, map.name));
        }
    }
    if parts.contains(&"lookup_anisotropic") {
        lines.push(
            "anisotropic lookups by a loop in the shader, the same on every driver, not by the sampler"
                .into(),
        );
    }
    lines
}
