//! What must hold of every scene that an importer returns.

use antumbra_scene::import::ImportError;
use antumbra_scene::{Scene, export};

/// Triangles and vertices up to which a scene is also used: a few hundred bytes can place the same mesh a million times.
const MOST: usize = 100_000;

pub fn check(loaded: Result<Scene, ImportError>) {
    let scene = match loaded {
        Ok(scene) => scene,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    assert_eq!(scene.validate(), Ok(()));
    let parts = || scene.instances.iter().map(|i| &scene.meshes[i.mesh]);
    if parts().map(|mesh| mesh.positions.len() + mesh.indices.len()).sum::<usize>() > MOST {
        return;
    }
    let geometry = scene.flatten();
    assert!(geometry.positions.iter().all(|p| p.is_finite()));
    assert!(geometry.indices.iter().all(|i| (*i as usize) < geometry.positions.len()));
    assert!(geometry.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-3));
    let pixels: usize = scene.images.iter().map(|image| image.rgba.len() / 4).sum();
    if pixels <= MOST {
        export::glb(&scene).unwrap();
    }
    let (camera, light) = (scene.main_camera(), scene.main_light());
    let with_views = Scene { cameras: vec![camera], lights: vec![light], ..scene };
    let _ = with_views.strays();
    with_views.validate().unwrap();
}
