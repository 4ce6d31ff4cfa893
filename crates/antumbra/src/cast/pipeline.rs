//! Pipelines that draw the triangles of meshes.

use super::objects::{self, UNIFORM};
use crate::options::DEPTH_FORMAT;
use wgpu::{BindGroupLayout, CompareFunction, RenderPipeline, ShaderStages, TextureFormat};

/// What a pipeline is made of.
#[derive(Debug, Clone, Copy)]
pub(super) struct Recipe<'a> {
    pub(super) shader: &'a str,
    /// Group 0.
    pub(super) own: &'a BindGroupLayout,
    /// Groups from 2 on.
    pub(super) user: &'a [&'a BindGroupLayout],
    /// The only colour, if any.
    pub(super) target: Option<TextureFormat>,
    /// How depth is compared; it is written unless that is `Always`.
    pub(super) depth: CompareFunction,
    pub(super) unclipped_depth: bool,
    pub(super) conservative: bool,
}

/// Layout of group 1.
pub(super) fn mesh_layout(device: &wgpu::Device) -> BindGroupLayout {
    let read = objects::storage(true);
    let types = [UNIFORM, read, read, UNIFORM].map(|ty| (ShaderStages::VERTEX_FRAGMENT, ty));
    objects::layout(device, "caster mesh", &types)
}

impl Recipe<'_> {
    pub(super) fn compile(&self, device: &wgpu::Device) -> RenderPipeline {
        const LABEL: &str = "shadow triangles";
        let module = objects::module(device, LABEL, self.shader);
        let mesh = mesh_layout(device);
        let groups: Vec<&BindGroupLayout> =
            [self.own, &mesh].into_iter().chain(self.user.iter().copied()).collect();
        let target = self.target.map(|format| Some(format.into()));
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(LABEL),
            layout: Some(&objects::pipeline_layout(device, LABEL, &groups)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                unclipped_depth: self.unclipped_depth,
                conservative: self.conservative,
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(self.depth != CompareFunction::Always),
                depth_compare: Some(self.depth),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: target.as_slice(),
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
