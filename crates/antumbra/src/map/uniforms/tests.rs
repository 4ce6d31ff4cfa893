use super::*;
use crate::{
    capabilities::Capabilities,
    cast,
    describe::Technique,
    light::Size,
    pass,
    shader::{Composition, settings},
    technique::{all, parse},
};
use naga::{TypeInner, front::wgsl::parse_str};
use std::mem::offset_of;

/// Name, offset and size in bytes of each member, and the size of the whole.
type Layout = (Vec<(String, u32, u32)>, u32);

fn layout(module: &naga::Module, name: &str) -> Layout {
    let (_, ty) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).unwrap();
    let TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no struct") };
    let size = |ty| module.types[ty].inner.size(module.to_ctx());
    let rows = members.iter().map(|m| (m.name.clone().unwrap(), m.offset, size(m.ty))).collect();
    (rows, *span)
}

/// `ShadowView` as Rust lays it out, with what follows it for a technique.
fn rust_view(description: &Description) -> Layout {
    macro_rules! row {
        ($field:ident) => {{
            let zero: ShadowView = bytemuck::Zeroable::zeroed();
            let offset = offset_of!(ShadowView, $field) as u32;
            (stringify!($field).to_string(), offset, size_of_val(&zero.$field) as u32)
        }};
    }
    let mut rows = vec![
        row!(clip_from_world),
        row!(depth_plane),
        row!(to_light),
        row!(linear_over),
        row!(linear_under),
        row!(tile),
        row!(texel_world),
        row!(reach_x),
        row!(reach_y),
        row!(layer),
        row!(depth_per_world),
        row!(lean_x),
        row!(lean_y),
    ];
    let base = VIEW_BYTES as u32;
    rows.extend((0..).zip(settings::per_view(description)).map(|(i, name)| (name, base + 4 * i, 4)));
    (rows, view_bytes(description) as u32)
}

/// With room for three views.
fn options() -> Options {
    Options::from(Size::square(64)).views(3)
}

fn composed(technique: &dyn Technique) -> Composition {
    Composition::new(technique.describe(&Capabilities::least()).unwrap(), &options()).unwrap()
}

/// The receiver's text for three views.
fn receiver(composition: &Composition) -> String {
    let (device, options) = (Capabilities::least(), options());
    composition
        .receiver(|group, first| cast::plan(composition, &device, &options).lookups(group, first), (0, 0))
        .text()
}

fn same(wgsl: &str, description: &Description) -> Result<(), String> {
    let module = parse_str(wgsl).map_err(|e| e.emit_to_string(wgsl))?;
    let (found, expected) = (layout(&module, "ShadowView"), rust_view(description));
    if found == expected { Ok(()) } else { Err(format!("WGSL {found:?}, Rust {expected:?}")) }
}

#[test]
fn the_view_is_laid_out_alike_in_rust_and_wgsl() {
    let further = ["esm.classifier=zmax", "vsm.width=0.1", "esm.classifier=zmax,width=0.1"];
    for technique in all().into_iter().chain(further.map(|spec| parse(spec).unwrap())) {
        let composition = composed(technique.as_ref());
        let description = &composition.description;
        let text = receiver(&composition);
        same(&text, description).unwrap();
        let module = parse_str(&text).unwrap();
        let stride = module
            .types
            .iter()
            .find_map(|(_, t)| match t.inner {
                TypeInner::Array { stride, base, .. }
                    if module.types[base].name.as_deref() == Some("ShadowView") =>
                {
                    Some(stride)
                }
                _ => None,
            })
            .unwrap();
        assert_eq!(u64::from(stride), view_bytes(description));
        // Negative controls: two members swapped, one of another type.
        let swapped = text
            .replace("texel_world: f32, reach_x: f32", "reach_x: f32, texel_world: f32")
            .replace("depth_plane: vec4f, to_light: vec4f", "to_light: vec4f, depth_plane: vec4f");
        assert_ne!(swapped, text);
        same(&swapped, description).unwrap_err();
        same(&text.replace("to_light: vec4f", "to_light: vec2f"), description).unwrap_err();
    }
}

/// The bytes that `write` writes to the receivers' buffer.
fn written(description: &Description, bias: BiasTerms, size: Size, views: &[View], room: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    let per_view = PerView::of(description);
    let tile = Tile { layer: 3, origin: [5, 6], size: Size { width: 8, height: 16 } };
    view_bytes_of(&mut bytes, views.iter().map(|view| (view, &tile)), room, 2.0, &per_view);
    bytes.extend_from_slice(&(views.len() as u32).to_ne_bytes());
    bytes.extend_from_slice(bytemuck::cast_slice(&scalars(description, bias, size)));
    bytes
}

#[test]
fn what_is_written_lies_where_the_shader_reads_it() {
    let bias = BiasTerms {
        constant_texels: 1.5,
        slope_texels: 2.5,
        normal_offset_texels: 3.5,
        grazing_offset_texels: 5.5,
        receiver_plane: 0.75,
        depth_steps: 4.5,
    };
    let view = View {
        clip_from_world: glam::Mat4::from_cols_array(&std::array::from_fn(|i| i as f32)),
        depth_plane: glam::Vec4::new(20.0, 21.0, 22.0, 23.0),
        to_light: glam::Vec4::new(24.0, 25.0, 26.0, 0.0),
        texel_world: 28.0,
        linear_from_clip: [[31.0, 32.0, 33.0, 34.0], [0.0, 0.0, 0.0, 1.0]].map(glam::Vec4::from_array),
        depth_world: 30.0,
    };
    for spec in [
        "hard",
        "pcf.precision=8",
        "vsm.least_variance=0.001,slope=3",
        "csm.offset=0.2",
        "esm.c=33,classifier=zmax,kernel=9,width=140",
        "csm.weights=box,kernel=9,width=140",
        "csm.sampling=trilinear,kernel=9,width=140",
        "poisson.kernel=31,width=1400",
    ] {
        let composition = composed(parse(spec).unwrap().as_ref());
        let description = &composition.description;
        let module = parse_str(&receiver(&composition)).unwrap();
        let (members, span) = layout(&module, "ShadowUniforms");
        let bytes = written(description, bias, Size { width: 640, height: 480 }, &[view, view], 3);
        assert!(bytes.len() <= span as usize && span as usize <= bytes.len().next_multiple_of(16));
        let word = |offset: u32| -> [u8; 4] { bytes[offset as usize..][..4].try_into().unwrap() };
        let float = |offset| f32::from_ne_bytes(word(offset));
        let mut expected = vec![
            ("width".to_string(), 640.0),
            ("height".into(), 480.0),
            ("constant_texels".into(), 1.5),
            ("slope_texels".into(), 2.5),
            ("normal_offset_texels".into(), 3.5),
            ("grazing_offset_texels".into(), 5.5),
            ("receiver_plane".into(), 0.75),
            ("constant_depth".into(), 4.5 * description.depth_quantum),
            ("float_steps".into(), 4.5),
        ];
        expected.extend(description.uniforms.iter().map(|(n, v)| (format!("setting_{n}"), *v)));
        assert_eq!(members[0].0, "views");
        assert_eq!(members[1].0, "view_count");
        assert_eq!(u32::from_ne_bytes(word(members[1].1)), 2);
        let found: Vec<_> =
            members[2..].iter().map(|(name, offset, _)| (name.clone(), float(*offset))).collect();
        assert_eq!(found, expected);
        second_view(spec, description, &module, &bytes);
    }
}

/// What is written of the second view, and of the blank third.
fn second_view(spec: &str, description: &Description, module: &naga::Module, bytes: &[u8]) {
    let float = |at: u32| f32::from_ne_bytes(bytes[at as usize..][..4].try_into().unwrap());
    let [near, far] = [1.0f32, 4.0].map(|square| (-square / (2.0 * 1.1 * 1.1)).exp());
    let gaussian = 2.0 * (near + 4.0 * far) / (1.0 + 2.0 * (near + far));
    let (rows, _) = layout(module, "ShadowView");
    let base = view_bytes(description) as u32;
    assert_eq!(float(base + 4 * 7), 7.0);
    assert_eq!(float(base + rows[1].1), 20.0);
    assert_eq!(float(base + rows[2].1), 24.0);
    assert_eq!(float(base + rows[3].1 + 4), 32.0);
    assert_eq!(float(base + rows[4].1 + 12), 1.0);
    let tile: Vec<f32> = (0..4).map(|i| float(base + rows[5].1 + 4 * i)).collect();
    assert_eq!(tile, [5.0, 6.0, 8.0, 16.0]);
    let tail: Vec<f32> = rows[6..].iter().map(|(_, offset, _)| float(base + offset)).collect();
    // 140 and 1400 world units in texels of 28; the latter is more than 31 texels.
    // A box of five has the variance (5² − 1) / 12, the Gaussian of σ = 1.1 by its taps.
    let further = match spec.split(['.', ',']).next().unwrap() {
        "esm" => vec![gaussian],
        "csm" if spec.contains("box") => vec![2.0],
        "poisson" => vec![31.0],
        _ => Vec::new(),
    };
    // Twice (20, 21, 22) · row / row² of the matrix's rows (0, 4, 8) and (1, 5, 9), y down.
    let lean = [2.0 * 260.0 / 80.0, -2.0 * 323.0 / 107.0];
    let expected = [vec![28.0, 0.25, 0.125, f32::from_bits(3), 1.0 / 30.0], lean.to_vec(), further].concat();
    assert_eq!(tail.len(), expected.len(), "{spec}");
    assert!(tail.iter().zip(&expected).all(|(f, e)| (f - e).abs() < 1e-6), "{spec}: {tail:?}");
    assert!(bytes[2 * base as usize..3 * base as usize].iter().all(|b| *b == 0));
}

#[test]
fn the_convert_settings_are_floats_in_order() {
    let further = ["esm.classifier=zmax", "esm.classifier=zmax,width=0.1"].map(|spec| parse(spec).unwrap());
    for technique in all().into_iter().chain(further) {
        let composition = composed(technique.as_ref());
        let steps = pass::filter_steps(&composition, &Capabilities::least(), Size::square(64));
        for step in steps.iter().filter(|s| s.source.holder == pass::Holder::Casters) {
            let module = parse_str(&step.shader).unwrap();
            let (members, _) = layout(&module, "Convert");
            let description = &composition.description;
            let names = std::iter::once("reach".to_string())
                .chain(settings::once(description))
                .chain(settings::per_view(description));
            let side = 4 * MOST_SIDE as u32;
            let rows = [("linear_over", side), ("linear_under", side + 16), ("tile", side + 32)];
            let mut expected = vec![("side".to_string(), 0, side)];
            expected.extend(rows.map(|(name, at)| (name.to_string(), at, 16)));
            expected.push(("size".into(), side + 48, 8));
            expected.extend(names.zip(0..).map(|(name, i)| (name, side + 56 + 4 * i, 4)));
            assert_eq!(members, expected);
        }
    }
}

/// Blurs read the beginning of what the convert pass reads.
#[test]
fn blurs_read_their_reach_where_it_is_written() {
    let steps = |spec: &str| {
        pass::filter_steps(&composed(parse(spec).unwrap().as_ref()), &Capabilities::least(), Size::square(64))
    };
    let members = |steps: &[pass::FilterStep], label: &str, name: &str| {
        let step = steps.iter().find(|step| step.label == label).unwrap();
        layout(&parse_str(&step.shader).unwrap(), name).0
    };
    for spec in ["vsm.width=0.1", "esm.classifier=zmax,width=0.1"] {
        let steps = steps(spec);
        let (blur, convert) = (members(&steps, "blur", "Blur"), members(&steps, "convert", "Convert"));
        assert_eq!(blur.last().unwrap().0, "reach");
        assert_eq!(blur, convert[..blur.len()], "{spec}");
    }
}
