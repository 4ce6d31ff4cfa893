//! What was chosen on a device, in words.

use super::Options;
use crate::{capabilities::Capabilities, describe::Description, light::Size};

/// Formats and paths, one sentence each; `triangles` is the one about kept triangles, if any.
pub(super) fn lines(
    description: &Description,
    capabilities: &Capabilities,
    options: &Options,
    triangles: Option<String>,
) -> Vec<String> {
    let mut lines = Vec::new();
    if !capabilities.clamps_depth() {
        lines.push(
            "no depth clamping (depth-clip-control): move vertices onto the near plane with caster_pancaked"
                .into(),
        );
    }
    if let Some(layers) = options.layers {
        let Size { width, height } = options.size;
        lines.push(format!(
            "up to {} views, each in a tile of {layers} layers of {width}×{height} texels",
            options.views
        ));
    }
    lines.extend(description.notes.iter().cloned());
    lines.extend(triangles);
    for map in &description.maps {
        lines.push(format!("{} in {:?}, {}", map.name, map.format, map.access.words()));
        let together = capabilities.targets_per_pass(map.format).min(map.layers);
        if together < map.layers {
            lines.push(format!("{} layers of {} in passes of {together}", map.layers, map.name));
        }
    }
    lines
}
