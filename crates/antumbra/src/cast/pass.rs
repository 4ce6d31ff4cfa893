//! The pass that casters are drawn in: it knows what it draws, and notices what leaves nothing there.

use super::{CasterMesh, CutoutCaster, Seen, views::perspective};
use crate::{
    describe::{CasterStorage, Description},
    error::CasterError,
    light::{Size, View},
    tile::Tile,
};
use std::ops::{Deref, DerefMut, Range, RangeBounds};
use wgpu::{BindGroup, LoadOp, RenderPass, RenderPipeline, TextureView};

/// What the closure of [`ShadowMap::encode`](crate::ShadowMap::encode) draws casters in: wgpu's render
/// pass, which it dereferences to. Where the technique keeps depth, the caller's own pipelines draw in it, and
/// place casters by [`view`](Self::view); where it keeps triangles, [`draw_mesh`](Self::draw_mesh) does.
#[derive(Debug)]
pub struct CasterPass<'a> {
    pass: RenderPass<'a>,
    view: &'a View,
    index: usize,
    meshes: Option<MeshPipeline<'a>>,
    /// The library's pipeline that is set, unless the caller may have set something since.
    set: Option<RenderPipeline>,
    /// The first id that no triangle of the pass has.
    next_id: u32,
    drawn: Drawn,
}

/// What meshes without holes are drawn with.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeshPipeline<'a> {
    pub(super) pipeline: &'a RenderPipeline,
    /// Group 0 of that pipeline, and of those for cut-outs.
    pub(super) group: &'a BindGroup,
    /// Its dynamic offsets.
    pub(super) offsets: &'a [u32],
    /// Whether triangles share vertices, by the mesh's indices.
    pub(super) indexed: bool,
}

impl<'a> CasterPass<'a> {
    /// Without `meshes` the technique keeps depth.
    pub(super) fn new(pass: RenderPass<'a>, seen: Seen<'a>, meshes: Option<MeshPipeline<'a>>) -> Self {
        let Seen { index, from: view, .. } = seen;
        let mut pass = pass;
        if seen.tiled {
            limit(&mut pass, &seen.tile);
        }
        Self { pass, view, index, meshes, set: None, next_id: 0, drawn: Drawn::default() }
    }

    /// The view whose [`clip_from_world`](View::clip_from_world) places the casters.
    #[must_use]
    pub fn view(&self) -> &'a View {
        self.view
    }

    /// Which of [`ShadowMap::caster_views`](crate::ShadowMap::caster_views) that is. Renderers that keep
    /// uniforms for each view find them by it; several passes may be of one view.
    #[must_use]
    pub fn index(&self) -> usize {
        self.index
    }

    /// Draws the triangles of a mesh, or a range of them, counted from the first index (`..`, `0..12`). What
    /// lies outside those that the mesh was [made](CasterMesh::new) of is left out. Three vertices per
    /// triangle, six under a spot, whose triangles may have to be cut.
    ///
    /// Sets whatever it needs, so that it may follow cut-outs and the caller's own commands. Where the
    /// technique keeps depth nothing is drawn, and `encode` says so.
    pub fn draw_mesh(&mut self, mesh: &CasterMesh, triangles: impl RangeBounds<u32>) {
        let Some(MeshPipeline { pipeline, indexed, .. }) = self.meshes else {
            self.drawn.meshes = true;
            return;
        };
        self.draw_with(pipeline, indexed, mesh, triangles);
    }

    /// Draws triangles with holes likewise. The caller's own bindings, from group 2 on, are set by wgpu's
    /// `set_bind_group`.
    ///
    /// `cutout` comes from this map, or from one of the same technique, settings and options; wgpu refuses the
    /// commands of others.
    pub fn draw_cutout(
        &mut self,
        mesh: &CasterMesh,
        triangles: impl RangeBounds<u32>,
        cutout: &CutoutCaster,
    ) {
        self.draw_with(&cutout.pipeline, false, mesh, triangles);
    }

    fn draw_with(
        &mut self,
        pipeline: &RenderPipeline,
        indexed: bool,
        mesh: &CasterMesh,
        triangles: impl RangeBounds<u32>,
    ) {
        self.drawn.meshes = true;
        let triangles = mesh.within(triangles);
        let Some(meshes) = self.meshes.filter(|_| !triangles.is_empty()) else { return };
        if self.set.as_ref() != Some(pipeline) {
            self.pass.set_pipeline(pipeline);
            self.pass.set_bind_group(0, meshes.group, meshes.offsets);
            self.set = Some(pipeline.clone());
        }
        if indexed {
            return mesh.draw_indexed(&mut self.pass, triangles);
        }
        let halves = 1 + perspective(self.view);
        let first = self.number(halves * triangles.start..halves * triangles.end);
        mesh.draw(&mut self.pass, triangles, 3 * halves, first);
    }

    /// What is added to those indices of triangles, so that none before has the same id.
    fn number(&mut self, indices: Range<u32>) -> u32 {
        let first = self.next_id.max(indices.start) - indices.start;
        self.next_id = first.saturating_add(indices.end);
        first.min(u32::MAX - 1)
    }

    /// Ids that its triangles took, from 0 on.
    pub(crate) fn ids(&self) -> u32 {
        self.next_id
    }
}

/// Begins a pass with that depth.
pub(super) fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    colour: Option<wgpu::RenderPassColorAttachment<'_>>,
    ((depth, load), store): ((&wgpu::TextureView, wgpu::LoadOp<f32>), wgpu::StoreOp),
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow cast"),
        color_attachments: if colour.is_some() { std::slice::from_ref(&colour) } else { &[] },
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load, store }),
            stencil_ops: None,
        }),
        timestamp_writes,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

impl<'a> Deref for CasterPass<'a> {
    type Target = RenderPass<'a>;

    fn deref(&self) -> &Self::Target {
        &self.pass
    }
}

impl DerefMut for CasterPass<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        self.drawn.otherwise = true;
        self.set = None;
        &mut self.pass
    }
}

/// How passes were drawn in.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Drawn {
    /// As meshes.
    meshes: bool,
    /// By the caller's own commands, which meshes with holes need too.
    otherwise: bool,
}

impl Drawn {
    /// Takes what a pass was used for to mind.
    pub(crate) fn add(&mut self, pass: &CasterPass<'_>) {
        self.meshes |= pass.drawn.meshes;
        self.otherwise |= pass.drawn.otherwise;
    }

    /// Whether that is what the technique keeps. Nothing at all is: there may be no casters.
    pub(crate) fn check(self, description: &Description) -> Result<(), CasterError> {
        let name = || description.about.name.to_string();
        let depth = description.storage == CasterStorage::Depth;
        match self {
            Self { meshes: true, .. } if depth => Err(CasterError::Mesh { technique: name() }),
            Self { meshes: false, otherwise: true } if !depth => {
                Err(CasterError::OwnPipelines { technique: name() })
            }
            _ => Ok(()),
        }
    }
}

/// Begins a compute pass with the timestamps of a render pass.
pub(crate) fn compute_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::ComputePass<'a> {
    encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some(label),
        timestamp_writes: timestamps.map(|t| wgpu::ComputePassTimestampWrites {
            query_set: t.query_set,
            beginning_of_pass_write_index: t.beginning_of_pass_write_index,
            end_of_pass_write_index: t.end_of_pass_write_index,
        }),
    })
}

/// A colour attachment of which every texel is written, or every texel of a tile: the others are kept.
pub(crate) fn written(view: &TextureView, all: bool) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: if all { LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { LoadOp::Load },
            store: wgpu::StoreOp::Store,
        },
    }
}

/// Confines a pass to a part of its targets.
pub(crate) fn limit(pass: &mut wgpu::RenderPass<'_>, tile: &Tile) {
    let Tile { origin: [x, y], size: Size { width, height }, .. } = *tile;
    pass.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
    pass.set_scissor_rect(x, y, width, height);
}
