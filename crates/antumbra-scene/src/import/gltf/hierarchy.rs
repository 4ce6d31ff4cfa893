//! Nodes: where they are in the world.

use super::accessor::{Asset, follow};
use super::document::Node;
use crate::import::error::{Problem, invalid};
use glam::{DMat4, DQuat, DVec3};

/// Matrices of all nodes, and which of them the scene shows.
#[derive(Debug)]
pub(super) struct Hierarchy {
    /// One per node.
    pub(super) world_from_node: Vec<DMat4>,
    /// Nodes of the scene, parents before children.
    pub(super) shown: Vec<usize>,
}

/// The matrix of a node relative to its parent.
fn local(node: &Node, element: &str) -> Result<DMat4, Problem> {
    let matrix = if let Some(columns) = node.matrix {
        DMat4::from_cols_array(&columns)
    } else {
        let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let rotation = DQuat::from_xyzw(x, y, z, w);
        if !(rotation.length() > 1e-6 && rotation.is_finite()) {
            return Err(invalid(format!("{element}.rotation"), rotation, "its length must be 1"));
        }
        let scale = node.scale.map_or(DVec3::ONE, DVec3::from);
        let translation = node.translation.map_or(DVec3::ZERO, DVec3::from);
        DMat4::from_scale_rotation_translation(scale, rotation.normalize(), translation)
    };
    let last = matrix.row(3);
    if last != glam::DVec4::W {
        return Err(invalid(format!("{element}.matrix"), last, "its last row must be 0, 0, 0, 1"));
    }
    Ok(matrix)
}

impl Asset {
    /// Places every node. Fails on nodes with two parents and on loops.
    pub(super) fn hierarchy(&self) -> Result<Hierarchy, Problem> {
        let nodes = &self.document.nodes;
        let mut parents = vec![None; nodes.len()];
        for (parent, node) in nodes.iter().enumerate() {
            for (place, &child) in node.children.iter().enumerate() {
                let element = format!("nodes[{parent}].children[{place}]");
                follow(nodes, "nodes", child, &element)?;
                if let Some(other) = parents[child].replace(parent) {
                    let allowed = format!("that node is already a child of nodes[{other}]");
                    return Err(invalid(element, child, allowed));
                }
            }
        }
        let mut world_from_node = vec![None; nodes.len()];
        let mut stack: Vec<usize> = (0..nodes.len()).filter(|&i| parents[i].is_none()).collect();
        while let Some(i) = stack.pop() {
            let above = parents[i].and_then(|p: usize| world_from_node[p]).unwrap_or(DMat4::IDENTITY);
            world_from_node[i] = Some(above * local(&nodes[i], &format!("nodes[{i}]"))?);
            stack.extend(&nodes[i].children);
        }
        let placed = world_from_node.iter().enumerate().map(|(i, matrix)| {
            let error = || invalid(format!("nodes[{i}].children"), "part of a loop", "nodes must form trees");
            matrix.ok_or_else(error)
        });
        let world_from_node = placed.collect::<Result<Vec<_>, _>>()?;
        let shown = self.shown(&parents)?;
        Ok(Hierarchy { world_from_node, shown })
    }

    /// The nodes of the default scene, else of the first, else all.
    fn shown(&self, parents: &[Option<usize>]) -> Result<Vec<usize>, Problem> {
        let document = &self.document;
        if document.scenes.is_empty() && document.scene.is_none() {
            return Ok((0..parents.len()).collect());
        }
        let index = document.scene.unwrap_or(0);
        let scene = follow(&document.scenes, "scenes", index, "scene")?;
        let mut seen = vec![false; parents.len()];
        let mut shown = Vec::new();
        for (place, &root) in scene.nodes.iter().enumerate() {
            let element = format!("scenes[{index}].nodes[{place}]");
            follow(&document.nodes, "nodes", root, &element)?;
            if let Some(parent) = parents[root] {
                let allowed = format!("only roots are allowed, and that is a child of nodes[{parent}]");
                return Err(invalid(element, root, allowed));
            }
            if std::mem::replace(&mut seen[root], true) {
                return Err(invalid(element, root, "each node may appear once"));
            }
            let mut stack = vec![root];
            while let Some(i) = stack.pop() {
                shown.push(i);
                stack.extend(document.nodes[i].children.iter().rev());
            }
        }
        Ok(shown)
    }
}
