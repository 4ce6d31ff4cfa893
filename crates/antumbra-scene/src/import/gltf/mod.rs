//! glTF 2.0, read by our own schema: only what makes scenes is parsed, and every index is checked
//! where it is followed.

mod accessor;
mod animation;
mod blend;
mod container;
mod document;
mod extensions;
mod hierarchy;
mod material;
mod meshopt;
mod origin;
mod primitive;
mod selection;
mod skin;
mod texture;
mod topology;
mod transmission;
mod views;

use super::error::{Problem, invalid};
use super::notes::Notes;
use super::options::Options;
use crate::{Instance, Node, Placement, Scene, SceneError};
use accessor::{Asset, follow};
use document::{Document, Instancing, PunctualLight};
use glam::{DMat4, DQuat, DVec3};
use hierarchy::Hierarchy;
use material::{Source, Surfaces};
use selection::Shown;
use std::collections::HashMap;
use std::path::Path;

/// Imports a file from its bytes; `folder` is where its other files are, if it may have any.
pub(super) fn import(
    bytes: &[u8],
    folder: Option<&Path>,
    name: &str,
    options: &Options,
) -> Result<Scene, Problem> {
    let mut notes = Notes::default();
    let (json, binary) = container::split(bytes)?;
    let document: Document = container::parse(json)?;
    container::check(&document)?;
    extensions::check(&document, &mut notes)?;
    let buffers = container::buffers(&document, binary, folder)?;
    let mut asset = Asset { document, buffers, decoded: Vec::new() };
    asset.check()?;
    asset.decompress()?;
    asset.animate(options, &mut notes)?;
    let shown = asset.scene(options.scene.as_deref(), &mut notes)?;
    let mut hierarchy = asset.hierarchy(shown, &mut notes)?;
    let placement = Placement { origin: asset.settle(&mut hierarchy), ..Placement::default() };
    let source = Source { asset: &asset, folder, blend: options.blend };
    let surfaces = Surfaces::read(&source, &mut notes)?;
    let mut scene = Scene { name: name.into(), placement, nodes: asset.nodes(), ..Scene::default() };
    let lights = asset.number_views(&mut scene)?;
    let mut placer = Placer {
        asset: &asset,
        hierarchy,
        surfaces,
        lights,
        scene,
        notes,
        placed: HashMap::new(),
        skipped: 0,
    };
    for place in 0..placer.hierarchy.shown.len() {
        placer.node(placer.hierarchy.shown[place])?;
    }
    if asset.document.nodes.is_empty()
        && asset.document.scenes.is_empty()
        && !asset.document.meshes.is_empty()
    {
        placer.library()?;
    }
    let mut scene = placer.finish(options);
    scene.note_placement();
    match scene.validate() {
        Ok(()) => Ok(scene),
        Err(source @ SceneError::NoTriangles { .. }) if !scene.notes.is_empty() => {
            Err(Problem::NothingLeft { source, notes: scene.notes.join("; ") })
        }
        Err(problem) => Err(problem.into()),
    }
}

/// Walks the nodes and fills the scene.
#[derive(Debug)]
struct Placer<'a> {
    asset: &'a Asset,
    hierarchy: Hierarchy,
    surfaces: Surfaces,
    /// The lights that nodes use.
    lights: Vec<PunctualLight>,
    scene: Scene,
    notes: Notes,
    /// Scene meshes of each glTF mesh without skin or weights of its own.
    placed: HashMap<usize, Vec<usize>>,
    /// Primitives that draw no triangles.
    skipped: usize,
}

impl Placer<'_> {
    fn node(&mut self, Shown { node: index, hidden }: Shown) -> Result<(), Problem> {
        let asset = self.asset;
        let world = self.hierarchy.world_from_node[index];
        asset.add_camera(&mut self.scene, index, world, &mut self.notes)?;
        if hidden {
            return Ok(());
        }
        asset.add_light(&mut self.scene, &self.lights, (index, world), &mut self.notes)?;
        let node = &asset.document.nodes[index];
        let Some(mesh) = node.mesh else { return Ok(()) };
        let element = format!("nodes[{index}]");
        follow(&asset.document.meshes, "meshes", mesh, &format!("{element}.mesh"))?;
        if let Some(skin) = node.skin {
            let matrices = asset.joint_matrices(skin, &self.hierarchy)?;
            return self.skinned(index, &matrices);
        }
        let meshes = match (&node.weights, self.placed.get(&mesh)) {
            (None, Some(meshes)) => meshes.clone(),
            (weights, _) => {
                let meshes: Vec<usize> =
                    self.mesh(mesh, weights.as_deref(), None)?.into_iter().map(|(mesh, _)| mesh).collect();
                if weights.is_none() {
                    self.placed.insert(mesh, meshes.clone());
                }
                meshes
            }
        };
        let copies = instances(asset, index, &element)?;
        for copy in copies {
            self.place(&meshes, Some(index), world * copy);
        }
        Ok(())
    }

    /// Places every mesh once: a document without nodes is a library of meshes.
    fn library(&mut self) -> Result<(), Problem> {
        for mesh in 0..self.asset.document.meshes.len() {
            let added: Vec<usize> = self.mesh(mesh, None, None)?.into_iter().map(|(mesh, _)| mesh).collect();
            self.place(&added, None, DMat4::IDENTITY);
        }
        self.notes.say("the file has no nodes; every mesh is placed once, untransformed");
        Ok(())
    }

    fn place(&mut self, meshes: &[usize], node: Option<usize>, world: DMat4) {
        // Near the file's origin a scene stands where a renderer's single precision has it.
        let is_near = self.scene.placement == Placement::default();
        let world_from_mesh = if is_near { world.as_mat4().as_dmat4() } else { world };
        let instance = |&mesh: &usize| Instance { mesh, node, world_from_mesh };
        self.scene.instances.extend(meshes.iter().map(instance));
    }

    /// Adds the mesh of a node posed by its joints; parts without joints stand where the node does.
    fn skinned(&mut self, index: usize, matrices: &[DMat4]) -> Result<(), Problem> {
        let node = &self.asset.document.nodes[index];
        let Some(mesh) = node.mesh else { return Ok(()) };
        for (mesh, posed) in self.mesh(mesh, node.weights.as_deref(), Some(matrices))? {
            let world = if posed { DMat4::IDENTITY } else { self.hierarchy.world_from_node[index] };
            self.place(&[mesh], Some(index), world);
        }
        Ok(())
    }

    /// Adds the primitives of a mesh to the scene; says for each whether joints posed it.
    fn mesh(
        &mut self,
        index: usize,
        weights: Option<&[f32]>,
        joints: Option<&[DMat4]>,
    ) -> Result<Vec<(usize, bool)>, Problem> {
        let asset = self.asset;
        let mesh = &asset.document.meshes[index];
        let weights = weights.unwrap_or(&mesh.weights);
        let mut added = Vec::new();
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let element = format!("meshes[{index}].primitives[{i}]");
            let material = match primitive.material {
                Some(m) => {
                    follow(&asset.document.materials, "materials", m, &format!("{element}.material"))?;
                    m
                }
                None => self.surfaces.plain(),
            };
            let coordinates = self.surfaces.coordinates[material];
            let Some(mut vertices) = asset.vertices(primitive, &element, weights, coordinates)? else {
                self.skipped += 1;
                continue;
            };
            let posed = joints.filter(|_| !vertices.joints.is_empty());
            if let Some(matrices) = posed {
                vertices.pose(matrices, &element)?;
            }
            let name = mesh.name.as_ref().map_or_else(|| element.clone(), |name| format!("{name}[{i}]"));
            self.scene.meshes.push(vertices.into_mesh(&name, material));
            added.push((self.scene.meshes.len() - 1, posed.is_some()));
        }
        Ok(added)
    }

    fn finish(self, options: &Options) -> Scene {
        let Self { mut scene, surfaces, mut notes, skipped, .. } = self;
        scene.materials = surfaces.materials;
        scene.images = surfaces.images;
        if skipped > 0 {
            notes.say(format!("{skipped} primitives without triangles or positions are left out"));
        }
        blend::settle(&mut scene, &surfaces.passing, options.blend, &mut notes);
        scene.notes = notes.sentences();
        scene
    }
}

impl Asset {
    /// The names of all nodes, and what they hang on.
    fn nodes(&self) -> Vec<Node> {
        let named =
            |node: &document::Node| Node { name: node.name.clone().unwrap_or_default(), parent: None };
        let mut nodes: Vec<Node> = self.document.nodes.iter().map(named).collect();
        for (parent, node) in self.document.nodes.iter().enumerate() {
            node.children.iter().for_each(|&child| nodes[child].parent = Some(parent));
        }
        nodes
    }
}

/// The copies of a node's mesh relative to the node: one, or those of `EXT_mesh_gpu_instancing`.
fn instances(asset: &Asset, node: usize, element: &str) -> Result<Vec<DMat4>, Problem> {
    let name = "EXT_mesh_gpu_instancing";
    let extensions = &asset.document.nodes[node].extensions;
    let Some(Instancing { attributes }) = container::extension(extensions, name, element)? else {
        return Ok(vec![DMat4::IDENTITY]);
    };
    let element = format!("{element}.extensions.{name}.attributes");
    let count = match attributes.values().next() {
        Some(&index) => {
            follow(&asset.document.accessors, "accessors", index, &element)?;
            asset.document.accessors[index].count
        }
        None => return Err(invalid(element, "empty", "at least one attribute is needed")),
    };
    let read = |name: &str| {
        let of = |&index: &usize| asset.placement(index, &format!("{element}.{name}"), count);
        attributes.get(name).map(of).transpose()
    };
    let [translations, rotations, scales] = [read("TRANSLATION")?, read("ROTATION")?, read("SCALE")?];
    let place = |i: usize| {
        let of = |values: &Option<Vec<[f32; 4]>>| values.as_ref().map(|v| v[i].map(f64::from));
        let three = |v: [f64; 4]| DVec3::new(v[0], v[1], v[2]);
        let rotation = of(&rotations).map_or(DQuat::IDENTITY, DQuat::from_array);
        if rotation.length() < 1e-6 {
            return Err(invalid(format!("{element}.ROTATION[{i}]"), rotation, "its length must be 1"));
        }
        Ok(DMat4::from_scale_rotation_translation(
            of(&scales).map_or(DVec3::ONE, three),
            rotation.normalize(),
            of(&translations).map_or(DVec3::ZERO, three),
        ))
    };
    (0..count).map(place).collect()
}
