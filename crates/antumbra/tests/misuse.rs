//! What a program is told that draws the wrong casters, or asks for more than its device has.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{
    Capabilities, CasterPass, DEPTH_FORMAT, Options, ShadowMap, Size, Technique, Unsupported, technique,
    technique::CasterStorage,
};
use antumbra_testing::{Gpu, Trials, ask, broken::Broken};
use glam::Vec3;

const SIZE: Size = Size::square(16);

/// Whether a message has all these words.
fn says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "'{word}' is missing: {message}");
    }
}

/// A pipeline that a renderer might have: depth, from vertices of its own.
fn own_pipeline(gpu: &Gpu) -> wgpu::RenderPipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(
            "@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
                return vec4f(4.0 * f32(i & 1u) - 1.0, 2.0 * f32(i & 2u) - 1.0, 0.5, 1.0);
            }"
            .into(),
        ),
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}

/// Casters of the other kind than the technique keeps; none at all are fine.
fn casters(gpu: &Gpu) {
    let own = own_pipeline(gpu);
    let mesh = ask::caster_mesh(gpu, &[Vec3::ZERO, Vec3::X, Vec3::Y]);
    for technique in technique::all() {
        let mut shadows = ShadowMap::new(&gpu.device, technique.as_ref(), SIZE).unwrap();
        shadows.prepare(&gpu.queue, &[ask::view(SIZE)]).unwrap();
        // Encoders that are never finished: wgpu itself refuses some of these pipelines then.
        let encoded = |draw: &dyn Fn(&mut CasterPass<'_>)| {
            shadows.encode(&mut gpu.device.create_command_encoder(&Default::default()), draw)
        };
        encoded(&|_| ()).unwrap();
        let with_own = encoded(&|pass| {
            pass.set_pipeline(&own);
            pass.draw(0..3, 0..1);
        });
        let with_mesh = encoded(&|pass| pass.draw_mesh(&mesh, ..));
        let (keeps, [good, bad]) = match technique.describe(&Capabilities::full()).unwrap().storage {
            CasterStorage::Depth => ("keeps depth", [with_own, with_mesh]),
            _ => ("keeps triangles", [with_mesh, with_own]),
        };
        good.unwrap();
        says(&bad.unwrap_err().to_string(), &[technique.about().name, keeps, "CasterMesh"]);
    }
}

/// As many views of the largest map as can be asked for take more memory than any device has.
fn memory(_: &Gpu) {
    // One of its own: what becomes of a device that was out of memory must not trouble other tests.
    let gpu = antumbra_testing::gpu_without(wgpu::Features::empty()).unwrap();
    let limits = gpu.device.limits();
    let size = Size::square(limits.max_texture_dimension_2d);
    let views = limits.max_texture_array_layers.min(300);
    let evsm = technique::parse("evsm").unwrap();
    let error = ShadowMap::new(&gpu.device, evsm.as_ref(), Options::from(size).views(views)).unwrap_err();
    let Unsupported::Memory { bytes, .. } = error else { panic!("{error}") };
    // 16 bytes and a third, and 4 of depth, in every texel.
    let texels = u64::from(size.width) * u64::from(size.height);
    assert!(bytes > 21 * texels * u64::from(views), "{bytes}");
    says(
        &error.to_string(),
        &["no memory for evsm", &format!("{views} views of {}×", size.width), "smaller map"],
    );
    let waited = ShadowMap::new_async(&gpu.device, evsm.as_ref(), Options::from(size).views(views));
    assert_eq!(pollster::block_on(waited).unwrap_err(), error);
    gpu.checked(|gpu| ShadowMap::new(&gpu.device, evsm.as_ref(), SIZE).unwrap());
    gpu.checked(|gpu| pollster::block_on(ShadowMap::new_async(&gpu.device, evsm.as_ref(), SIZE)).unwrap());
}

/// What the device does not take is an error that says whose it is and what the device says.
fn shaders(gpu: &Gpu) {
    let broken: &dyn Technique =
        &Broken::saying("esm", "fn esm_encode(depth: f32", "fn esm_encode(depth: nothing");
    let error = ShadowMap::new(&gpu.device, broken, SIZE).unwrap_err();
    says(&error.to_string(), &["the device refuses what esm is made of", "nothing"]);
}

/// A layout of as many storage buffers for fragments.
fn storage_layout(gpu: &Gpu, buffers: u32) -> wgpu::BindGroupLayout {
    let entry = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = (0..buffers).map(entry).collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries })
}

/// Cut-outs that ask for more groups or buffers than WebGPU promises, or that are no WGSL.
fn cutouts(_: &Gpu) {
    const COVERS: &str = "fn caster_covers(triangle: u32, weights: vec3f) -> bool { return true; }";
    let least = antumbra_testing::gpu_with(wgpu::Features::empty(), wgpu::Limits::default()).unwrap();
    least.checked(|gpu| {
        let [one, eight] = [1, 8].map(|buffers| storage_layout(gpu, buffers));
        for technique in technique::all() {
            let shadows = ShadowMap::new(&gpu.device, technique.as_ref(), SIZE).unwrap();
            let made = |wgsl: &str, layouts: &[&wgpu::BindGroupLayout]| {
                shadows.cutout_caster(&gpu.device, wgsl, layouts)
            };
            let triangles =
                technique.describe(&Capabilities::full()).unwrap().storage != CasterStorage::Depth;
            assert_eq!(made(COVERS, &[&one, &one]).unwrap().is_some(), triangles);
            if !triangles {
                continue;
            }
            let message =
                |wgsl: &str, layouts: &[&wgpu::BindGroupLayout]| made(wgsl, layouts).unwrap_err().to_string();
            let name = technique.about().name;
            let groups = message(COVERS, &[&one, &one, &one]);
            says(&groups, &[name, "5 bind groups, 3 of the caller's, where 4 are possible", "at most 2"]);
            says(&message(COVERS, &[&eight]), &[name, "max_storage_buffers_per_shader_stage"]);
            says(&message("fn caster_covers() {", &[]), &[name, "holes"]);
        }
    });
}

fn main() {
    let mut trials = Trials::default();
    trials.add("casters of the other kind", casters);
    trials.add("more memory than there is", memory);
    trials.add("shaders that the device refuses", shaders);
    trials.add("cut-outs that the device refuses", cutouts);
    trials.run();
}
