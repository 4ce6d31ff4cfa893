//! Lists, strips and fans to triangles.

use crate::import::error::{Problem, invalid};

/// How drawing order makes triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Topology {
    List,
    Strip,
    Fan,
}

/// The topology of a primitive's mode; `None` for points and lines.
pub(super) fn from_mode(mode: u64, element: &str) -> Result<Option<Topology>, Problem> {
    match mode {
        0..=3 => Ok(None),
        4 => Ok(Some(Topology::List)),
        5 => Ok(Some(Topology::Strip)),
        6 => Ok(Some(Topology::Fan)),
        _ => Err(invalid(format!("{element}.mode"), mode, "allowed are 0 to 6")),
    }
}

impl Topology {
    /// Three corners per triangle (glTF 2.0, section 3.7.2.1); an incomplete last one is dropped.
    pub(super) fn triangles(self, corners: &[u32]) -> Vec<u32> {
        let three = |[a, b, c]: [usize; 3]| [corners[a], corners[b], corners[c]];
        let rest = corners.len().saturating_sub(2);
        match self {
            Self::List => corners[..corners.len() / 3 * 3].to_vec(),
            Self::Strip => (0..rest).flat_map(|i| three([i, i + 1 + i % 2, i + 2 - i % 2])).collect(),
            Self::Fan => (0..rest).flat_map(|i| three([i + 1, i + 2, 0])).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_winding() {
        assert_eq!(Topology::List.triangles(&[0, 1, 2, 3]), [0, 1, 2]);
        assert_eq!(Topology::Strip.triangles(&[0, 1, 2, 3]), [0, 1, 2, 1, 3, 2]);
        assert_eq!(Topology::Fan.triangles(&[0, 1, 2, 3]), [1, 2, 0, 2, 3, 0]);
        for topology in [Topology::List, Topology::Strip, Topology::Fan] {
            assert!(topology.triangles(&[0, 1]).is_empty());
        }
    }
}
