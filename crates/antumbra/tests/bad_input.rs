//! What cannot be made is refused with the thing's name, its value and what is allowed, before
//! wgpu has to complain.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{
    Capabilities, Capacity, Csm, Dpm, Esm, Evsm, Exact, Filter, Hard, LightError, NoProbe, Options, Pcf,
    Pipelines, Sampling, SettingError, ShadowMap, Size, Technique, Unsupported, Vsm, technique,
    technique::{BiasTerms, evsm},
};
use antumbra_testing::{Gpu, Trials, ask, settings};

const SIZE: Size = Size::square(16);

/// The message of what must be refused.
fn refusal(gpu: &Gpu, technique: &dyn Technique, options: impl Into<Options>) -> String {
    ShadowMap::new(&gpu.device, technique, options).expect_err("must be refused").to_string()
}

/// Whether a message has all these words.
fn says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "'{word}' is missing: {message}");
    }
}

fn sizes(gpu: &Gpu) {
    let max = gpu.device.limits().max_texture_dimension_2d;
    for technique in technique::all() {
        for (width, height) in [(0, 16), (16, 0), (0, 0), (max + 1, 16), (16, u32::MAX)] {
            let message = refusal(gpu, technique.as_ref(), Size { width, height });
            says(&message, &[&format!("{width}×{height}"), &format!("1 to {max}")]);
        }
    }
}

fn views(gpu: &Gpu) {
    let max = gpu.device.limits().max_texture_array_layers;
    for technique in technique::all() {
        for views in [0, max + 1, u32::MAX] {
            let message = refusal(gpu, technique.as_ref(), Options::from(SIZE).views(views));
            says(&message, &[&format!("{views} views"), "layers", "1 to "]);
        }
    }
    // Eight layers per view.
    let message = refusal(gpu, &Csm::default(), Options::from(SIZE).views(max / 8 + 1));
    says(&message, &[&format!("{}", (max / 8 + 1) * 8), &format!("1 to {max}")]);
}

/// Views that fit the arrays must fit the uniforms too: 160 bytes each, and 40 behind them.
fn uniforms(_: &Gpu) {
    let limits = wgpu::Limits { max_uniform_buffer_binding_size: 16 << 10, ..Default::default() };
    let lesser = antumbra_testing::gpu_with(wgpu::Features::empty(), limits).unwrap();
    lesser.checked(|gpu| {
        let message = refusal(gpu, &Hard::default(), Options::from(SIZE).views(93));
        says(&message, &["93 views", "16384", "at most 92 views"]);
        let mut made = ShadowMap::new(&gpu.device, &Hard::default(), Options::from(SIZE).views(92)).unwrap();
        made.prepare(&gpu.queue, &[ask::view(SIZE); 92]).unwrap();
    });
}

fn settings_in_public_fields(gpu: &Gpu) {
    let filter = |f: Filter| Esm { filter: f, ..Esm::default() };
    let summed = |kernel| Filter { kernel, sampling: Sampling::Summed, ..Filter::default() };
    let cases: [(Box<dyn Technique>, &[&str]); 20] = [
        (Box::new(Esm { c: 88.0, ..Esm::default() }), &["esm.c", "88", "0 to 87"]),
        (Box::new(Esm { c: f32::NAN, ..Esm::default() }), &["esm.c", "NaN"]),
        (Box::new(filter(Filter { kernel: 4, ..Filter::default() })), &["esm.kernel", "4", "odd, 1 to 31"]),
        (Box::new(filter(Filter { kernel: 33, ..Filter::default() })), &["esm.kernel", "33"]),
        (Box::new(filter(Filter { sigma: -1.0, ..Filter::default() })), &["esm.sigma", "-1"]),
        (
            Box::new(filter(Filter { anisotropy: 0, ..Filter::default() })),
            &["esm.anisotropy", "0", "1 to 16"],
        ),
        (Box::new(filter(Filter { kernel: 0, ..Filter::default() })), &["esm.kernel", "0"]),
        (
            Box::new(filter(Filter { width: -0.1, ..Filter::default() })),
            &["esm.width", "-0.1", "0 to 1000000"],
        ),
        (Box::new(filter(Filter { width: f32::NAN, ..Filter::default() })), &["esm.width", "NaN"]),
        (Box::new(filter(Filter { width: 0.1, ..summed(5) })), &["esm.width", "0.1", "0 to 0"]),
        (Box::new(filter(summed(257))), &["esm.kernel", "257", "odd, 1 to 255"]),
        (Box::new(Esm { c: 80.0, ..filter(summed(3)) }), &["esm.c", "80", "0 to 72"]),
        (Box::new(Esm { epsilon: -0.01, ..Esm::default() }), &["esm.epsilon", "-0.01", "0 to 10"]),
        (Box::new(Csm { terms: 0, ..Csm::default() }), &["csm.terms", "0", "1 to 32"]),
        (Box::new(Csm { attenuation: f32::INFINITY, ..Csm::default() }), &["csm.attenuation", "inf"]),
        (Box::new(Evsm { negative: 42.1, ..Evsm::default() }), &["evsm.negative", "42.1", "0 to 42"]),
        (
            Box::new(Evsm { positive: 40.0, format: evsm::Format::Float16, ..Evsm::default() }),
            &["evsm.positive", "40", "0 to 5.54"],
        ),
        (Box::new(Vsm { reduction: 1.0, ..Vsm::default() }), &["vsm.reduction", "1", "0 to 0.99"]),
        (Box::new(Pcf { kernel: 0, ..Pcf::default() }), &["pcf.kernel", "0", "1 to 16"]),
        (Box::new(Pcf { kernel: u32::MAX, ..Pcf::default() }), &["pcf.kernel"]),
    ];
    for (technique, words) in cases {
        says(&refusal(gpu, technique.as_ref(), SIZE), words);
    }
    // Every number of every technique, just outside its range.
    for technique in technique::all() {
        let count = technique.clone_box().parameters().len();
        for i in 0..count {
            let mut broken = technique.clone_box();
            let name = {
                let mut parameters = broken.parameters();
                let parameter = &mut parameters[i];
                match &mut parameter.field {
                    antumbra::Field::Number(v, r) => **v = r.end() * 1.01 + 1.0,
                    antumbra::Field::Count(v, r) | antumbra::Field::Odd(v, r) => **v = r.end() + 1,
                    antumbra::Field::Choice(_) => continue,
                }
                parameter.name
            };
            let full = format!("{}.{name}", technique.about().name);
            says(&refusal(gpu, broken.as_ref(), SIZE), &[&full, "allowed: "]);
        }
    }
}

fn bias(gpu: &Gpu) {
    let nan = BiasTerms { slope_texels: f32::NAN, ..BiasTerms::NONE }.into();
    says(
        &refusal(gpu, &Hard::default(), Options::from(SIZE).bias(nan)),
        &["bias.slope_texels", "NaN", "finite"],
    );
    let endless = BiasTerms { constant_texels: f32::INFINITY, ..BiasTerms::NONE }.into();
    says(
        &refusal(gpu, &Hard::default(), Options::from(SIZE).bias(endless)),
        &["bias.constant_texels", "inf"],
    );
}

fn specs() {
    let message = |spec: &str| technique::parse(spec).unwrap_err().to_string();
    says(&message("pcss"), &["'pcss'", "hard, pcf, poisson"]);
    says(&message(""), &["unknown technique ''"]);
    says(&message("esm.kernal=3"), &["esm", "'kernal'", "c, storage, classifier"]);
    says(&message("esm.kernel"), &["esm.kernel", "no '='"]);
    says(&message("esm.kernel=four"), &["esm.kernel", "four", "odd, 1 to 31"]);
    says(&message("esm.kernel=4"), &["esm.kernel", "4", "odd, 1 to 31"]);
    says(&message("esm.c=nan"), &["esm.c", "nan", "0 to 87"]);
    says(&message("pcf.taps=cubic"), &["pcf.taps", "cubic", "nearest | bilinear"]);
    // What was refused has not changed the setting.
    let mut esm = technique::parse("esm").unwrap();
    assert!(matches!(technique::set(esm.as_mut(), "c", "1e9"), Err(SettingError::OutOfRange { .. })));
    assert_eq!(technique::spec(esm.as_ref()), "esm");
}

fn texture(gpu: &Gpu, change: impl FnOnce(&mut wgpu::TextureDescriptor<'_>)) -> wgpu::Texture {
    let mut descriptor = wgpu::TextureDescriptor {
        label: Some("caller's depth"),
        size: wgpu::Extent3d { width: 16, height: 16, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: antumbra::DEPTH_FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    };
    change(&mut descriptor);
    gpu.device.create_texture(&descriptor)
}

fn callers_depth(gpu: &Gpu) {
    type Case = (&'static str, &'static str, &'static str, wgpu::Texture);
    let cases: [Case; 4] = [
        ("format", "R32Float", "depth", texture(gpu, |d| d.format = wgpu::TextureFormat::R32Float)),
        ("format", "Stencil8", "depth", texture(gpu, |d| d.format = wgpu::TextureFormat::Stencil8)),
        (
            "usage",
            "RENDER_ATTACHMENT",
            "TEXTURE_BINDING",
            texture(gpu, |d| d.usage = wgpu::TextureUsages::RENDER_ATTACHMENT),
        ),
        ("samples", "4", "1", texture(gpu, |d| d.sample_count = 4)),
    ];
    for (what, found, needed, depth) in cases {
        let error = ShadowMap::from_depth(&gpu.device, &Hard::default(), &depth, SIZE).unwrap_err();
        assert!(matches!(error, Unsupported::Depth { .. }));
        says(&error.to_string(), &[what, found, needed]);
    }
}

/// Every depth format that can be sampled is taken, by both families.
fn depth_formats_are_taken(gpu: &Gpu) {
    use wgpu::TextureFormat as Format;
    for format in
        [Format::Depth16Unorm, Format::Depth24Plus, Format::Depth24PlusStencil8, Format::Depth32Float]
    {
        let depth = texture(gpu, |d| d.format = format);
        for technique in [&Pcf::default() as &dyn Technique, &Esm::default()] {
            let mut shadows = ShadowMap::from_depth(&gpu.device, technique, &depth, SIZE).unwrap();
            shadows.prepare(&gpu.queue, &[ask::view(SIZE)]).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            shadows.encode_filter(&mut encoder, &mut NoProbe);
            gpu.queue.submit([encoder.finish()]);
        }
    }
}

/// Techniques that keep triangles: no capacity at all, more than the device has, depth instead of triangles.
fn triangles(gpu: &Gpu) {
    let of = |size, triangles, triangles_per_texel| {
        Options::from(Size::square(size)).capacity(Capacity { triangles, triangles_per_texel })
    };
    says(&refusal(gpu, &Dpm { keeps: 33, ..Dpm::default() }, SIZE), &["dpm.keeps", "33", "1 to 32"]);
    for name in settings::keeping_ids() {
        let technique = technique::parse(name).unwrap();
        let technique = technique.as_ref();
        says(&refusal(gpu, technique, of(8, 0, 1)), &["capacity.triangles", "= 0 ", "1 to 1073741824"]);
        says(&refusal(gpu, technique, of(8, 1, 0)), &["capacity.triangles_per_texel", "= 0 "]);
        let error = ShadowMap::from_depth(&gpu.device, technique, &texture(gpu, |_| ()), SIZE).unwrap_err();
        assert!(matches!(error, Unsupported::Triangles { .. }), "{error}");
    }
    let (features, limits) = (wgpu::Features::empty(), wgpu::Limits::default());
    let few = wgpu::Limits { max_storage_buffers_per_shader_stage: 4, ..limits };
    antumbra_testing::gpu_with(features, few).unwrap().checked(|gpu| {
        says(&refusal(gpu, &Dpm::default(), SIZE), &["dpm", "5 storage buffers in a stage (4 are possible)"]);
    });
    let least = antumbra_testing::gpu_with(wgpu::Features::empty(), wgpu::Limits::default()).unwrap();
    least.checked(|gpu| {
        let message = refusal(gpu, &Exact, of(4096, 1, 64).views(2));
        says(&message, &["2 views", "512 layers", "1 to 256"]);
    });
    let limits = wgpu::Limits { max_storage_buffer_binding_size: 1 << 10, ..Default::default() };
    let limits = wgpu::Limits { max_texture_dimension_2d: 2048, ..limits };
    let lesser = antumbra_testing::gpu_with(wgpu::Features::empty(), limits).unwrap();
    lesser.checked(|gpu| {
        // In bindings of 1024 bytes: 5 for keys, 1 for corners, and 3 others.
        let dpm = |keeps| Dpm { keeps, ..Dpm::default() };
        let message = refusal(gpu, &dpm(4), of(17, 1, 1));
        says(
            &message,
            &["dpm", "9 storage buffers in a stage (8 are possible)", "1024 bytes", "Options::capacity"],
        );
        let message = refusal(gpu, &dpm(1), of(4, 5 * 21 + 1, 1));
        says(&message, &["dpm", "10 storage buffers"]);
        let message = refusal(gpu, &Exact, of(40, 1, 1));
        says(&message, &["exact", "11 storage buffers"]);
        for (technique, size) in [(&dpm(4) as &dyn Technique, 16), (&Exact, 32)] {
            ShadowMap::new(&gpu.device, technique, of(size, 1, 1)).unwrap();
        }
        let message = refusal(gpu, &Exact, of(8, 9 * 21, 1));
        says(&message, &["exact", "13 storage buffers", "1024 bytes", "Options::capacity"]);
    });
}

fn too_many_views(gpu: &Gpu) {
    let mut shadows = ShadowMap::new(&gpu.device, &Esm::default(), Options::from(SIZE).views(2)).unwrap();
    let view = ask::view(SIZE);
    let error = shadows.prepare(&gpu.queue, &[view; 3]).unwrap_err();
    says(&error.to_string(), &["3 views", "2", "Options::views"]);
    // None, and fewer than there is room for, are fine.
    for count in [0, 1, 2] {
        shadows.prepare(&gpu.queue, &vec![view; count]).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut drawn = 0;
        shadows.encode(&mut encoder, |_| drawn += 1).unwrap();
        gpu.queue.submit([encoder.finish()]);
        assert_eq!(drawn, count);
    }
}

/// The least that WebGPU promises is enough for every technique.
fn least_devices(_: &Gpu) {
    let lesser = antumbra_testing::gpu_with(wgpu::Features::empty(), wgpu::Limits::default()).unwrap();
    lesser.checked(|gpu| {
        let pipelines = Pipelines::new(&gpu.device);
        for technique in technique::all() {
            let options = Options::from(SIZE).views(2).pipelines(&pipelines);
            let mut shadows = ShadowMap::new(&gpu.device, technique.as_ref(), options).unwrap();
            shadows.prepare(&gpu.queue, &[ask::view(SIZE); 2]).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            shadows.encode(&mut encoder, |_| ()).unwrap();
            gpu.queue.submit([encoder.finish()]);
            let explained = shadows.explain().join("\n");
            says(&explained, &["no depth clamping", "caster_pancaked"]);
            if technique.about().name == "msm" {
                says(&explained, &["32 bits instead of 16", "TEXTURE_FORMAT_16BIT_NORM", "in Rgba32Float"]);
            }
            if technique.about().name == "csm" {
                says(&explained, &["8 layers of basis in passes of 4"]);
            }
        }
        let spec = technique::parse("esm.sampling=anisotropic").unwrap();
        let shadows = ShadowMap::new(&gpu.device, spec.as_ref(), SIZE).unwrap();
        says(
            &shadows.explain().join("\n"),
            &["exponentials in R32Float", "four loads", "anisotropic", "loop"],
        );
        assert!(!Capabilities::of(&gpu.device).filters(wgpu::TextureFormat::R32Float));
    });
}

fn backend_message() {
    let message = Unsupported::Backend { backend: wgpu::Backend::Gl.to_string() }.to_string();
    says(&message, &["gl", "compared", "Vulkan, Metal, DX12 or WebGPU"]);
}

fn light_messages() {
    let light = antumbra::Light::Directional { direction: glam::Vec3::ZERO };
    let bounds = antumbra::Bounds { min: glam::Vec3::ZERO, max: glam::Vec3::ONE };
    let fit = antumbra::Fit {
        casters: bounds,
        receivers: bounds.corners().collect(),
        size: SIZE,
        margin_texels: 2.0,
        lean: true,
    };
    let error = light.view(&fit).unwrap_err();
    assert!(matches!(error, LightError::Direction { .. }));
    says(&error.to_string(), &["direction", "[0, 0, 0]"]);
    let sun = antumbra::Light::Directional { direction: glam::Vec3::NEG_Y };
    let error = sun.view(&antumbra::Fit { margin_texels: 9.0, ..fit }).unwrap_err();
    says(&error.to_string(), &["16 texels", "margin of 9"]);
}

fn main() {
    let mut trials = Trials::default();
    trials.add("sizes that cannot be", sizes);
    trials.add("too many views, and none", views);
    trials.add("as many views as fit the uniforms", uniforms);
    trials.add("settings out of range in public fields", settings_in_public_fields);
    trials.add("biases that are no numbers", bias);
    trials.add("a caller's depth that cannot be read", callers_depth);
    trials.add("a caller's depth of any format", depth_formats_are_taken);
    trials.add("triangles beyond what is possible", triangles);
    trials.add("more views than there is room for", too_many_views);
    trials.add("the least that WebGPU promises", least_devices);
    trials.add_plain("names and settings that do not exist", specs);
    trials.add_plain("the message for GL", backend_message);
    trials.add_plain("messages of lights", light_messages);
    trials.run();
}
