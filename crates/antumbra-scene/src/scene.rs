//! The scene as files describe it.

use crate::{Numbered, Placement};
use glam::{DMat4, Vec2, Vec3, Vec4};

/// Meshes, materials and images, the instances that place the meshes, and what was said of cameras
/// and lights. +Y is up; lengths are in the scene's own unit (metres for glTF). Where a file's coordinates
/// are large against the scene, the scene has an origin of its own: see [`Placement`].
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Name of the file or generator.
    pub name: String,
    /// One entry per glTF primitive.
    pub meshes: Vec<Mesh>,
    /// Where each mesh stands. Several instances may share one mesh.
    pub instances: Vec<Instance>,
    /// Nodes of a glTF file, objects and groups of an OBJ file; `Instance::node` indexes them.
    pub nodes: Vec<Node>,
    /// Surface descriptions; `Mesh::material` indexes them.
    pub materials: Vec<Material>,
    /// Decoded images; `Material::base_color_image` indexes them.
    pub images: Vec<Image>,
    /// Cameras in world space, in file order.
    pub cameras: Vec<Camera>,
    /// Lights in world space, in file order.
    pub lights: Vec<Light>,
    /// Every camera of the file, also those that were not taken, by the number that it has there.
    /// Empty for scenes that come from no glTF file: there, numbers are places in `cameras`.
    pub camera_numbers: Vec<Numbered>,
    /// Every light of the file, likewise.
    pub light_numbers: Vec<Numbered>,
    /// Where the scene lies in its file's coordinates.
    pub placement: Placement,
    /// What an importer left out or changed, one sentence each.
    pub notes: Vec<String>,
}

/// An indexed triangle list in the space of its mesh.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Name for messages.
    pub name: String,
    /// Vertex positions, all finite.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per position.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one per position (zero where the file has none), texture transform
    /// already applied.
    pub uvs: Vec<Vec2>,
    /// Linear RGBA, one per position (white where the file has none).
    pub colors: Vec<Vec4>,
    /// Three indices per triangle, each below `positions.len()`.
    pub indices: Vec<u32>,
    /// Index into `Scene::materials`.
    pub material: usize,
}

/// One placed mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// Index into `Scene::meshes`.
    pub mesh: usize,
    /// Index into `Scene::nodes`: the node or group that it hangs on, if there is one.
    pub node: Option<usize>,
    /// Affine transform; may mirror and scale non-uniformly. In double precision, since meshes may have
    /// coordinates of their own that are far from the scene's origin.
    pub world_from_mesh: DMat4,
}

impl Instance {
    /// One that hangs on nothing.
    #[must_use]
    pub fn new(mesh: usize, world_from_mesh: DMat4) -> Self {
        Self { mesh, node: None, world_from_mesh }
    }
}

/// What a file calls a part of the scene.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Node {
    /// Its name; may be empty, need not be the only one.
    pub name: String,
    /// Index into `Scene::nodes`: what it hangs on. There are no loops.
    pub parent: Option<usize>,
}

/// How a surface uses the alpha of its base colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// A point is there where alpha ≥ cutoff, for cameras and for shadows alike.
    Mask {
        /// Threshold, usually 0.5.
        cutoff: f32,
    },
}

/// Metallic-roughness surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name for messages.
    pub name: String,
    /// Linear RGBA factor.
    pub base_color: Vec4,
    /// Index into `Scene::images`; sRGB colour with straight alpha.
    pub base_color_image: Option<usize>,
    /// 0 dielectric .. 1 metal.
    pub metallic: f32,
    /// 0 smooth .. 1 rough.
    pub roughness: f32,
    /// Cut-out or not. What becomes of blended surfaces [`import::Blend`](crate::import::Blend) says.
    pub alpha: AlphaMode,
    /// What the file says. Casters stop light from both sides either way, and so do cameras unless
    /// [`Geometry::single_sided`](crate::Geometry::single_sided) says so.
    pub double_sided: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: "default".into(),
            base_color: Vec4::ONE,
            base_color_image: None,
            metallic: 0.0,
            roughness: 0.8,
            alpha: AlphaMode::Opaque,
            double_sided: true,
        }
    }
}

/// 8-bit RGBA pixels, row by row from the top left, with repeat or clamp addressing.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Name for messages.
    pub name: String,
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
    /// `4 · width · height` bytes: sRGB colour, straight alpha.
    pub rgba: Vec<u8>,
    /// Addressing outside 0 to 1: true repeats, false clamps to the edge, in x and y.
    pub repeat: [bool; 2],
}

/// A camera that looks from its position at its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// World position of the eye; of an orthographic camera the middle of the plane on which its rays
    /// begin.
    pub position: Vec3,
    /// World point in the middle of the picture.
    pub target: Vec3,
    /// Upwards in the picture, roughly: turned about the line of sight it rolls the camera. Not parallel
    /// to the line of sight.
    pub up: Vec3,
    /// How the world becomes a picture.
    pub projection: Projection,
}

/// How the world becomes a picture; the picture's width follows from its ratio of sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Rays meet in the eye.
    Perspective {
        /// Vertical field of view, radians, more than 0 and less than π.
        fov_y: f32,
    },
    /// Rays are parallel.
    Orthographic {
        /// Height of the picture in the scene's unit, more than 0.
        height: f32,
    },
}

impl Projection {
    /// Whether a picture can be made with it: its number is in range.
    #[must_use]
    pub fn is_usable(&self) -> bool {
        match *self {
            Self::Perspective { fov_y } => fov_y > 0.0 && fov_y < std::f32::consts::PI,
            Self::Orthographic { height } => height > 0.0 && height.is_finite(),
        }
    }

    /// Width of a pixel, in the scene's unit, at a distance along the line of sight, in a picture of
    /// `rows` rows.
    #[must_use]
    pub fn pixel_size(&self, distance: f64, rows: u32) -> f64 {
        let height = match *self {
            Self::Perspective { fov_y } => 2.0 * (0.5 * f64::from(fov_y)).tan() * distance,
            Self::Orthographic { height } => height.into(),
        };
        height / f64::from(rows)
    }
}

/// A light, in world space. Directions point the way the light travels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// Parallel rays.
    Directional {
        /// Unit vector.
        direction: Vec3,
    },
    /// A cone.
    Spot {
        /// Apex.
        position: Vec3,
        /// Unit vector along the axis.
        direction: Vec3,
        /// Half angle of the cone in radians, more than 0, at most [`Light::MAX_OUTER_ANGLE`].
        outer_angle: f32,
    },
}

impl Light {
    /// Widest half angle of a spot, radians (84.8°): near 90° one picture holds no cone any more,
    /// since its sides lie at tan 90°. Files and users may ask for up to 90°, and get this.
    pub const MAX_OUTER_ANGLE: f32 = 1.48;

    /// What a note says of a spot whose half angle of `asked` radians was narrowed.
    #[must_use]
    pub fn narrowed(asked: f32) -> String {
        format!(
            "the spot's half angle of {:.1}° is narrowed to {:.1}°, the most that one shadow map holds",
            asked.to_degrees(),
            Self::MAX_OUTER_ANGLE.to_degrees()
        )
    }

    /// Moves it: its direction, and its position about the scene's origin.
    pub(crate) fn turn(&mut self, turned: impl Fn(Vec3) -> Vec3) {
        let (Self::Directional { direction } | Self::Spot { direction, .. }) = self;
        *direction = turned(*direction);
        if let Self::Spot { position, .. } = self {
            *position = turned(*position);
        }
    }
}
