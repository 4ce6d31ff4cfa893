//! Scenes as binary glTF, for other programs and for [`import`](crate::import).

use crate::{Aabb, AlphaMode, Camera, Image, Light, Material, Mesh, Projection, Scene, SceneError};
use glam::{DVec3, Mat4, Vec2, Vec3, Vec4};
use serde_json::{Value, json};

/// Why a scene cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The scene is not fit for use.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An image could not be packed.
    #[error("image {image} '{name}' cannot be packed as PNG: {source}")]
    Image {
        /// Index of the image.
        image: usize,
        /// Name of the image.
        name: String,
        /// What the encoder said.
        source: png::EncodingError,
    },
    /// The format counts bytes in 32 bits.
    #[error("the scene takes {bytes} bytes as GLB; the format allows at most {}", u32::MAX)]
    TooLarge {
        /// Size of the file.
        bytes: usize,
    },
}

/// Numbers that glTF borrowed from OpenGL.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
const CLAMP_TO_EDGE: u32 = 33_071;
const REPEAT: u32 = 10_497;

/// The scene as one GLB 2.0 file with everything in it: meshes, instances, materials, images (as
/// PNG), cameras and lights (`KHR_lights_punctual`). Meshes without triangles are left out, so
/// are [`Scene::notes`].
///
/// [`import::gltf_bytes`](crate::import::gltf_bytes) reads back the same triangles, bit for bit, and
/// the same views but for rounding; a camera's target comes back one unit in front of it. A scene with an
/// origin of its own hangs on one node there, and comes back as near as double precision has it.
///
/// Cost: 24 to 48 bytes a vertex and 12 a triangle of each mesh, however often it is placed.
///
/// # Errors
/// What [`Scene::validate`] refuses, and files of 4 GiB or more.
pub fn glb(scene: &Scene) -> Result<Vec<u8>, ExportError> {
    scene.validate()?;
    let mut file = Binary::default();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("antumbra ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
    });
    // Empty lists are not allowed in glTF.
    let mut put = |key: &str, list: Vec<Value>| {
        if !list.is_empty() {
            document[key] = Value::Array(list);
        }
    };
    let mut places = Vec::new();
    let mut meshes = Vec::new();
    for mesh in &scene.meshes {
        places.push((!mesh.indices.is_empty()).then_some(meshes.len()));
        if !mesh.indices.is_empty() {
            meshes.push(file.mesh(mesh));
        }
    }
    put("meshes", meshes);
    put("materials", scene.materials.iter().map(material).collect());
    let mut images = Vec::new();
    for (index, image) in scene.images.iter().enumerate() {
        let bytes = png(image).map_err(|source| ExportError::Image {
            image: index,
            name: image.name.clone(),
            source,
        })?;
        let view = file.view(&bytes, None);
        images.push(json!({ "name": image.name, "bufferView": view, "mimeType": "image/png" }));
    }
    // Image, sampler and texture share one number.
    let number = |i: usize| json!({ "source": i, "sampler": i });
    put("textures", (0..images.len()).map(number).collect());
    put("images", images);
    let wrap = |repeats: bool| if repeats { REPEAT } else { CLAMP_TO_EDGE };
    let sampler = |i: &Image| json!({ "wrapS": wrap(i.repeat[0]), "wrapT": wrap(i.repeat[1]) });
    put("samplers", scene.images.iter().map(sampler).collect());
    put("cameras", scene.cameras.iter().map(|c| camera(c, scene)).collect());
    let mut nodes = nodes(scene, &places);
    let mut roots: Vec<usize> = (0..nodes.len()).collect();
    let origin = scene.placement.direction(scene.placement.origin);
    if origin != DVec3::ZERO {
        nodes.push(json!({ "name": "origin", "translation": origin.to_array(), "children": roots }));
        roots = vec![nodes.len() - 1];
    }
    put("scenes", vec![json!({ "name": scene.name, "nodes": roots })]);
    put("nodes", nodes);
    put("buffers", vec![json!({ "byteLength": file.bytes.len() })]);
    put("bufferViews", file.views);
    put("accessors", file.accessors);
    if !scene.lights.is_empty() {
        let lights: Vec<Value> = scene.lights.iter().map(light).collect();
        document["extensionsUsed"] = json!(["KHR_lights_punctual"]);
        document["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
    }
    container(&document.to_string(), &file.bytes)
}

/// The file's one buffer, and what lies where in it.
#[derive(Debug, Default)]
struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    /// Appends bytes on a boundary of four and returns the number of their view.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Appends `count` elements of vertex data and returns the number of their accessor.
    fn floats(&mut self, values: impl Iterator<Item = f32>, count: usize, kind: &str) -> usize {
        let bytes: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        self.accessors
            .push(json!({ "bufferView": view, "componentType": FLOAT, "count": count, "type": kind }));
        self.accessors.len() - 1
    }

    /// A mesh of one primitive. Texture coordinates and colours that say nothing are left out.
    fn mesh(&mut self, mesh: &Mesh) -> Value {
        let count = mesh.positions.len();
        let positions = self.floats(mesh.positions.iter().flat_map(Vec3::to_array), count, "VEC3");
        let fold = |min: fn(Vec3, Vec3) -> Vec3| mesh.positions.iter().copied().reduce(min);
        if let (Some(min), Some(max)) = (fold(Vec3::min), fold(Vec3::max)) {
            self.accessors[positions]["min"] = json!(min.to_array());
            self.accessors[positions]["max"] = json!(max.to_array());
        }
        let mut attributes = json!({ "POSITION": positions });
        attributes["NORMAL"] =
            json!(self.floats(mesh.normals.iter().flat_map(Vec3::to_array), count, "VEC3"));
        if mesh.uvs.iter().any(|&uv| uv != Vec2::ZERO) {
            let uvs = mesh.uvs.iter().flat_map(Vec2::to_array);
            attributes["TEXCOORD_0"] = json!(self.floats(uvs, count, "VEC2"));
        }
        if mesh.colors.iter().any(|&color| color != Vec4::ONE) {
            let colors = mesh.colors.iter().flat_map(Vec4::to_array);
            attributes["COLOR_0"] = json!(self.floats(colors, count, "VEC4"));
        }
        let bytes: Vec<u8> = mesh.indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        let count = mesh.indices.len();
        self.accessors.push(
            json!({ "bufferView": view, "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR" }),
        );
        let indices = self.accessors.len() - 1;
        json!({
            "name": mesh.name,
            "primitives": [{ "attributes": attributes, "indices": indices, "material": mesh.material }],
        })
    }
}

fn material(material: &Material) -> Value {
    let mut out = json!({
        "name": material.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": material.base_color.to_array(),
            "metallicFactor": material.metallic,
            "roughnessFactor": material.roughness,
        },
        "doubleSided": material.double_sided,
    });
    if let Some(image) = material.base_color_image {
        out["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": image });
    }
    if let AlphaMode::Mask { cutoff } = material.alpha {
        out["alphaMode"] = json!("MASK");
        out["alphaCutoff"] = json!(cutoff);
    }
    out
}

fn camera(camera: &Camera, scene: &Scene) -> Value {
    match camera.projection {
        Projection::Perspective { fov_y } => {
            json!({ "type": "perspective", "perspective": { "yfov": fov_y, "znear": 0.01 } })
        }
        // The format asks for a width, here of a picture of 4:3, and for a far plane, here behind everything.
        Projection::Orthographic { height } => {
            let reach = |bounds: Aabb| bounds.center().distance(camera.position) + bounds.radius();
            let (xmag, ymag, far) = (height * 2.0 / 3.0, height / 2.0, scene.bounds().map_or(1.0, reach));
            let lens = json!({ "xmag": xmag, "ymag": ymag, "znear": 0.0, "zfar": far.max(1e-3) });
            json!({ "type": "orthographic", "orthographic": lens })
        }
    }
}

fn light(light: &Light) -> Value {
    match *light {
        Light::Directional { .. } => json!({ "type": "directional" }),
        Light::Spot { outer_angle, .. } => {
            json!({ "type": "spot", "spot": { "innerConeAngle": 0.0, "outerConeAngle": outer_angle } })
        }
    }
}

/// One node for each camera, light and placed mesh.
fn nodes(scene: &Scene, places: &[Option<usize>]) -> Vec<Value> {
    let views = scene.cameras.iter().enumerate().map(|(index, camera)| {
        let matrix = looking(camera.position, camera.target - camera.position, camera.up);
        json!({ "name": format!("camera {index}"), "camera": index, "matrix": matrix })
    });
    let lights = scene.lights.iter().enumerate().map(|(index, light)| {
        let (position, direction) = match *light {
            Light::Directional { direction } => (Vec3::ZERO, direction),
            Light::Spot { position, direction, .. } => (position, direction),
        };
        let matrix = looking(position, direction, direction.any_orthonormal_vector());
        let extension = json!({ "KHR_lights_punctual": { "light": index } });
        json!({ "name": format!("light {index}"), "extensions": extension, "matrix": matrix })
    });
    let meshes = scene.instances.iter().filter_map(|instance| {
        let mesh = places[instance.mesh]?;
        let mut node = json!({ "mesh": mesh });
        if let Some(name) =
            instance.node.and_then(|n| Some(&scene.nodes.get(n)?.name)).filter(|n| !n.is_empty())
        {
            node["name"] = json!(name);
        }
        let matrix = instance.world_from_mesh;
        let single = matrix.as_mat4();
        if single.as_dmat4() != matrix {
            node["matrix"] = json!(matrix.to_cols_array());
        } else if single != Mat4::IDENTITY {
            // The same number in fewer digits.
            node["matrix"] = json!(single.to_cols_array());
        }
        Some(node)
    });
    views.chain(lights).chain(meshes).collect()
}

/// The matrix of a node that looks along its −z axis.
fn looking(position: Vec3, forward: Vec3, up: Vec3) -> [f32; 16] {
    let back = -forward.as_dvec3().normalize();
    let right = up.as_dvec3().cross(back).normalize();
    let rotation = glam::DMat3::from_cols(right, back.cross(right), back);
    let matrix = glam::DMat4::from_mat3(rotation).as_mat4();
    (Mat4::from_translation(position) * matrix).to_cols_array()
}

fn png(image: &Image) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width, image.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&image.rgba)?;
    writer.finish()?;
    Ok(bytes)
}

/// Header, JSON chunk, binary chunk; each chunk is filled up to a multiple of four bytes.
fn container(json: &str, binary: &[u8]) -> Result<Vec<u8>, ExportError> {
    let sizes = [json.len(), binary.len()].map(|n| n.next_multiple_of(4));
    let total = 12 + 8 + sizes[0] + 8 + sizes[1];
    let length = u32::try_from(total).map_err(|_| ExportError::TooLarge { bytes: total })?;
    let mut out = Vec::with_capacity(total);
    out.extend(b"glTF");
    out.extend([2, length].iter().flat_map(|n| n.to_le_bytes()));
    for (bytes, size, kind, fill) in
        [(json.as_bytes(), sizes[0], b"JSON", b' '), (binary, sizes[1], b"BIN\0", 0)]
    {
        let end = out.len() + 8 + size;
        // The total fits, so its parts do.
        out.extend((size as u32).to_le_bytes());
        out.extend(kind);
        out.extend(bytes);
        out.resize(end, fill);
    }
    Ok(out)
}
