//! Depth that a renderer brings: reversed, some layers of an array, of few bits.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{
    CasterError, Depth, NoProbe, PrepareError, ShadowMap, Size, Technique, Unsupported, View, technique,
    technique::CasterStorage,
};
use antumbra_testing::ask::{Random, Receiver, depth_layers, view, visibility};
use antumbra_testing::{Gpu, Trials, broken::Broken};
use glam::{Mat4, Vec4};

const SIZE: Size = Size::square(32);

/// The view of the tests with depth that falls with the distance.
fn reversed_view() -> View {
    let rows = [Vec4::X, Vec4::Y, Vec4::new(0.0, 0.0, -1.0, 1.0), Vec4::W];
    View {
        clip_from_world: Mat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose(),
        linear_from_clip: [rows[2], Vec4::W],
        ..view(SIZE)
    }
}

/// Blocks of 4×4 texels whose depths are multiples of 1/64, so that one minus them is exact.
fn block(x: u32, y: u32) -> f32 {
    let n = (x / 4 * 7 + y / 4 * 13) % 41;
    (n + 12) as f32 / 64.0
}

/// Points at depths that no block has.
fn receivers() -> Vec<Receiver> {
    let mut random = Random::new(5);
    (0..1024)
        .map(|_| Receiver::point(random.unit(), random.unit(), ((random.unit() * 64.0).floor() + 0.5) / 64.0))
        .collect()
}

/// What the map of a caller's depth answers.
fn answers(gpu: &Gpu, technique: &dyn Technique, depth: Depth<'_>, view: View) -> Vec<f32> {
    let mut shadows = ShadowMap::from_depth(&gpu.device, technique, depth, SIZE).unwrap();
    shadows.prepare(&gpu.queue, &[view]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode_filter(&mut encoder, &mut NoProbe);
    gpu.queue.submit([encoder.finish()]);
    visibility(gpu, &shadows, &receivers())
}

/// Caster passes of a technique that takes depth.
fn casts(gpu: &Gpu, technique: &dyn Technique) -> Option<u32> {
    let description = technique.describe(&antumbra::Capabilities::of(&gpu.device)).unwrap();
    (description.storage == CasterStorage::Depth).then_some(description.sample_offsets.len() as u32)
}

/// Largest difference between answers.
fn apart(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Reversed depth, in the layers of an array behind another's, gives what depth that grows does.
fn reversed_depth_is_the_same_depth(gpu: &Gpu) {
    let specs = [
        "pcf.taps=nearest",
        "pcf.taps=merged",
        "pcf.precision=16",
        "esm.classifier=zmax",
        "vsm.sampling=summed",
    ];
    let more = specs.map(|spec| technique::parse(spec).unwrap());
    let mut seen = 0;
    for technique in technique::all().into_iter().chain(more) {
        let Some(casts) = casts(gpu, technique.as_ref()) else { continue };
        let name = technique::spec(technique.as_ref());
        let plain = depth_layers(gpu, SIZE, casts, |_, x, y| block(x, y));
        // What lies in front is another's, and would be far from the truth.
        let turned =
            depth_layers(gpu, SIZE, casts + 1, |l, x, y| if l == 0 { 0.9 } else { 1.0 - block(x, y) });
        let expected = answers(gpu, technique.as_ref(), Depth::new(&plain), view(SIZE));
        let depth = Depth::new(&turned).layers(1..casts + 1).reversed();
        let found = answers(gpu, technique.as_ref(), depth, reversed_view());
        assert!(apart(&expected, &found) < 1e-3, "{name}: {}", apart(&expected, &found));
        // Negative controls: the layer in front; no reversal.
        let wrong = Depth::new(&turned).layers(0..casts).reversed();
        let wrong = answers(gpu, technique.as_ref(), wrong, reversed_view());
        assert!(apart(&expected, &wrong) > 0.1, "{name}");
        let wrong = Depth::new(&turned).layers(1..casts + 1);
        assert!(apart(&expected, &answers(gpu, technique.as_ref(), wrong, view(SIZE))) > 0.1, "{name}");
        seen += 1;
    }
    assert!(seen > 15, "{seen}");
}

/// A plane whose depth falls between two steps of 16 bits does not shadow itself.
fn few_bits_are_allowed_for(gpu: &Gpu) {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("16 bits"),
        size: wgpu::Extent3d { width: SIZE.width, height: SIZE.height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Depth16Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let bytes: Vec<u8> = (0..SIZE.width * SIZE.height).flat_map(|_| 32767u16.to_ne_bytes()).collect();
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(2 * SIZE.width),
        rows_per_image: Some(SIZE.height),
    };
    gpu.queue.write_texture(texture.as_image_copy(), &bytes, layout, texture.size());
    // Half of the range, which 32767 / 65535 is a little less than.
    let receivers: Vec<Receiver> = receivers().iter().map(|r| Receiver { depth: 0.5, ..*r }).collect();
    let ask = |bias| {
        let options = antumbra::Options::from(SIZE).bias(bias);
        let mut shadows =
            ShadowMap::from_depth(&gpu.device, &technique::Hard::default(), &texture, options).unwrap();
        shadows.prepare(&gpu.queue, &[view(SIZE)]).unwrap();
        visibility(gpu, &shadows, &receivers)
    };
    assert!(ask(technique::Bias::Auto).iter().all(|v| *v == 1.0));
    assert!(ask(technique::Bias::NONE).contains(&0.0), "negative control");
}

/// Views of the wrong kind, layers that are not there, casters for a map that has none.
fn misuse_is_told(gpu: &Gpu) {
    let hard = technique::Hard::default();
    let texture = depth_layers(gpu, SIZE, 2, |_, x, y| block(x, y));
    let mut plain = ShadowMap::from_depth(&gpu.device, &hard, &texture, SIZE).unwrap();
    let error = plain.prepare(&gpu.queue, &[view(SIZE), reversed_view()]).unwrap_err();
    assert_eq!(error, PrepareError::Depth { view: 1, reversed: true });
    assert!(error.to_string().contains("Depth::reversed"), "{error}");
    let error = plain.prepare(&gpu.queue, &[view(SIZE); 3]).unwrap_err();
    assert_eq!(error, PrepareError::TooManyViews { given: 3, max: 2 });
    let mut turned =
        ShadowMap::from_depth(&gpu.device, &hard, Depth::new(&texture).reversed(), SIZE).unwrap();
    assert_eq!(
        turned.prepare(&gpu.queue, &[view(SIZE)]).unwrap_err(),
        PrepareError::Depth { view: 0, reversed: false }
    );
    for layers in [2..3, 1..1, 0..3] {
        let depth = Depth::new(&texture).layers(layers.clone());
        let error = ShadowMap::from_depth(&gpu.device, &hard, depth, SIZE).unwrap_err();
        assert!(matches!(error, Unsupported::Depth { what: "layers", .. }), "{error}");
        assert!(error.to_string().contains(&format!("{layers:?}")), "{error}");
    }
    // A technique that compares the depth as it comes.
    let careless = Broken::saying(
        "hard",
        "let reference = uphill_depth(depth, plane, uphill_lean(view), centre - uv);",
        "let reference = depth;",
    );
    let careless = careless.with(|described| {
        described.wgsl = described.wgsl.replace("//! needs uphill", "").into();
        described.slots.clear();
        described.constants.clear();
    });
    ShadowMap::from_depth(&gpu.device, &careless, &texture, SIZE).unwrap();
    let error =
        ShadowMap::from_depth(&gpu.device, &careless, Depth::new(&texture).reversed(), SIZE).unwrap_err();
    assert!(error.to_string().contains("stored_depth"), "{error}");
    plain.prepare(&gpu.queue, &[view(SIZE)]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let error = plain.encode(&mut encoder, |_| panic!("nothing is drawn")).unwrap_err();
    assert!(matches!(error, CasterError::Brought { .. }) && error.to_string().contains("encode_filter"));
}

/// Depth that leans on the place in the picture, for maps that are made for it.
fn warped_depth_is_the_same_depth(gpu: &Gpu) {
    // z' = 0.8 z + 0.1 x + 0.1.
    let row = Vec4::new(0.1, 0.0, 0.8, 0.1);
    let warped = View {
        clip_from_world: Mat4::from_cols(Vec4::X, Vec4::Y, row, Vec4::W).transpose(),
        linear_from_clip: [Vec4::new(-0.125, 0.0, 1.25, -0.125), Vec4::W],
        ..view(SIZE)
    };
    assert!(warped.is_warped() && !warped.is_reversed());
    let plain = depth_layers(gpu, SIZE, 1, |_, x, y| block(x, y));
    let leaning = depth_layers(gpu, SIZE, 1, |_, x, y| {
        0.8 * block(x, y) + 0.1 * (2.0 * (x as f32 + 0.5) / SIZE.width as f32 - 1.0) + 0.1
    });
    for spec in ["vsm.kernel=1,sampling=nearest", "esm", "evsm"] {
        let technique = technique::parse(spec).unwrap();
        let ask = |depth, view, warped| {
            let options = antumbra::Options::from(SIZE).warped(warped);
            let mut shadows = ShadowMap::from_depth(&gpu.device, technique.as_ref(), depth, options).unwrap();
            shadows.prepare(&gpu.queue, &[view])?;
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            shadows.encode_filter(&mut encoder, &mut NoProbe);
            gpu.queue.submit([encoder.finish()]);
            Ok::<_, PrepareError>(visibility(gpu, &shadows, &receivers()))
        };
        let expected: Vec<f32> = ask(&plain, view(SIZE), false).unwrap();
        let found = ask(&leaning, warped, true).unwrap();
        assert!(apart(&expected, &found) < 5e-3, "{spec}: {}", apart(&expected, &found));
        assert_eq!(ask(&leaning, warped, false).unwrap_err(), PrepareError::Warped { view: 0 });
        let wrong = ask(&leaning, view(SIZE), true).unwrap();
        assert!(apart(&expected, &wrong) > 0.1, "negative control");
    }
}

/// Comparisons do not notice that depth leans where the view says so.
fn leaning_depth_is_the_same_depth(gpu: &Gpu) {
    let plain = depth_layers(gpu, SIZE, 1, |_, x, y| block(x, y));
    let plain_view = view(SIZE);
    let fours =
        ["pcf.taps=bilinear", "pcf.taps=gather", "pcf.taps=merged", "bicubic", "footprint", "poisson"];
    let ones = ["hard", "hard.precision=16", "packed", "pcf.taps=nearest", "pcf.taps=nearest,precision=16"];
    // Four texels that are compared together are so with the least depth of them: a lean as gentle as their steps.
    for (specs, lean) in [(&fours[..], 0.002f32), (&ones, 0.2)] {
        let row = Vec4::new(lean, -0.5 * lean, 0.3, 0.35);
        let view = View {
            clip_from_world: Mat4::from_cols(Vec4::X, Vec4::Y, row, Vec4::W).transpose(),
            depth_plane: row,
            depth_world: 1.0 / 0.3,
            ..view(SIZE)
        };
        let centre = |x: u32| 2.0 * (x as f32 + 0.5) / SIZE.width as f32 - 1.0;
        let leaning =
            depth_layers(gpu, SIZE, 1, |_, x, y| row.dot(Vec4::new(centre(x), -centre(y), block(x, y), 1.0)));
        for spec in specs {
            let technique = technique::parse(spec).unwrap();
            let expected = answers(gpu, technique.as_ref(), Depth::new(&plain), plain_view);
            let found = answers(gpu, technique.as_ref(), Depth::new(&leaning), view);
            assert!(apart(&expected, &found) < 1e-3, "{spec}: {}", apart(&expected, &found));
        }
        let unaware = Broken::saying("hard", "uphill_lean(view)", "vec2f(0.0)");
        let expected = answers(gpu, &unaware, Depth::new(&plain), plain_view);
        let found = answers(gpu, &unaware, Depth::new(&leaning), view);
        assert!(lean < 0.1 || apart(&expected, &found) > 0.03, "negative control");
    }
}

fn main() {
    let mut trials = Trials::default();
    trials.add("reversed_depth_is_the_same_depth", reversed_depth_is_the_same_depth);
    trials.add("warped_depth_is_the_same_depth", warped_depth_is_the_same_depth);
    trials.add("leaning_depth_is_the_same_depth", leaning_depth_is_the_same_depth);
    trials.add("few_bits_are_allowed_for", few_bits_are_allowed_for);
    trials.add("misuse_is_told", misuse_is_told);
    trials.run();
}
