//! The origin of a scene whose nodes stand far from that of their file.

use super::accessor::Asset;
use super::hierarchy::Hierarchy;
use crate::bulk;
use glam::{DMat4, DVec3};
use std::collections::HashMap;

/// Vertices of a primitive that are looked at, at most.
const SAMPLE: usize = 16;

impl Asset {
    /// Moves all nodes, so that what they place lies around the origin, if it is far from there. Returns the
    /// point of the file that is the origin then. What is broken is left to those who need it.
    ///
    /// Cost: decodes every position once.
    pub(super) fn settle(&self, hierarchy: &mut Hierarchy) -> DVec3 {
        let mut known = HashMap::new();
        let mut points = Vec::new();
        for node in hierarchy.shown.iter().filter(|shown| !shown.hidden).map(|shown| shown.node) {
            let Some(mesh) = self.document.nodes[node].mesh else { continue };
            // Joints place skinned meshes, wherever their node is.
            let world = match self.document.nodes[node].skin {
                Some(skin) => self.joint_matrices(skin, hierarchy).ok().and_then(|m| m.first().copied()),
                None => Some(hierarchy.world_from_node[node]),
            };
            let world = world.unwrap_or(DMat4::IDENTITY);
            for primitive in self.document.meshes.get(mesh).map_or(&[][..], |mesh| &mesh.primitives) {
                let Some(&accessor) = primitive.attributes.get("POSITION") else { continue };
                let own = known.entry(accessor).or_insert_with(|| self.sample(accessor));
                points.extend(own.iter().map(|p| world.transform_point3(*p)));
            }
        }
        let origin = bulk::origin(&points);
        if origin != DVec3::ZERO {
            let shift = DMat4::from_translation(-origin);
            hierarchy.world_from_node.iter_mut().for_each(|world| *world = shift * *world);
        }
        origin
    }

    /// Some positions of an accessor.
    fn sample(&self, accessor: usize) -> Vec<DVec3> {
        let Some(table) = self.table(accessor, "POSITION").ok().filter(|table| table.width == 3) else {
            return Vec::new();
        };
        let stride = table.count.div_ceil(SAMPLE).max(1);
        let point = |i| DVec3::from_array([0, 1, 2].map(|k| table.float(i, k).into()));
        (0..table.count).step_by(stride).map(point).collect()
    }
}
