//! Questions to `shadow_visibility`, and to all that comes with it.

use super::{Receiver, bytes_of, floats, kept};
use crate::Gpu;
use antumbra::ShadowMap;
use glam::{Vec3, Vec4};
use std::sync::PoisonError;

/// `shadow_visibility` at receivers.
pub fn visibility(gpu: &Gpu, shadows: &ShadowMap, receivers: &[Receiver]) -> Vec<f32> {
    let rows = read_rows(receivers, 0.0);
    let user = "
        struct Row { position: vec4f, ddx: vec4f, ddy: vec4f, normal: vec4f }
        @group(1) @binding(0) var<storage, read> rows: array<Row>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
            if id.x >= arrayLength(&rows) { return; }
            let row = rows[id.x];
            results[id.x] = shadow_visibility(row.position.xyz, row.normal.xyz, row.ddx.xyz, row.ddy.xyz);
        }";
    compute(gpu, shadows, user, bytes_of(rows.as_flattened()), receivers.len(), receivers.len())
}

/// Receivers as rows of a buffer: position and another number, its changes to the next pixels, normal.
pub fn read_rows(receivers: &[Receiver], number: f32) -> Vec<[f32; 16]> {
    let row = |r: &Receiver| {
        let position = Vec3::new(r.uv.x * 2.0 - 1.0, 1.0 - r.uv.y * 2.0, r.depth);
        let ddx = Vec4::new(2.0 * r.footprint.x, 0.0, 0.0, 0.0);
        let ddy = Vec4::new(0.0, -2.0 * r.footprint.y, 0.0, 0.0);
        let row = [position.extend(number), ddx, ddy, r.normal.extend(0.0)];
        std::array::from_fn(|i| row[i / 4][i % 4])
    };
    receivers.iter().map(row).collect()
}

/// Runs `main` of a compute shader that may call everything in `shadows.wgsl(0)`: `input` at
/// group 1 binding 0, `outputs` floats at binding 1, `invocations` in groups of 64.
pub fn compute(
    gpu: &Gpu,
    shadows: &ShadowMap,
    user: &str,
    input: &[u8],
    outputs: usize,
    invocations: usize,
) -> Vec<f32> {
    use wgpu::BufferUsages as Usage;
    let device = &gpu.device;
    let buffer = |size: usize, usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: size as u64,
            usage,
            mapped_at_creation: false,
        })
    };
    let source = buffer(input.len(), Usage::STORAGE | Usage::COPY_DST);
    let target = buffer(4 * outputs, Usage::STORAGE | Usage::COPY_SRC);
    gpu.queue.write_buffer(&source, 0, input);
    let (pipeline, own) = pipeline(gpu, shadows, user);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &own,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: source.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: target.as_entire_binding() },
        ],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, shadows.bind_group(), &[]);
        pass.set_bind_group(1, &group, &[]);
        pass.dispatch_workgroups(invocations.div_ceil(64) as u32, 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    floats(&gpu.read_buffer(&target))
}

/// Its pipeline, compiled once for each text, and the layout of group 1.
fn pipeline(gpu: &Gpu, shadows: &ShadowMap, user: &str) -> (wgpu::ComputePipeline, wgpu::BindGroupLayout) {
    let device = &gpu.device;
    let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let own = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &[entry(0, true), entry(1, false)],
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(shadows.layout()), Some(&own)],
        immediate_size: 0,
    });
    let receiver = shadows.wgsl(0);
    let user = receiver.renamed(user);
    let compile = || {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: receiver.after(&user),
        });
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        })
    };
    let text = format!("{user}{}", receiver.text());
    let made = kept(gpu).compute;
    let mut made = made.lock().unwrap_or_else(PoisonError::into_inner);
    (made.entry(text).or_insert_with(compile).clone(), own)
}
