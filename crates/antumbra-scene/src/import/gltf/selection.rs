//! Which scene of a file is shown, and which of its nodes.

use super::accessor::{Asset, follow};
use super::container;
use super::document::{Center, Levels, Visibility};
use crate::import::error::{Problem, invalid};
use crate::import::notes::Notes;
use crate::import::options;
use glam::{DMat4, DVec3};

const VISIBILITY: &str = "KHR_node_visibility";
const LEVELS: &str = "MSFT_lod";

/// A node that the scene has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shown {
    pub(super) node: usize,
    /// Whether its mesh and light are left out; cameras are not meant by it.
    pub(super) hidden: bool,
}

impl Asset {
    /// The scene that is shown: the one asked for, else the default one, else the first. `None` if the
    /// file has no scenes, and all nodes are meant.
    pub(super) fn scene(&self, wanted: Option<&str>, notes: &mut Notes) -> Result<Option<usize>, Problem> {
        let document = &self.document;
        let names: Vec<Option<&str>> = document.scenes.iter().map(|s| s.name.as_deref()).collect();
        if let Some(wanted) = wanted {
            return options::choose("scenes", "scene", wanted, &names).map(Some);
        }
        if names.is_empty() && document.scene.is_none() {
            return Ok(None);
        }
        let index = document.scene.unwrap_or(0);
        follow(&document.scenes, "scenes", index, "scene")?;
        if names.len() > 1 {
            let which =
                if document.scene.is_some() { "the default" } else { "the first, none is the default" };
            notes.say(format!(
                "the file has {} scenes: {}; {} is shown ({which}); another one with --scene",
                names.len(),
                listed(&names),
                shown(index, names[index])
            ));
        }
        Ok(Some(index))
    }

    /// The nodes of a scene, parents before children, without coarser levels of detail.
    pub(super) fn nodes_of(
        &self,
        scene: Option<usize>,
        parents: &[Option<usize>],
        notes: &mut Notes,
    ) -> Result<Vec<Shown>, Problem> {
        let coarse = self.coarse()?;
        let mut shown = Vec::new();
        for root in self.roots(scene, parents)? {
            let mut stack = vec![Shown { node: root, hidden: false }];
            while let Some(Shown { node, hidden }) = stack.pop() {
                let element = format!("nodes[{node}]");
                if coarse[node] {
                    notes.add(element, format!("left out: a coarser level of detail ({LEVELS})"));
                    continue;
                }
                let node_of = &self.document.nodes[node];
                let said = container::extension::<Visibility>(&node_of.extensions, VISIBILITY, &element)?;
                let hidden = hidden || said.is_some_and(|v| !v.visible);
                if hidden {
                    notes.add(element, format!("left out: hidden ({VISIBILITY})"));
                }
                shown.push(Shown { node, hidden });
                stack.extend(node_of.children.iter().rev().map(|&node| Shown { node, hidden }));
            }
        }
        Ok(shown)
    }

    /// The roots of a scene; without one, of the file.
    fn roots(&self, scene: Option<usize>, parents: &[Option<usize>]) -> Result<Vec<usize>, Problem> {
        let document = &self.document;
        let Some(index) = scene else {
            return Ok((0..parents.len()).filter(|&i| parents[i].is_none()).collect());
        };
        let scene = follow(&document.scenes, "scenes", index, "scene")?;
        let mut seen = vec![false; parents.len()];
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
        }
        Ok(scene.nodes.clone())
    }

    /// For each node whether it is a coarser stand-in for another.
    fn coarse(&self) -> Result<Vec<bool>, Problem> {
        let nodes = &self.document.nodes;
        let mut coarse = vec![false; nodes.len()];
        for (fine, node) in nodes.iter().enumerate() {
            let element = format!("nodes[{fine}]");
            let levels = container::extension::<Levels>(&node.extensions, LEVELS, &element)?;
            for id in levels.into_iter().flat_map(|levels| levels.ids).filter(|&id| id != fine) {
                follow(nodes, "nodes", id, &format!("{element}.extensions.{LEVELS}.ids"))?;
                coarse[id] = true;
            }
        }
        Ok(coarse)
    }

    /// Where the file's own origin is (`CESIUM_RTC`): it moves every root.
    pub(super) fn origin(&self) -> Result<DMat4, Problem> {
        let center: Option<Center> =
            container::extension(&self.document.extensions, "CESIUM_RTC", "document")?;
        Ok(center.map_or(DMat4::IDENTITY, |c| DMat4::from_translation(DVec3::from(c.center))))
    }
}

/// A number and, if there is one, a name.
pub(super) fn shown(number: usize, name: Option<&str>) -> String {
    name.map_or_else(|| number.to_string(), |name| format!("{number} '{name}'"))
}

/// Numbers and names, at most ten.
pub(super) fn listed(names: &[Option<&str>]) -> String {
    let mut all: Vec<String> = names.iter().take(10).enumerate().map(|(i, name)| shown(i, *name)).collect();
    if names.len() > all.len() {
        all.push("…".into());
    }
    all.join(", ")
}
