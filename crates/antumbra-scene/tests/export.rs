//! What is exported is what is imported.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra_scene::{
    AlphaMode, Camera, Geometry, Image, Instance, Light, Material, Mesh, Projection, Scene,
    export::{self, ExportError},
    import, procedural,
};
use glam::{DMat4, DVec3, Mat4, Quat, Vec2, Vec3, Vec4};

fn same_camera(a: &Camera, b: &Camera) {
    let forward = |c: &Camera| (c.target - c.position).normalize();
    let right = |c: &Camera| forward(c).cross(c.up).normalize();
    assert!(a.position == b.position && a.projection == b.projection);
    assert!(forward(a).distance(forward(b)) < 1e-6 && right(a).distance(right(b)) < 1e-6);
}

fn same_light(a: &Light, b: &Light) {
    match (*a, *b) {
        (Light::Directional { direction: a }, Light::Directional { direction: b }) => {
            assert!(a.distance(b) < 1e-6);
        }
        (
            Light::Spot { position: p, direction: a, outer_angle: x },
            Light::Spot { position: q, direction: b, outer_angle: y },
        ) => assert!(p == q && a.distance(b) < 1e-6 && x == y),
        _ => panic!("{a:?} became {b:?}"),
    }
}

/// An attribute of all corners of all triangles.
fn corners<T: Copy>(geometry: &Geometry, attribute: &[T]) -> impl Iterator<Item = T> {
    geometry.indices.iter().map(|&i| attribute[i as usize])
}

fn same<T: PartialEq>(one: impl Iterator<Item = T>, two: impl Iterator<Item = T>) -> bool {
    one.eq(two)
}

/// The scene after a round trip through a file.
fn again(scene: &Scene) -> Scene {
    let back = import::gltf_bytes(&export::glb(scene).unwrap(), &scene.name).unwrap();
    assert_eq!(back.notes, [""; 0]);
    let (one, two) = (scene.flatten(), back.flatten());
    // Vertices that no triangle uses do not come back, so corners are compared. Not by assert_eq,
    // which would print them all.
    assert!(same(corners(&one, &one.positions), corners(&two, &two.positions)), "{} positions", scene.name);
    assert!(same(corners(&one, &one.uvs), corners(&two, &two.uvs)), "{} uvs", scene.name);
    assert!(same(corners(&one, &one.colors), corners(&two, &two.colors)), "{} colours", scene.name);
    let mut normals = corners(&one, &one.normals).zip(corners(&two, &two.normals));
    assert!(normals.all(|(a, b)| a.distance(b) < 1e-6), "{} normals", scene.name);
    assert_eq!((&one.groups, &one.materials), (&two.groups, &two.materials));
    assert_eq!((scene.cameras.len(), scene.lights.len()), (back.cameras.len(), back.lights.len()));
    scene.cameras.iter().zip(&back.cameras).for_each(|(a, b)| same_camera(a, b));
    scene.lights.iter().zip(&back.lights).for_each(|(a, b)| same_light(a, b));
    back
}

#[test]
fn procedural_scenes_come_back() {
    for name in ["fence", "spheres", "contact", "spot", "layers", "blocks", "brabec"] {
        again(&procedural::by_name(name).unwrap().scene(2));
    }
}

/// A cut-out triangle with colours, placed twice, once mirrored; a mesh without triangles; no views.
fn cut_out() -> Scene {
    let rgba = (0..24).map(|i| i * 10).collect();
    let image = Image { name: "six".into(), width: 3, height: 2, rgba, repeat: [true, false] };
    let material = Material {
        name: "leaf".into(),
        base_color: Vec4::new(0.1, 0.2, 0.3, 0.9),
        base_color_image: Some(0),
        metallic: 0.25,
        roughness: 0.6,
        alpha: AlphaMode::Mask { cutoff: 0.3 },
        double_sided: false,
    };
    let mesh = Mesh {
        name: "triangle".into(),
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(0.1, 0.7, -3.0)],
        normals: vec![Vec3::Z; 3],
        uvs: vec![Vec2::ZERO, Vec2::X, Vec2::splat(-1.5)],
        colors: vec![Vec4::ONE, Vec4::new(0.1, 0.2, 0.3, 0.4), Vec4::splat(0.7)],
        indices: vec![0, 1, 2],
        material: 0,
    };
    let turned = Mat4::from_scale_rotation_translation(
        Vec3::new(-1.0, 2.0, 0.3),
        Quat::from_rotation_y(0.7),
        Vec3::new(3.0, 0.1, -7.0),
    );
    Scene {
        name: "cut-out".into(),
        meshes: vec![Mesh { material: 0, ..Mesh::default() }, mesh],
        instances: vec![
            Instance::new(1, turned.as_dmat4()),
            Instance::new(0, DMat4::IDENTITY),
            Instance::new(1, DMat4::IDENTITY),
        ],
        materials: vec![material],
        images: vec![image],
        ..Scene::default()
    }
}

#[test]
fn orthographic_and_rolled_cameras_come_back() {
    let mut scene = procedural::by_name("contact").unwrap().scene(1);
    let first = scene.cameras[0];
    scene.cameras.push(Camera { up: Vec3::new(0.3, 0.8, -0.1), ..first });
    scene.cameras.push(Camera { projection: Projection::Orthographic { height: 2.5 }, ..first });
    again(&scene);
}

#[test]
fn images_colours_and_mirrored_instances_come_back() {
    let scene = cut_out();
    let back = again(&scene);
    assert_eq!(back.images.len(), 1);
    assert_eq!((&back.images[0].rgba, back.images[0].repeat), (&scene.images[0].rgba, [true, false]));
    assert_eq!(back.instances.len(), 2);
}

#[test]
fn an_origin_comes_back() {
    let mut scene = cut_out();
    scene.placement.origin = DVec3::new(4_180_370.0, -20.0, 855_120.0);
    scene.cameras.push(procedural::by_name("contact").unwrap().scene(1).cameras[0]);
    let back = import::gltf_bytes(&export::glb(&scene).unwrap(), "far").unwrap();
    let moved = |scene: &Scene| {
        let geometry = scene.flatten();
        let points = corners(&geometry, &geometry.positions).map(|p| scene.placement.in_file(p));
        points.collect::<Vec<_>>()
    };
    let places = moved(&scene).into_iter().zip(moved(&back));
    // Micrometres; single precision would have half a metre.
    assert!(places.into_iter().all(|(a, b)| a.distance(b) < 4e-6));
    let eyes = [&scene, &back].map(|s| s.placement.in_file(s.cameras[0].position));
    assert!(eyes[0].distance(eyes[1]) < 4e-6, "{eyes:?}");
    assert!(back.placement.origin.length() > 4e6, "{:?}", back.placement);
}

#[test]
fn a_changed_file_does_not_come_back() {
    let scene = cut_out();
    let mut bytes = export::glb(&scene).unwrap();
    // Positions come first in the binary chunk: this is the exponent of the second vertex's x.
    let json = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    bytes[20 + json + 8 + 12 + 2] ^= 0x80;
    let back = import::gltf_bytes(&bytes, "changed").unwrap();
    let (one, two) = (scene.flatten(), back.flatten());
    assert!(!same(corners(&one, &one.positions), corners(&two, &two.positions)));
}

#[test]
fn unfit_scenes_are_refused() {
    let mut scene = cut_out();
    scene.meshes[1].indices[2] = 3;
    let error = export::glb(&scene).unwrap_err();
    assert!(
        matches!(error, ExportError::Scene(_)) && error.to_string().contains("indices[2] is 3"),
        "{error}"
    );
}
