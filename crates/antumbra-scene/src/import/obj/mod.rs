//! Wavefront OBJ by way of `tobj`.

use super::error::{Problem, invalid};
use super::image;
use super::vertices::Vertices;
use crate::{AlphaMode, Image, Instance, Material, Scene};
use glam::{Mat4, Vec2, Vec3, Vec4};
use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// Imports a file with its material libraries and images.
pub(super) fn import(path: &Path) -> Result<Scene, Problem> {
    let bytes = fs::read(path).map_err(Problem::Read)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let options =
        tobj::LoadOptions { triangulate: true, single_index: true, ignore_points: true, ignore_lines: true };
    let library = |name: &Path| match fs::read(folder.join(name)) {
        Ok(bytes) => tobj::load_mtl_buf(&mut bytes.as_slice()),
        Err(_) => Err(tobj::LoadError::OpenFileFailed),
    };
    let (models, materials) = tobj::load_obj_buf(&mut bytes.as_slice(), &options, library)
        .map_err(|source| Problem::Obj { element: "geometry".into(), source })?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut scene = Scene { name, ..Scene::default() };
    match materials {
        Ok(materials) => add_materials(&mut scene, &materials, folder)?,
        Err(problem) => scene.notes.push(format!("materials are left out: {problem}")),
    }
    let plain = scene.materials.len();
    scene.materials.push(Material::default());
    for model in &models {
        let material = model.mesh.material_id.filter(|&m| m < plain).unwrap_or(plain);
        let vertices = vertices(&model.mesh, &model.name)?;
        scene.meshes.push(vertices.into_mesh(&model.name, material));
        let mesh = scene.meshes.len() - 1;
        scene.instances.push(Instance { mesh, world_from_mesh: Mat4::IDENTITY });
    }
    scene.validate()?;
    Ok(scene)
}

fn vertices(mesh: &tobj::Mesh, name: &str) -> Result<Vertices, Problem> {
    let count = mesh.positions.len() / 3;
    let threes = |values: &[f32]| -> Vec<Vec3> { values.chunks_exact(3).map(Vec3::from_slice).collect() };
    if let Some((place, index)) = mesh.indices.iter().enumerate().find(|(_, i)| **i as usize >= count) {
        let allowed = format!("it must be below {count}, the number of vertices");
        return Err(invalid(format!("object '{name}' index {place}"), index, allowed));
    }
    let or = |mut values: Vec<Vec3>, otherwise: Vec3| {
        values.resize(count, otherwise);
        values
    };
    // OBJ puts v = 0 at the bottom of the image, scenes at the top.
    let mut uvs: Vec<Vec2> = mesh.texcoords.chunks_exact(2).map(|uv| Vec2::new(uv[0], 1.0 - uv[1])).collect();
    uvs.resize(count, Vec2::ZERO);
    let normals = threes(&mesh.normals);
    Ok(Vertices {
        positions: threes(&mesh.positions),
        normals: if normals.len() == count { normals } else { Vec::new() },
        uvs,
        colors: or(threes(&mesh.vertex_color), Vec3::ONE).into_iter().map(|c| c.extend(1.0)).collect(),
        joints: Vec::new(),
        triangles: mesh.indices[..mesh.indices.len() / 3 * 3].to_vec(),
    })
}

fn add_materials(scene: &mut Scene, materials: &[tobj::Material], folder: &Path) -> Result<(), Problem> {
    let mut seen = HashMap::new();
    for material in materials {
        let key = (material.diffuse_texture.clone(), material.dissolve_texture.clone());
        let place = match seen.get(&key) {
            Some(&place) => place,
            None => {
                let place = images(scene, material, folder)?;
                seen.insert(key, place);
                place
            }
        };
        let color = if place.is_some() { Vec3::ONE } else { material.diffuse.map_or(Vec3::ONE, Vec3::from) };
        let cut = material.dissolve_texture.is_some();
        scene.materials.push(Material {
            name: material.name.clone(),
            base_color: Vec4::from((color, 1.0)),
            base_color_image: place,
            alpha: if cut { AlphaMode::Mask { cutoff: 0.5 } } else { AlphaMode::Opaque },
            ..Material::default()
        });
    }
    Ok(())
}

/// The diffuse map with the dissolve map as its alpha. A diffuse map that fails is noted, a
/// dissolve map that fails is an error: it decides about shape.
fn images(scene: &mut Scene, material: &tobj::Material, folder: &Path) -> Result<Option<usize>, Problem> {
    let load =
        |name: &str| -> Result<Image, Problem> {
            let element = format!("material '{}' map '{name}'", material.name);
            let bytes = fs::read(folder.join(name.replace('\\', "/")))
                .map_err(|source| Problem::Resource { element: element.clone(), uri: name.into(), source })?;
            let image = image::decode(&bytes).map_err(|message| Problem::Image { element, message })?;
            Ok(Image { name: name.into(), ..image })
        };
    let mut color = None;
    if let Some(name) = &material.diffuse_texture {
        match load(name) {
            Ok(image) => color = Some(image),
            Err(problem) => scene.notes.push(format!("{problem}; the plain colour is used")),
        }
    }
    if let Some(name) = &material.dissolve_texture {
        let mask = load(name)?;
        let whole = color.filter(|c| (c.width, c.height) == (mask.width, mask.height));
        let mut image = whole.unwrap_or_else(|| Image { rgba: vec![255; mask.rgba.len()], ..mask.clone() });
        for (pixel, mask) in image.rgba.chunks_exact_mut(4).zip(mask.rgba.chunks_exact(4)) {
            // Masks are grey; those drawn in the alpha channel of a white image count as well.
            pixel[3] = mask[0].min(mask[3]);
        }
        color = Some(image);
    }
    let Some(image) = color else { return Ok(None) };
    scene.images.push(image);
    Ok(Some(scene.images.len() - 1))
}
