//! What was rendered: scene, camera, light and the light's views.

use serde::{Deserialize, Serialize};

/// What was rendered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneFacts {
    /// File or generator.
    pub name: String,
    /// Triangles after instancing.
    pub triangles: u64,
    /// The light.
    pub light: LightFacts,
    /// The camera.
    pub camera: CameraFacts,
    /// The point of the file's coordinates that all others here are relative to: zero, unless those are
    /// large against the scene.
    #[serde(default)]
    pub origin: [f64; 3],
    /// World-space box around the geometry.
    pub bounds: BoundsFacts,
}

/// The light, world space; directions point the way the light travels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LightFacts {
    /// Parallel rays.
    Directional {
        /// Unit vector.
        direction: [f32; 3],
    },
    /// A cone.
    Spot {
        /// Apex.
        position: [f32; 3],
        /// Unit vector along the axis.
        direction: [f32; 3],
        /// Half angle of the cone, degrees.
        outer_angle_deg: f32,
    },
}

/// A camera, world space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CameraFacts {
    /// Eye.
    pub position: [f32; 3],
    /// Point in the middle of the picture.
    pub target: [f32; 3],
    /// Roughly up.
    pub up: [f32; 3],
    /// `fov_y_deg` or `height`.
    #[serde(flatten)]
    pub lens: LensFacts,
}

/// How a camera projects.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum LensFacts {
    /// Perspective: vertical field of view, degrees.
    #[serde(rename = "fov_y_deg")]
    FovYDeg(f32),
    /// Orthographic: height of the picture, world units.
    #[serde(rename = "height")]
    Height(f32),
}

/// An axis-aligned box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoundsFacts {
    /// Smallest corner.
    pub min: [f32; 3],
    /// Largest corner.
    pub max: [f32; 3],
}

/// One of the light's views.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ViewFacts {
    /// World size of a texel; at unit distance along the axis of a spot.
    pub texel_world: f32,
    /// World length of its depth range.
    pub depth_world: f32,
}
