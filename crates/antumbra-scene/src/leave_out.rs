//! Leaving parts of a scene out by their names.

use crate::Scene;
use std::collections::BTreeSet;

/// Nothing in a scene has a name that was asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("nothing in the scene is called '{pattern}'; nodes, meshes and materials have {} names", known.len())]
pub struct UnknownName {
    /// What was asked for.
    pub pattern: String,
    /// All names of nodes, meshes and materials, sorted.
    pub known: Vec<String>,
}

impl Scene {
    /// Leaves out every part that has such a name, or whose mesh or material has it, or that hangs on a node
    /// that has it. In a pattern `*` stands for any letters and `?` for any one. Returns the number of parts
    /// that are left out.
    ///
    /// Cost: compares each name with each pattern.
    ///
    /// # Errors
    /// The first pattern that fits no name; then the scene is unchanged.
    pub fn leave_out<S: AsRef<str>>(&mut self, patterns: &[S]) -> Result<usize, UnknownName> {
        let patterns: Vec<&str> = patterns.iter().map(AsRef::as_ref).collect();
        for pattern in &patterns {
            if !self.names().any(|name| fits(pattern, name)) {
                let known: BTreeSet<&str> = self.names().filter(|name| !name.is_empty()).collect();
                let known = known.into_iter().map(str::to_owned).collect();
                return Err(UnknownName { pattern: (*pattern).to_owned(), known });
            }
        }
        let gone = |name: &str| patterns.iter().any(|pattern| fits(pattern, name));
        let materials: Vec<bool> = self.materials.iter().map(|m| gone(&m.name)).collect();
        let meshes: Vec<bool> = self
            .meshes
            .iter()
            .map(|m| gone(&m.name) || gone(whole(&m.name)) || materials.get(m.material) == Some(&true))
            .collect();
        let nodes = self.below(self.nodes.iter().map(|node| gone(&node.name)).collect());
        let before = self.instances.len();
        self.instances.retain(|i| {
            let of_node = i.node.and_then(|node| nodes.get(node)).copied().unwrap_or(false);
            !of_node && !meshes.get(i.mesh).copied().unwrap_or(false)
        });
        Ok(before - self.instances.len())
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        let nodes = self.nodes.iter().map(|node| node.name.as_str());
        let meshes = self.meshes.iter().flat_map(|mesh| [mesh.name.as_str(), whole(&mesh.name)]);
        nodes.chain(meshes).chain(self.materials.iter().map(|material| material.name.as_str()))
    }

    /// Marks all nodes that hang on a marked one.
    fn below(&self, mut marked: Vec<bool>) -> Vec<bool> {
        // Each path upwards ends at a node that is known already.
        let mut known = vec![false; marked.len()];
        for start in 0..marked.len() {
            let mut path = Vec::new();
            let mut next = Some(start);
            while let Some(node) = next.filter(|&node| node < marked.len() && !known[node]) {
                known[node] = true;
                path.push(node);
                next = self.nodes[node].parent;
            }
            let mut above = next.and_then(|node| marked.get(node)).copied().unwrap_or(false);
            for node in path.into_iter().rev() {
                above |= marked[node];
                marked[node] = above;
            }
        }
        marked
    }
}

/// The name of a glTF mesh that a primitive belongs to: without the `[0]` behind it.
fn whole(name: &str) -> &str {
    let number = name.strip_suffix(']').and_then(|name| name.rsplit_once('['));
    number.filter(|(_, digits)| digits.bytes().all(|b| b.is_ascii_digit())).map_or(name, |(name, _)| name)
}

/// Whether a name fits a pattern with `*` and `?`.
fn fits(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // The last star, and how far it reaches.
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(&c) if c == '?' || c == name[n] => {
                p += 1;
                n += 1;
            }
            _ => match &mut star {
                Some((place, reach)) => {
                    *reach += 1;
                    (p, n) = (*place + 1, *reach);
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Instance, Material, Mesh, Node};
    use glam::DMat4;

    /// Three parts: a sky on a node of its own, a door and a window of one house.
    fn scene() -> Scene {
        let node = |name: &str, parent| Node { name: name.into(), parent };
        let mesh = |name: &str, material| Mesh { name: name.into(), material, ..Mesh::default() };
        let on = |mesh, node| Instance { node: Some(node), ..Instance::new(mesh, DMat4::IDENTITY) };
        let material = |name: &str| Material { name: name.into(), ..Material::default() };
        Scene {
            // The children come before what they hang on.
            nodes: vec![
                node("door", Some(3)),
                node("pane", Some(3)),
                node("SkyDome", None),
                node("house", None),
            ],
            meshes: vec![mesh("dome[0]", 0), mesh("leaf[0]", 1), mesh("leaf[1]", 2)],
            materials: vec![material("blue"), material("wood"), material("glass")],
            instances: vec![on(0, 2), on(1, 0), on(2, 1)],
            ..Scene::default()
        }
    }

    fn left(patterns: &[&str]) -> Vec<usize> {
        let mut scene = scene();
        let count = scene.leave_out(patterns).unwrap();
        assert_eq!(count, 3 - scene.instances.len());
        scene.instances.iter().map(|i| i.mesh).collect()
    }

    #[test]
    fn nodes_meshes_and_materials_are_left_out() {
        assert_eq!(left(&[]), [0, 1, 2]);
        assert_eq!(left(&["SkyDome"]), [1, 2]);
        assert_eq!(left(&["house"]), [0], "with all below it");
        assert_eq!(left(&["leaf"]), [0], "all of its parts");
        assert_eq!(left(&["leaf[1]"]), [0, 1]);
        assert_eq!(left(&["glass", "blue"]), [1]);
        assert_eq!(left(&["Sky*", "?oor"]), [2]);
        assert!(left(&["*"]).is_empty());
    }

    #[test]
    fn unknown_names_change_nothing() {
        let mut scene = scene();
        let error = scene.leave_out(&["house", "SkyDom"]).unwrap_err();
        assert_eq!(error.pattern, "SkyDom");
        assert!(error.known.contains(&"SkyDome".into()) && error.known.contains(&"leaf".into()));
        assert_eq!(scene.instances.len(), 3);
    }

    #[test]
    fn patterns_fit_whole_names() {
        for (pattern, name, expected) in [
            ("a*c", "abbc", true),
            ("a*c", "ac", true),
            ("a*c", "acb", false),
            ("*", "", true),
            ("", "", true),
            ("", "a", false),
            ("?", "", false),
            ("*a*b*", "xaxbx", true),
            ("*ab", "aab", true),
            ("A", "a", false),
        ] {
            assert_eq!(fits(pattern, name), expected, "{pattern} {name}");
        }
    }
}
