//! Rust and WGSL see the same bytes: asked of the shader by reflection.

use super::{
    Frame,
    masks::{Corner, Mask},
    materials::MaterialUniform,
};
use std::mem::offset_of;

/// What is wrong if the struct `name` in `wgsl` differs from these members, offsets and size.
fn check(wgsl: &str, name: &str, members: &[(&str, usize)], size: usize) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|e| e.emit_to_string(wgsl))?;
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let Some((_, naga::Type { inner: naga::TypeInner::Struct { members: theirs, span }, .. })) = found else {
        return Err(format!("no struct {name}"));
    };
    let theirs: Vec<(&str, usize)> =
        theirs.iter().map(|m| (m.name.as_deref().unwrap_or_default(), m.offset as usize)).collect();
    if theirs != members || *span as usize != size {
        return Err(format!("{name}: WGSL {theirs:?} in {span} bytes, Rust {members:?} in {size}"));
    }
    Ok(())
}

macro_rules! members {
    ($of:ty: $($member:ident),+) => { [$((stringify!($member), offset_of!($of, $member))),+] };
}

const WGSL: &str = include_str!("frame.wgsl");

fn frame() -> [(&'static str, usize); 8] {
    members!(Frame: clip_from_relative, eye, ray, ray_right, ray_down, to_light, cone, forward)
}

#[test]
fn uniforms_have_one_layout() {
    check(WGSL, "Frame", &frame(), size_of::<Frame>()).unwrap();
    let material = members!(MaterialUniform: base_color, metallic, roughness, cutoff, mask);
    check(WGSL, "Material", &material, size_of::<MaterialUniform>()).unwrap();
}

const COVERS: &str = include_str!("covers.wgsl");

fn mask() -> [(&'static str, usize); 7] {
    members!(Mask: start, width, height, repeats, alpha, cutoff, first)
}

/// Corners are vectors of three floats, which begin every four.
#[test]
fn masks_have_one_layout() {
    check(COVERS, "Mask", &mask(), size_of::<Mask>()).unwrap();
    let module = naga::front::wgsl::parse_str(COVERS).unwrap();
    let (_, corners) =
        module.global_variables.iter().find(|(_, v)| v.name.as_deref() == Some("mask_corners")).unwrap();
    let naga::TypeInner::Array { stride, .. } = module.types[corners.ty].inner else { panic!("no array") };
    assert_eq!(stride as usize, size_of::<Corner>());
}

#[test]
fn another_layout_is_noticed() {
    let broken = [
        WGSL.replace(
            "    ray_right: vec4f,\n    ray_down: vec4f,",
            "    ray_down: vec4f,\n    ray_right: vec4f,",
        ),
        WGSL.replace("    eye: vec4f,", "    eye: vec3f,\n    more: f32,"),
        WGSL.replace("    forward: vec4f,", "    forward: vec4f,\n    more: f32,"),
        WGSL.replace("struct Frame", "struct Fame"),
    ];
    let wgsl = COVERS.replace("    alpha: f32,\n    cutoff: f32,", "    cutoff: f32,\n    alpha: f32,");
    assert_ne!(wgsl, COVERS);
    check(&wgsl, "Mask", &mask(), size_of::<Mask>()).unwrap_err();
    for wgsl in broken {
        assert_ne!(wgsl, WGSL);
        check(&wgsl, "Frame", &frame(), size_of::<Frame>()).unwrap_err();
    }
}
