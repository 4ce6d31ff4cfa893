//! The scene and how it is seen: the same options in every command that draws.

use crate::{file_arguments::FileArguments, suggestions, views::Axis};
use clap::Args;

/// Which parts of a file are there, and how they stand.
#[derive(Debug, Clone, Args)]
pub(crate) struct Arrangement {
    /// The axis of the file that points upwards
    #[arg(long, value_enum, default_value_t = Axis::Y, allow_hyphen_values = true, value_name = "AXIS")]
    pub(crate) up: Axis,
    /// A node (with all below it), mesh or material that is left out; * stands for any letters. May be given
    /// more than once
    #[arg(long, value_name = "NAME")]
    pub(crate) leave_out: Vec<String>,
    /// Let the camera see through the backs of single-sided materials, as into a room from outside; they
    /// cast shadows all the same
    #[arg(long)]
    pub(crate) single_sided: bool,
}

/// The scene and how it is seen.
#[derive(Debug, Clone, Args)]
pub(crate) struct SceneArguments {
    /// A .glb, .gltf or .obj file, or the name of a built-in scene (see `antumbra scenes`)
    #[arg(default_value = "fence", value_parser = suggestions::SCENES, hide_possible_values = true)]
    pub(crate) scene: String,
    #[command(flatten)]
    pub(crate) view: ViewArguments,
    /// What keeps surfaces from shadowing themselves: auto, none, or terms such as
    /// constant_texels=1,receiver_plane=1 (see `antumbra bias --help`)
    #[arg(long, default_value = "auto", value_name = "BIAS")]
    pub(crate) bias: String,
}

/// How a scene is seen and lit, and the maps that shadow it.
#[derive(Debug, Clone, Args)]
pub(crate) struct ViewArguments {
    /// Seed of a built-in scene
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Eye, target, vertical field of view in degrees (50 if left out) and roll in degrees (0 if left
    /// out, clockwise), as x,y,z:x,y,z:degrees:roll, or ortho:x,y,z:x,y,z:height:roll (parallel rays, a
    /// picture of that height), or the number that the file gives a camera (N, or N.K for the K-th place
    /// of one that stands in several); default: the file's first camera, else one from which shadows
    /// are seen
    #[arg(long, allow_hyphen_values = true, value_name = "CAMERA")]
    pub(crate) camera: Option<String>,
    /// Direction of the sun as x,y,z (the way light travels), or spot:x,y,z:x,y,z:degrees (position,
    /// direction, half angle up to 90), or the number that the file gives a light (N or N.K); default: the
    /// file's first, else a sun that shows shadows
    #[arg(long, allow_hyphen_values = true, value_name = "LIGHT")]
    pub(crate) light: Option<String>,
    #[command(flatten)]
    pub(crate) arrangement: Arrangement,
    /// Pixels across and down
    #[arg(long, default_value = "1024x768", value_name = "WxH")]
    pub(crate) resolution: String,
    /// Texels along one side of the shadow map
    #[arg(long, default_value_t = 2048, value_name = "TEXELS")]
    pub(crate) size: u32,
    /// Kernel width of every technique that has one (unless its spec sets it), and of the
    /// light-space ideal
    #[arg(long, default_value_t = 5, value_name = "TEXELS")]
    pub(crate) kernel: u32,
    /// Shadow maps of a sun, 1 to 8, each for a range of distances from the camera; spots have one
    #[arg(long, default_value_t = 1, value_name = "COUNT")]
    pub(crate) cascades: u32,
    #[command(flatten)]
    pub(crate) file: FileArguments,
}
