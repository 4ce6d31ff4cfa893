//! What a store that keeps triangles by id is, as a description.

#![cfg_attr(not(feature = "store"), allow(unreachable_pub, reason = "public with the feature alone"))]

use crate::{capabilities::Capabilities, capacity::Capacity, error::Unsupported, light::Size};
use std::fmt::Debug;

/// The map that a store is for.
#[derive(Debug, Clone)]
pub struct Site<'a> {
    /// Name of the technique.
    pub technique: &'static str,
    /// Texels of a layer, and of a view that has one of its own.
    pub size: Size,
    /// Number of views.
    pub views: u32,
    /// Number of layers: that of views, unless they are [tiles](crate::Tile).
    pub layers: u32,
    /// Memory for triangles.
    pub capacity: Capacity,
    /// Whether lookups ask about the holes of cut-outs.
    pub asks: bool,
    /// What the device can do.
    pub device: &'a Capabilities,
}

impl Site<'_> {
    /// Texels of a layer.
    #[must_use]
    pub fn texels(&self) -> u64 {
        u64::from(self.size.width) * u64::from(self.size.height)
    }
}

/// Something that is done for each view. Its WGSL reads two numbers as `caster_step.words`, beside
/// `caster_step.view` and `caster_step.triangles`, how many ids there are; and as `caster_view.size`, `.origin`, `.layer` and
/// `.layer_size` where the view lies. `caster_at(in)` is a fragment's place in it.
#[derive(Debug, Clone, Copy)]
pub enum Step {
    /// Casters are drawn, by the store's [`wgsl`](Store::wgsl).
    Draw {
        /// `caster_step.words`.
        words: [u32; 2],
    },
    /// A compute pass, entry point `compute`.
    Compute {
        /// What [`Probe::pass`](crate::Probe::pass) hears.
        label: &'static str,
        /// The shader, which calls functions of arrays and images.
        wgsl: &'static str,
        /// Texels of a view that a workgroup goes through.
        texels: u32,
        /// `caster_step.words`.
        words: [u32; 2],
    },
}

/// A way to keep triangles by id: the vertices of all of them in a table, and for each texel whatever the store
/// makes of those that touch it.
///
/// The library draws triangles conservatively, keeps their vertices, and binds what the store describes. Its
/// WGSL reads and writes [`Array`]s and [`Image`]s by functions whose names begin with theirs; the library
/// writes those that are called.
pub trait Store: Debug + Send + Sync {
    /// What begins the names of its items in [`ShadowMap::memory`](crate::ShadowMap::memory).
    fn name(&self) -> &'static str;
    /// Arrays beside those of the vertices.
    fn arrays(&self, site: &Site<'_>) -> Vec<Array>;
    /// Images of whole numbers.
    fn images(&self, _site: &Site<'_>) -> Vec<Image> {
        Vec::new()
    }
    /// What is done for each view, in order.
    fn steps(&self, site: &Site<'_>) -> Vec<Step>;
    /// Shared files that its WGSL needs.
    fn needs(&self) -> &'static [&'static str] {
        &[]
    }
    /// Members of `CasterTriangle` that its WGSL fills, beside `id: u32`: names and types.
    fn varyings(&self) -> &'static [(&'static str, &'static str)] {
        &[]
    }
    /// WGSL that draws triangles. It defines `store_triangle(shaped: CasterTriangle, triangle: u32, seen:
    /// mat3x3f, id: u32) -> CasterTriangle`, which fills the varyings of a triangle; `store_depth(in:
    /// CasterTriangle, at: vec2f) -> f32`, its depth at a point from corner 0; `store_keeps_vertices() ->
    /// bool`, whether this step keeps vertices; and the entry point `fragment`, which calls
    /// `caster_touch(in)`, and `vertices_keep_all(in)` for triangles that it keeps.
    fn wgsl(&self) -> &'static str;
    /// WGSL through which the technique looks up what is kept. `shadow_corner(view: u32, id: u32, corner: u32)
    /// -> vec3f` and `shadow_stops(view: u32, id: u32, a: vec3f, b: vec3f, c: vec3f) -> bool`, whether the ray
    /// that the corners lie around meets no hole, come with the vertices.
    fn lookups(&self, site: &Site<'_>) -> String;
    /// Whether fragments store depth, the least of each texel.
    fn keeps_depth(&self) -> bool {
        false
    }
    /// The array that [`ShadowMap::abuffer_totals`](crate::ShadowMap::abuffer_totals) gives, if any.
    fn totals(&self) -> Option<&'static str> {
        None
    }
    /// One sentence for [`ShadowMap::explain`](crate::ShadowMap::explain).
    fn explain(&self, site: &Site<'_>) -> String;
    /// Whether its settings can be.
    ///
    /// # Errors
    /// [`Unsupported`].
    fn check(&self, _site: &Site<'_>) -> Result<(), Unsupported> {
        Ok(())
    }
}

/// Numbers that casters leave, in as many buffers as bindings of the device need.
///
/// Where it is drawn or computed, WGSL calls `NAME_load(i) -> u32`, `NAME_store(i, value)` and, atomically,
/// `NAME_add`, `NAME_max` and `NAME_or(i, value) -> u32`, which return what was there. Lookups call
/// `NAME_load(i)`.
#[derive(Debug, Clone)]
pub struct Array {
    /// What the functions' names begin with.
    pub name: &'static str,
    /// What it is called in [`ShadowMap::memory`](crate::ShadowMap::memory), behind the store's name.
    pub title: &'static str,
    /// What it holds.
    pub element: Element,
    /// Number of elements of one owner.
    pub length: u64,
    /// Whose they are.
    pub owner: Owner,
    /// Whether elements are filled with zeros before casters are drawn, once in a frame for each owner.
    pub cleared: bool,
    /// Whether lookups read it.
    pub looked_up: bool,
}

/// Who has elements of an [`Array`] of its own; those of several lie one behind the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// Each view, with `caster_step.view`.
    View,
    /// Each layer, with `caster_view.layer`: views have one each unless they are [tiles](crate::Tile).
    Layer,
    /// Nobody: views, which are drawn one after the other, share them.
    Shared,
}

/// An element of an [`Array`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// `u32`.
    Word,
    /// Three `vec4f`: `NAME_load(i, k) -> vec4f`, `NAME_store(i, k, value)`.
    Corners,
}

/// A texture of `u32` that is written in storage passes: `NAME_store(at: vec2u, layer: u32, value: u32)`,
/// with the layers that it has for one layer of views; `NAME_size() -> vec2u`. Lookups call `NAME_load(view: u32, at: vec2u, layer:
/// u32) -> u32`.
#[derive(Debug, Clone)]
pub struct Image {
    /// What the functions' names begin with.
    pub name: &'static str,
    /// What it is called in [`ShadowMap::memory`](crate::ShadowMap::memory), behind the store's name.
    pub title: &'static str,
    /// Texels across and down.
    pub size: [u32; 2],
    /// Layers for each layer of views.
    pub layers: u32,
}

/// A store of a technique's own.
#[cfg(feature = "store")]
#[derive(Debug, Clone, Copy)]
pub struct OwnStore(pub &'static dyn Store);

#[cfg(feature = "store")]
impl PartialEq for OwnStore {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::addr_eq(self.0, other.0)
    }
}

#[cfg(feature = "store")]
impl Eq for OwnStore {}
