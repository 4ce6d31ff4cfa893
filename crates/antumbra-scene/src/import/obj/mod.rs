//! Wavefront OBJ: polygons by line, with one mesh for each group and material.

mod files;
mod library;
mod map;
mod material;
mod parser;
mod polygon;
#[cfg(test)]
mod tests;

use super::error::Problem;
use super::notes::Notes;
use super::vertices::Vertices;
use crate::bulk;
use crate::import::options::Blend;
use crate::{Instance, Node, Placement, Scene, SceneError};
use files::Files;
use glam::{DMat4, DVec3, Vec2, Vec3, Vec4};
use material::Materials;
use parser::{NONE, Parser, Part};
use polygon::{Cutter, Filled};
use rustc_hash::FxHashMap;
use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// Imports a file with its material libraries and images.
pub(super) fn import(path: &Path, blend: Blend) -> Result<Scene, Problem> {
    let bytes = fs::read(path).map_err(Problem::Read)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let files = Files::Folder(path.parent().unwrap_or(Path::new("")).to_path_buf());
    read(&files::text(&bytes), &files, &name, blend)
}

/// Imports a file from its bytes, with the names and contents of the others that it may name.
pub(super) fn import_bytes(
    bytes: &[u8],
    others: &[(&str, &[u8])],
    name: &str,
    blend: Blend,
) -> Result<Scene, Problem> {
    read(&files::text(bytes), &Files::Memory(others), name, blend)
}

fn read(text: &str, files: &Files, name: &str, blend: Blend) -> Result<Scene, Problem> {
    let mut parser = Parser::read(text)?;
    let origin = bulk::origin(&parser.positions);
    let mut scene = Scene {
        name: name.into(),
        placement: Placement { origin, ..Placement::default() },
        ..Scene::default()
    };
    let mut notes = Notes::default();
    let mut materials = Materials::read(&parser.libraries, files, blend, &mut notes);
    let mut nodes = Nodes::default();
    let mut builder = Builder { origin, cutter: Cutter::default(), crossed: 0 };
    for part in std::mem::take(&mut parser.parts) {
        if part.faces.is_empty() {
            continue;
        }
        let material = materials.number(&part.material, &mut notes);
        let mut mesh = builder.vertices(&parser, &part).into_mesh(part.name(), material);
        materials.place(&mut mesh.uvs, material);
        scene.meshes.push(mesh);
        if !materials.is_left_out(material) {
            let (mesh, node) = (scene.meshes.len() - 1, nodes.of(&part));
            scene.instances.push(Instance { mesh, node, world_from_mesh: DMat4::IDENTITY });
        }
    }
    scene.nodes = nodes.list;
    (scene.materials, scene.images) = materials.finish();
    if builder.crossed > 0 {
        notes.say(format!("{} faces have no area or an outline that crosses itself", builder.crossed));
    }
    scene.notes = parser.notes().chain(notes.sentences()).collect();
    scene.note_placement();
    match scene.validate() {
        Ok(()) => Ok(scene),
        Err(source @ SceneError::NoTriangles { .. }) if !scene.notes.is_empty() => {
            Err(Problem::NothingLeft { source, notes: scene.notes.join("; ") })
        }
        Err(problem) => Err(problem.into()),
    }
}

impl Part {
    /// What the part is called in messages.
    fn name(&self) -> &str {
        if self.group.is_empty() { &self.object } else { &self.group }
    }
}

/// Objects, and the groups below them.
#[derive(Debug, Default)]
struct Nodes {
    list: Vec<Node>,
    places: HashMap<(Option<usize>, String), usize>,
}

impl Nodes {
    /// The group or object of a part, if it has one with a name.
    fn of(&mut self, part: &Part) -> Option<usize> {
        let object = self.place(None, &part.object);
        self.place(object, &part.group).or(object)
    }

    fn place(&mut self, parent: Option<usize>, name: &str) -> Option<usize> {
        if name.is_empty() {
            return None;
        }
        let next = self.list.len();
        let place = *self.places.entry((parent, name.to_owned())).or_insert(next);
        if place == next {
            self.list.push(Node { name: name.to_owned(), parent });
        }
        Some(place)
    }
}

/// Makes meshes of parts.
struct Builder {
    origin: DVec3,
    cutter: Cutter,
    /// Faces that are no simple polygons.
    crossed: usize,
}

impl Builder {
    /// The vertices of a part, each once if they have normals, else each corner's own.
    fn vertices(&mut self, parser: &Parser, part: &Part) -> Vertices {
        let mut vertices = Vertices::default();
        let mut seen: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let (mut begin, mut outline, mut numbers) = (0, Vec::new(), Vec::new());
        for &count in &part.faces {
            let corners = &part.corners[begin..begin + count as usize];
            begin += count as usize;
            numbers.clear();
            for corner in corners {
                let next = vertices.positions.len() as u32;
                let number = if part.lacks_normals { next } else { *seen.entry(*corner).or_insert(next) };
                if number == next {
                    self.push(&mut vertices, parser, part, *corner);
                }
                numbers.push(number);
            }
            outline.clear();
            outline.extend(corners.iter().map(|[position, ..]| self.place(parser, *position)));
            let (triangles, filled) = self.cutter.cut(&outline);
            vertices.triangles.extend(triangles.iter().map(|&i| numbers[i as usize]));
            self.crossed += usize::from(filled == Filled::Crossed);
        }
        vertices
    }

    fn place(&self, parser: &Parser, position: u32) -> DVec3 {
        parser.positions[position as usize] - self.origin
    }

    fn push(&self, vertices: &mut Vertices, parser: &Parser, part: &Part, [position, uv, normal]: [u32; 3]) {
        vertices.positions.push(self.place(parser, position).as_vec3());
        let color = parser.colors.get(position as usize);
        vertices.colors.push(color.map_or(Vec4::ONE, |color: &Vec3| color.extend(1.0)));
        vertices.uvs.push(if uv == NONE { Vec2::ZERO } else { parser.uvs[uv as usize] });
        if !part.lacks_normals {
            vertices.normals.push(parser.normals[normal as usize]);
        }
    }
}
