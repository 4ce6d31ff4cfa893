//! Skins: meshes posed by their joints as the file leaves them.

use super::accessor::{Asset, Format, follow};
use super::hierarchy::Hierarchy;
use crate::import::error::{Problem, invalid};
use crate::import::vertices::Vertices;
use glam::{DMat3, DMat4, DVec3};

impl Asset {
    /// The matrices `world_from_joint · joint_from_mesh` of a skin.
    pub(super) fn joint_matrices(&self, skin: usize, hierarchy: &Hierarchy) -> Result<Vec<DMat4>, Problem> {
        let element = format!("skins[{skin}]");
        let skin = follow(&self.document.skins, "skins", skin, "a node's skin")?;
        let bind = match skin.inverse_bind_matrices {
            Some(index) => {
                let element = format!("{element}.inverseBindMatrices");
                let table = self.table(index, &element)?;
                if table.shape != "MAT4" || table.format != Format::F32 || table.count < skin.joints.len() {
                    return Err(invalid(
                        element,
                        format!("{} × {} {:?}", table.count, table.shape, table.format),
                        format!("there must be {} MAT4 of F32, one for each joint", skin.joints.len()),
                    ));
                }
                let matrix = |i| DMat4::from_cols_array(&std::array::from_fn(|k| table.float(i, k).into()));
                (0..skin.joints.len()).map(matrix).collect()
            }
            None => vec![DMat4::IDENTITY; skin.joints.len()],
        };
        let place = |(i, (&joint, bind)): (usize, (&usize, &DMat4))| {
            let world =
                follow(&hierarchy.world_from_node, "nodes", joint, &format!("{element}.joints[{i}]"))?;
            Ok(*world * *bind)
        };
        skin.joints.iter().zip(&bind).enumerate().map(place).collect()
    }
}

impl Vertices {
    /// Moves the vertices into the world by their joints (glTF 2.0, section 3.7.3.3: the node's own
    /// transform plays no part). Weights are used as they are.
    pub(super) fn pose(&mut self, matrices: &[DMat4], element: &str) -> Result<(), Problem> {
        for (i, joints) in self.joints.iter().enumerate() {
            let mut blend = DMat4::ZERO;
            for &(joint, weight) in joints {
                let Some(matrix) = matrices.get(joint as usize) else {
                    return Err(invalid(
                        format!("{element}.attributes.JOINTS_n[{i}]"),
                        joint,
                        format!("the skin has {} joints", matrices.len()),
                    ));
                };
                blend += *matrix * f64::from(weight);
            }
            self.positions[i] = blend.transform_point3(self.positions[i].as_dvec3()).as_vec3();
            if let Some(normal) = self.normals.get_mut(i) {
                let m = DMat3::from_mat4(blend);
                let columns = [m.x_axis, m.y_axis, m.z_axis];
                let cross = |a: usize, b: usize| -> DVec3 { columns[a].cross(columns[b]) };
                let cofactor = DMat3::from_cols(cross(1, 2), cross(2, 0), cross(0, 1));
                *normal = (cofactor * normal.as_dvec3()).normalize_or_zero().as_vec3();
            }
        }
        Ok(())
    }
}
