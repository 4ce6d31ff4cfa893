//! What can go wrong, one enum per verb.

use thiserror::Error;

mod casters;

pub use casters::{CasterError, MeshError};

/// A setting that a technique does not have or does not take.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SettingError {
    /// No technique has that name.
    #[error("unknown technique '{name}'; known: {}", known.join(", "))]
    UnknownTechnique {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// The technique has no parameter of that name.
    #[error("{technique} has no parameter '{name}'; it has: {}", known.join(", "))]
    UnknownParameter {
        /// Technique that was asked.
        technique: String,
        /// Parameter that was asked for.
        name: String,
        /// Parameters that it has.
        known: Vec<String>,
    },
    /// A number outside the allowed range, not finite, or not whole where it must be.
    #[error("{parameter} = {value} is out of range; allowed: {allowed}")]
    OutOfRange {
        /// `technique.parameter`.
        parameter: String,
        /// What was given.
        value: String,
        /// The range or rule.
        allowed: String,
    },
    /// Not of the form `name.parameter=value,…`.
    #[error("cannot read '{spec}': {reason}; write for example esm.c=60,kernel=7")]
    Syntax {
        /// The text that was given.
        spec: String,
        /// What is wrong with it.
        reason: String,
    },
    /// Not a bias as text.
    #[error(
        "cannot read the bias '{text}': {reason}; write auto, none, or for example constant_texels=1,slope_texels=0.5"
    )]
    BiasSyntax {
        /// The text that was given.
        text: String,
        /// What is wrong with it.
        reason: String,
    },
}

/// What is wrong with a [`Description`](crate::Description).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum DescriptionError {
    /// The WGSL needs a file that does not exist.
    #[error("its WGSL needs '{stem}', which is no file of the library; there are: {}", known.join(", "))]
    File {
        /// Stem of the file.
        stem: String,
        /// Stems of all files.
        known: Vec<String>,
    },
    /// The WGSL needs a slot that nothing fills.
    #[error("nothing fills the slot '{slot}' that its WGSL needs; add one of these to Description::slots: {}", files.join(", "))]
    Slot {
        /// Name of the slot.
        slot: String,
        /// Files that fill it.
        files: Vec<String>,
    },
    /// A constant that does not have one declaration.
    #[error(
        "its WGSL declares the constant '{name}' {found} times; write 'const {name}: …;' once, on one line"
    )]
    Constant {
        /// Name of the constant.
        name: String,
        /// Declarations that there are.
        found: usize,
    },
    /// A loop that is marked to be written out, and cannot be.
    #[error(
        "the loop '{line}' cannot be written out; write 'for (var i = 0u; i < COUNT; i += 1u) {{ // unrolled' with a constant 'const COUNT: u32'"
    )]
    Loop {
        /// Its first line.
        line: String,
    },
    /// No caster pass.
    #[error("it has no sample offsets; a single caster pass has one, of zero")]
    SampleOffsets,
    /// More caster passes than the first map has channels.
    #[error(
        "{passes} caster passes fill {passes} channels of the first map, which has {layers} layers of four"
    )]
    Layers {
        /// Caster passes.
        passes: usize,
        /// Layers of the first map.
        layers: u32,
    },
    /// Several caster passes where triangles are kept.
    #[error(
        "it keeps triangles and has {passes} sample offsets; casters are drawn once, from the centres of texels: leave one, of zero"
    )]
    Passes {
        /// Caster passes.
        passes: usize,
    },
    /// No map for the nearest triangles.
    #[error(
        "it keeps the nearest triangle in {layers} ways; describe one map, of {layers} layers, in Description::maps"
    )]
    Nearest {
        /// Layers that the map must have.
        layers: usize,
    },
    /// A binding of a map that is not kept.
    #[error("it binds map {index}, counted from 0, and has {maps}; add the map to Description::maps")]
    Map {
        /// Index of the map.
        index: usize,
        /// Maps that there are.
        maps: usize,
    },
}

/// Why a [`ShadowMap`](crate::ShadowMap) cannot be made on this device.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Unsupported {
    /// GL and WebGL2 can only compare depth textures, so nothing could be converted.
    #[error(
        "the {backend} backend is not supported (a depth texture can only be compared there); use Vulkan, Metal, DX12 or WebGPU"
    )]
    Backend {
        /// Name of the backend.
        backend: String,
    },
    /// Zero, or larger than the device allows.
    #[error("a map of {width}×{height} texels is not possible; each side must be 1 to {max} on this device")]
    Size {
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
        /// Largest side.
        max: u32,
    },
    /// Zero views, or more layers than the device allows.
    #[error("{views} views need texture arrays of {layers} layers; 1 to {max} are possible on this device")]
    Layers {
        /// Views asked for.
        views: u32,
        /// Layers of the largest array.
        layers: u32,
        /// Largest number.
        max: u32,
    },
    /// No light.
    #[error("a map for 0 lights is not possible; it has 1 at least: see Options::lights")]
    Lights,
    /// A technique whose WGSL takes each view for a layer.
    #[error(
        "{technique} cannot have views in tiles: its WGSL reads textures without tile_layer and what comes with it; name tile in its //! needs, or take a map without Options::tiled"
    )]
    Tiles {
        /// Name of the technique.
        technique: String,
    },
    /// A feature or limit that the technique cannot do without.
    #[error("{technique} needs {what}, which this device lacks; {instead}")]
    Feature {
        /// Name of the technique.
        technique: String,
        /// The feature or limit.
        what: String,
        /// What to do.
        instead: String,
    },
    /// Less memory than the map takes.
    #[error(
        "the device has no memory for {technique} with {views} views of {width}×{height} texels, {} MiB in all; take a smaller map, fewer views, or a technique or storage with fewer bytes per texel", bytes / (1 << 20)
    )]
    Memory {
        /// Name of the technique.
        technique: String,
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
        /// Views that it was to have room for.
        views: u32,
        /// What it would have taken, the caller's depth included.
        bytes: u64,
    },
    /// The device takes a shader or an object for invalid: that of a technique of the caller's own, or a
    /// mistake in this library.
    #[error("the device refuses what {technique} is made of: {reason}")]
    Refused {
        /// Name of the technique.
        technique: String,
        /// What the device says.
        reason: String,
    },
    /// Settings that a living map cannot take.
    #[error(
        "a map of {has} cannot become one of {asked}: other textures or shaders follow from that; make a new map"
    )]
    Fixed {
        /// The technique that it has, with its settings.
        has: String,
        /// The one that was given.
        asked: String,
    },
    /// A technique's description that contradicts itself, or whose WGSL cannot be put together.
    #[error("the description of {technique} is wrong: {error}")]
    Description {
        /// Name of the technique.
        technique: String,
        /// What is wrong.
        error: DescriptionError,
    },
    /// A shader for cut-outs that the device does not take.
    #[error("the device refuses the shader that leaves holes in the casters of {technique}: {reason}")]
    Cutout {
        /// Name of the technique.
        technique: String,
        /// What is wrong.
        reason: String,
    },
    /// Depth alone does not hold what the technique keeps.
    #[error(
        "{technique} keeps triangles, which a depth texture does not hold; use ShadowMap::new and draw CasterMesh in the closure of encode"
    )]
    Triangles {
        /// Name of the technique.
        technique: String,
    },
    /// The caller's depth texture cannot be read.
    #[error("the depth texture has {what} = {found}; needed: {needed}")]
    Depth {
        /// Property.
        what: &'static str,
        /// Its value.
        found: String,
        /// What is accepted.
        needed: String,
    },
    /// A setting of the technique is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

/// What is no word for names in WGSL.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "'{name}' is no word that names can begin with; allowed: a lower-case letter, then lower-case letters, digits and single underscores"
)]
pub struct NameError {
    /// What was given.
    pub name: String,
}

/// Why a light has no view.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LightError {
    /// Zero, NaN or infinite direction.
    #[error("light direction {direction} has no length or is not finite")]
    Direction {
        /// What was given.
        direction: glam::Vec3,
    },
    /// Zero, NaN or infinite position.
    #[error("light position {position} is not finite")]
    Position {
        /// What was given.
        position: glam::Vec3,
    },
    /// A spot's half angle must leave a perspective projection possible.
    #[error(
        "outer angle {radians} rad is out of range; allowed: more than 0, at most {max} ({:.1}°)",
        max.to_degrees()
    )]
    Angle {
        /// Half angle in radians.
        radians: f32,
        /// Largest.
        max: f32,
    },
    /// Bounds with min > max or non-finite corners.
    #[error("bounds {min} – {max} of the {what} are empty or not finite")]
    Bounds {
        /// scene, casters or receivers.
        what: &'static str,
        /// Smallest corner.
        min: glam::Vec3,
        /// Largest corner.
        max: glam::Vec3,
    },
    /// The camera's matrix holds NaN or infinity, or flattens the world.
    #[error(
        "the camera's matrix {matrix} {fault}; needed: projection times view, from world to clip space, finite and with an inverse"
    )]
    Camera {
        /// What is wrong with it.
        fault: &'static str,
        /// What was given.
        matrix: glam::Mat4,
    },
    /// The camera sees nothing of the receivers.
    #[error("no receiver lies inside the camera's view{at}")]
    NothingVisible {
        /// Which part of the view, if only part.
        at: String,
    },
    /// The map is too small for its margin.
    #[error("a map of {size} texels cannot hold a margin of {margin} texels on each side")]
    Margin {
        /// Smaller side in texels.
        size: u32,
        /// Margin in texels.
        margin: f32,
    },
    /// No cascades, or too many.
    #[error("{count} cascades are not possible; allowed: 1 to {max}")]
    Cascades {
        /// What was given.
        count: u32,
        /// Largest number.
        max: u32,
    },
    /// Neither even nor logarithmic nor between them.
    #[error("a blend of {blend} between even and logarithmic cascades is not possible; allowed: 0 to 1")]
    Blend {
        /// What was given.
        blend: f32,
    },
}
