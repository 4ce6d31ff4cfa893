//! Nodes: where they are in the world.

use super::accessor::{Asset, follow};
use super::document::Node;
use super::selection::Shown;
use crate::import::error::{Problem, invalid};
use crate::import::notes::Notes;
use glam::{DMat4, DQuat, DVec3, DVec4};

/// Matrices of all nodes, and which of them the scene shows.
#[derive(Debug)]
pub(super) struct Hierarchy {
    /// One per node.
    pub(super) world_from_node: Vec<DMat4>,
    /// Nodes of the scene, parents before children.
    pub(super) shown: Vec<Shown>,
}

/// How far from 0, 0, 0, 1 the last row of a matrix may be. Six decimals in a text leave 5·10⁻⁷ and
/// products of single-precision matrices some 10⁻⁶; real perspective is a hundred times more.
const ROUNDING: f64 = 1e-5;

/// A matrix whose last row is 0, 0, 0, 1 but for rounding, without the rounding.
fn affine(mut matrix: DMat4, element: &str) -> Result<DMat4, Problem> {
    let last = matrix.row(3);
    if !(last - DVec4::W).abs().cmple(DVec4::splat(ROUNDING)).all() {
        let allowed = "its last row must be 0, 0, 0, 1, since nodes cannot project; apply the projection to \
                       the vertices, or leave it out";
        return Err(invalid(format!("{element}.matrix"), last, allowed));
    }
    for column in [&mut matrix.x_axis, &mut matrix.y_axis, &mut matrix.z_axis] {
        column.w = 0.0;
    }
    matrix.w_axis.w = 1.0;
    Ok(matrix)
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
    affine(matrix, element)
}

impl Asset {
    /// Places every node and lists those of a scene. Fails on nodes with two parents and on loops.
    pub(super) fn hierarchy(&self, scene: Option<usize>, notes: &mut Notes) -> Result<Hierarchy, Problem> {
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
        let origin = self.origin()?;
        let mut world_from_node = vec![None; nodes.len()];
        let mut stack: Vec<usize> = (0..nodes.len()).filter(|&i| parents[i].is_none()).collect();
        while let Some(i) = stack.pop() {
            let above = parents[i].and_then(|p: usize| world_from_node[p]).unwrap_or(origin);
            world_from_node[i] = Some(above * local(&nodes[i], &format!("nodes[{i}]"))?);
            stack.extend(&nodes[i].children);
        }
        let placed = world_from_node.iter().enumerate().map(|(i, matrix)| {
            let error = || invalid(format!("nodes[{i}].children"), "part of a loop", "nodes must form trees");
            matrix.ok_or_else(error)
        });
        let world_from_node = placed.collect::<Result<Vec<_>, _>>()?;
        let shown = self.nodes_of(scene, &parents, notes)?;
        Ok(Hierarchy { world_from_node, shown })
    }
}
