//! How casters are drawn and what is kept of them: one file per store.
//!
//! A store first makes a [`Plan`], which knows texts and sizes and no device, and from that its objects on the
//! GPU, a [`Cast`]. Stores that keep triangles by id are descriptions alone ([`Store`]); `ids.rs` does for all of
//! them what they describe.

use crate::{
    capabilities::Capabilities,
    describe::{
        CasterStorage,
        store::{Array, Element, Image, Owner, Site, Step, Store},
    },
    error::Unsupported,
    light::View,
    memory::MemoryItem,
    options::{Options, Probe},
    pipelines::Pipelines,
    shader::{Composition, Shader},
    tile::Tile,
};
use std::fmt::Debug;
use wgpu::{
    BindGroupLayout, BindingResource, BindingType, Buffer, CommandEncoder, LoadOp, RenderPipeline,
    TextureView,
};

mod abuffer;
mod arrays;
mod cutout;
mod depth;
mod ids;
mod kbuffer;
mod mesh;
mod nearest;
mod objects;
mod pass;
mod pieces;
mod pipeline;
mod split;
mod triangle;
mod views;

pub use cutout::CutoutCaster;
pub use mesh::{CasterMesh, MeshPart};
pub use pass::CasterPass;
pub(crate) use pass::{Drawn, compute_pass, limit, written};

/// The map that a store is for.
fn site<'a>(composition: &Composition, device: &'a Capabilities, options: &Options) -> Site<'a> {
    Site {
        technique: composition.description.about.name,
        size: options.size,
        views: options.views,
        layers: options.layer_count(),
        capacity: options.capacity,
        asks: composition.asks,
        device,
    }
}

/// The plan of what a technique's casters leave in a map: the only place that knows all stores.
pub(crate) fn plan<'a>(
    composition: &'a Composition,
    device: &'a Capabilities,
    options: &'a Options,
) -> Box<dyn Plan + 'a> {
    let site = site(composition, device, options);
    let ids = |store: Box<dyn Store>| Box::new(ids::IdPlan::new(store, site.clone()));
    match composition.description.storage {
        CasterStorage::Depth => Box::new(depth::DepthPlan),
        CasterStorage::NearestTriangle(coverages) => {
            Box::new(nearest::NearestPlan { composition, device, options, coverages })
        }
        CasterStorage::ABuffer => ids(Box::new(abuffer::ABuffer)),
        CasterStorage::KBuffer { k } => ids(Box::new(kbuffer::KBuffer { k })),
        #[cfg(feature = "store")]
        CasterStorage::Own(crate::describe::store::OwnStore(store)) => {
            Box::new(ids::IdPlan::new(store, site))
        }
    }
}

/// What is known of a store in a map beforehand.
pub(crate) trait Plan {
    /// Whether the device can hold it.
    fn check(&self) -> Result<(), Unsupported>;
    /// Shaders that are compiled with the map.
    fn shaders(&self) -> Vec<Shader>;
    /// The shader that draws meshes with holes, given the caller's WGSL; none where casters are depth.
    fn cutout(&self, wgsl: &str) -> Option<Shader>;
    /// WGSL of what lookups bind in `group`, from binding `first` on, and call.
    fn lookups(&self, _group: u32, _first: u32) -> String {
        String::new()
    }
    /// Allocates and compiles everything.
    fn build(&self, device: &wgpu::Device, pipelines: &Pipelines) -> Box<dyn Cast>;
}

/// What casters are drawn to.
pub(crate) trait Targets {
    /// One of the layers that the first map has for a layer of views.
    fn map_target(&self, layer: usize, of_map: usize) -> &TextureView;
    /// Depth attachment of a caster pass of a view in a layer, and what is there before: nothing unless it is kept and
    /// views before this one lie in that layer.
    fn caster_target(&self, layer: usize, cast: usize, first: bool) -> (&TextureView, LoadOp<f32>);
}

/// A store on the GPU.
pub(crate) trait Cast: Debug + wgpu::WasmNotSendSync {
    /// Takes this frame's views, and where they lie.
    fn write(&self, _queue: &wgpu::Queue, _views: &[View], _tiles: &[Tile]) {}
    /// Has casters drawn for one view.
    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        seen: Seen<'_>,
        targets: &dyn Targets,
        probe: &mut dyn Probe,
        draw: &mut dyn FnMut(&mut CasterPass<'_>),
    );
    /// What lookups bind beside what the technique names, in order.
    fn bindings(&self) -> Vec<(BindingType, BindingResource<'_>)> {
        Vec::new()
    }
    /// A pipeline of the shader that [`Plan::cutout`] gives.
    fn cutout(
        &self,
        device: &wgpu::Device,
        shader: &str,
        user: &[&BindGroupLayout],
    ) -> Option<RenderPipeline>;
    /// What [`ShadowMap::abuffer_totals`](crate::ShadowMap::abuffer_totals) promises.
    fn totals(&self) -> Option<&Buffer> {
        None
    }
    /// Passes that [`encode`](Self::encode) takes beside the first that draws casters.
    fn passes(&self) -> Vec<&'static str> {
        Vec::new()
    }
    /// One sentence for `explain`, if there is anything to say.
    fn explain(&self) -> Option<String> {
        None
    }
    /// What it allocated.
    fn memory(&self) -> Vec<MemoryItem> {
        Vec::new()
    }
}

/// The view that casters are drawn for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen<'a> {
    /// Number of the view that receivers know.
    pub(crate) view: usize,
    /// Which of the caster passes of that view it is.
    pub(crate) cast: usize,
    /// Number among all caster views.
    pub(crate) index: usize,
    /// What casters are placed by.
    pub(crate) from: &'a View,
    /// Where the view lies.
    pub(crate) tile: Tile,
    /// Whether that may be a part of a layer.
    pub(crate) tiled: bool,
    /// Whether it is the first of the views in its layer.
    pub(crate) first: bool,
}

impl Seen<'_> {
    /// Number of the layer in which the view lies.
    fn layer(&self) -> usize {
        self.tile.layer as usize
    }
}

/// What a technique needs that the device or its description lacks, and what to do.
fn refused(technique: &str, what: String, instead: String) -> Result<(), Unsupported> {
    Err(Unsupported::Feature { technique: technique.into(), what, instead })
}
