//! The command line.

use crate::{
    file_arguments::FileArguments,
    scene_arguments::{SceneArguments, ViewArguments},
    suggestions,
};
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use std::path::PathBuf;

/// Which shadow map is best for your scene? Renders it with every technique, traces the truth, and
/// shows picture, error, time and memory.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100, after_help = "Start with: antumbra compare fence -o report")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Score techniques against ray-traced truth and write a report
    #[command(after_help = COMPARE_EXAMPLES)]
    Compare(Compare),
    /// Render one picture with one technique
    #[command(after_help = RENDER_EXAMPLES)]
    Render(Render),
    /// Move camera or light, and measure how much shadows change that should not
    #[command(after_help = FLICKER_EXAMPLES)]
    Flicker(Flicker),
    /// Time techniques and the ray tracer, without scoring
    Bench(Bench),
    /// Measure what biases cost and give: acne, detached shadows, error
    #[command(after_help = BIAS_EXAMPLES)]
    Bias(Bias),
    /// Error and cost over kernel widths
    Kernels(Kernels),
    /// Plot how techniques reconstruct the step of the shadow test
    #[command(after_help = CURVE_EXAMPLES)]
    Curve(Curve),
    /// Write every layer and channel of a technique's filtered maps as pictures
    #[command(after_help = MAPS_EXAMPLES)]
    Maps(Maps),
    /// Run the papers' experiments again: their numbers beside ours, and what becomes of their claims
    #[command(after_help = REPRODUCE_EXAMPLES)]
    Reproduce(Reproduce),
    /// List techniques with their parameters, ranges, defaults and papers
    Techniques(Techniques),
    /// List the built-in scenes, or write one as a file
    #[command(args_conflicts_with_subcommands = true)]
    Scenes(Scenes),
    /// Show the graphics adapter, its features, and the fallbacks taken
    Info(List),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

const COMPARE_EXAMPLES: &str = "Examples:
  antumbra compare fence -o report
  antumbra compare model.glb --size 1024 --kernel 7 --techniques hard pcf esm
  antumbra compare model.glb --techniques hard esm.c=40 esm.c=80 csm.terms=4
  antumbra compare model.glb --camera 3,2,5:0,1,0:50 --light 0.3,-1,-0.2
  antumbra compare model.glb --light spot:0,4,0:0,-1,0:35 --json > results.json
  antumbra compare valley.glb --cascades 4 --techniques hard pcf evsm";

const RENDER_EXAMPLES: &str = "Examples:
  antumbra render fence --technique esm.c=60 -o out.png
  antumbra render model.glb --technique pcf.kernel=7 --show visibility -o visibility.exr
  antumbra render fence -t esm.classifier=zmax --show classes -o failed.png
  antumbra render city -t pcf --cascades 4 --show cascades -o cascades.png
  antumbra render model.glb --technique truth -o truth.png";

const BIAS_EXAMPLES: &str = "Examples:
  antumbra bias contact spheres
  antumbra bias model.glb --techniques pcf.kernel=7 --settings auto none constant_texels=2

Settings: auto, none, or terms joined by commas, each in the unit of its name: constant_texels,
slope_texels, normal_offset_texels, grazing_offset_texels, receiver_plane (0 to 1, more is
steeper), depth_steps. Below each table: auto against the best of the other settings among those that
leave at most 1 % of the fully lit pixels in acne, and among all.";
const FLICKER_EXAMPLES: &str = "Examples:
  antumbra flicker fence -o flicker
  antumbra flicker spheres --path light --frames 60 --techniques hard spsm
  antumbra flicker fence --path recede --techniques hard pcf csm --resolution 640x480

Every frame is traced as well, and only what differs from the truth's own change counts.";

const CURVE_EXAMPLES: &str = "Examples:
  antumbra curve csm esm esm.c=20 evsm --range -0.05,0.15 -o step.svg
  antumbra curve esm csm.attenuation=0,offset=0.032 --json

Figure 3 of Annen et al. 2007 (number of terms; attenuation; offset; scale):
  antumbra curve csm.lift=none,attenuation=0,terms=1 csm.lift=none,attenuation=0,terms=4 \\
    csm.lift=none,attenuation=0 / csm.lift=none,attenuation=0 csm.lift=none \\
    / csm.lift=none csm.lift=offset / csm.lift=none csm.lift=scale -o figure3.svg

Values are what receivers get: without bias, and clamped to 0..1, so that ringing beyond shows as a flat.";

const MAPS_EXAMPLES: &str = "Examples:
  antumbra maps contact --technique csm -o basis
  antumbra maps fence --technique vsm.kernel=7 --level 2 -o moments";

const REPRODUCE_EXAMPLES: &str = "Examples:
  antumbra reproduce --list
  antumbra reproduce csm/figure-9
  antumbra reproduce esm spsm/table-1 -o papers
  antumbra reproduce all --quick

What was measured is kept in the folder: run the same command again after an interruption and it goes on.";

#[derive(Debug, Args)]
pub(crate) struct Compare {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Techniques with settings (esm.c=60,kernel=7), or all, all-comparison, all-basis, all-geometry
    #[arg(short, long, alias = "technique", num_args = 1.., default_value = "all", value_name = "TECHNIQUE",
        value_parser = suggestions::TECHNIQUES, hide_possible_values = true)]
    pub(crate) techniques: Vec<String>,
    /// Folder of the report; an earlier report there is replaced
    #[arg(short, long, default_value = "report", value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Frames that are timed, per technique
    #[arg(long, default_value_t = 7)]
    pub(crate) rounds: u32,
    /// Rays per pixel of the screen-space ideal, along one side
    #[arg(long, default_value_t = 4)]
    pub(crate) grid: u32,
    /// Print the results as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Render {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// A technique with settings, or `truth` for ray-traced hard shadows
    #[arg(short, long, alias = "techniques", default_value = "esm", value_name = "TECHNIQUE",
        value_parser = suggestions::TECHNIQUE_OR_TRUTH, hide_possible_values = true)]
    pub(crate) technique: String,
    /// What to write
    #[arg(long, value_enum, default_value_t = Show::Picture)]
    pub(crate) show: Show,
    /// A .png file, or .exr for raw visibility
    #[arg(short, long, default_value = "out.png", value_name = "FILE")]
    pub(crate) output: PathBuf,
}

/// What a rendering shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Show {
    /// The shaded picture
    Picture,
    /// Visibility, linear grey
    Visibility,
    /// Visibility with the kinds of pixels that the technique tells apart in colour
    Classes,
    /// The shaded picture in the colours of the cascades that shade it
    Cascades,
}

#[derive(Debug, Args)]
#[command(mut_arg("resolution", |arg| arg.default_value("480x360")), mut_arg("size", |arg| arg.default_value("1024")))]
pub(crate) struct Flicker {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Techniques with settings, or all, all-comparison, all-basis, all-geometry; ratios need hard
    #[arg(short, long, alias = "technique", num_args = 1..,
        default_values = ["hard", "pcf", "vsm", "esm", "csm", "spsm"], value_name = "TECHNIQUE",
        value_parser = suggestions::TECHNIQUES, hide_possible_values = true)]
    pub(crate) techniques: Vec<String>,
    /// What moves
    #[arg(long, value_enum, default_value_t = Motion::Both)]
    pub(crate) path: Motion,
    /// Frames of the path, 2 or more
    #[arg(long, default_value_t = 120)]
    pub(crate) frames: u32,
    /// Distance in pixels between those for which the light-space and screen-space ideals are computed,
    /// which take many rays
    #[arg(long, default_value_t = 8, value_name = "PIXELS")]
    pub(crate) stride: u32,
    /// Rays per pixel of the screen-space ideal, along one side
    #[arg(long, default_value_t = 4)]
    pub(crate) grid: u32,
    /// Folder of the page; an earlier one there is replaced
    #[arg(short, long, default_value = "flicker", value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Print the results as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}

/// What moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Motion {
    /// The camera turns 8° about its target and comes a tenth nearer
    Camera,
    /// The light turns 5°
    Light,
    /// Both
    Both,
    /// The camera moves away to eight times its distance
    Recede,
}

#[derive(Debug, Args)]
pub(crate) struct Bench {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Techniques with settings, or all, all-comparison, all-basis, all-geometry
    #[arg(short, long, alias = "technique", num_args = 1.., default_value = "all", value_name = "TECHNIQUE",
        value_parser = suggestions::TECHNIQUES, hide_possible_values = true)]
    pub(crate) techniques: Vec<String>,
    /// Frames that are timed, per technique
    #[arg(long, default_value_t = 15)]
    pub(crate) rounds: u32,
    /// Time too what each takes until its first frame is drawn, compiling its shaders
    #[arg(long)]
    pub(crate) start_up: bool,
    /// Print the times as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(mut_arg("resolution", |arg| arg.default_value("640x480")), mut_arg("size", |arg| arg.default_value("1024")))]
pub(crate) struct Bias {
    /// .glb, .gltf or .obj files, or names of built-in scenes
    #[arg(required = true, value_name = "SCENE", value_parser = suggestions::SCENES, hide_possible_values = true)]
    pub(crate) scenes: Vec<String>,
    /// Techniques with settings, or all, all-comparison, all-basis, all-geometry
    #[arg(short, long, alias = "technique", num_args = 1.., default_values = ["hard", "pcf"], value_name = "TECHNIQUE",
        value_parser = suggestions::TECHNIQUES, hide_possible_values = true)]
    pub(crate) techniques: Vec<String>,
    /// The biases that each of them is given
    #[arg(long, num_args = 1.., default_values = SETTINGS, value_name = "BIAS")]
    pub(crate) settings: Vec<String>,
    #[command(flatten)]
    pub(crate) view: ViewArguments,
    /// Print the rows as JSON instead of tables
    #[arg(long)]
    pub(crate) json: bool,
}

/// The usual ones.
const SETTINGS: [&str; 11] = [
    "auto",
    "none",
    "constant_texels=1",
    "constant_texels=2",
    "constant_texels=4",
    "slope_texels=1",
    "slope_texels=2",
    "normal_offset_texels=1",
    "normal_offset_texels=2",
    "receiver_plane=1",
    "constant_texels=1,slope_texels=2",
];

#[derive(Debug, Args)]
pub(crate) struct Kernels {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Widths of the kernel, texels; techniques that do not take one (many want odd ones) are left out there
    #[arg(long, num_args = 1.., default_values_t = [2, 3, 4, 5, 7, 9, 11, 13, 15, 16], value_name = "TEXELS")]
    pub(crate) kernels: Vec<u32>,
    /// Techniques with settings
    #[arg(short, long, alias = "technique", num_args = 1.., default_values = ["pcf", "pcf.taps=bilinear", "esm"], value_name = "TECHNIQUE",
        value_parser = suggestions::TECHNIQUES, hide_possible_values = true)]
    pub(crate) techniques: Vec<String>,
    /// Frames that are timed, per technique
    #[arg(long, default_value_t = 5)]
    pub(crate) rounds: u32,
    /// Rays per pixel of the screen-space ideal, along one side
    #[arg(long, default_value_t = 4)]
    pub(crate) grid: u32,
    /// Print the rows as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Curve {
    /// Techniques with settings, or all, all-comparison, all-basis; a / begins a new panel
    #[arg(required = true, value_name = "TECHNIQUE", value_parser = suggestions::TECHNIQUES,
        hide_possible_values = true)]
    pub(crate) techniques: Vec<String>,
    /// From and to how far the receiver lies behind the caster (d − z), as shares of the light's depth
    /// range
    #[arg(long, default_value = "-0.2,0.2", allow_hyphen_values = true, value_name = "FROM,TO")]
    pub(crate) range: String,
    /// Depth of the caster (z), as a share of the light's depth range
    #[arg(long, default_value_t = 0.5, allow_hyphen_values = true, value_name = "DEPTH")]
    pub(crate) caster: f32,
    /// Receivers along the range
    #[arg(long, default_value_t = 801)]
    pub(crate) points: u32,
    /// An .svg or .png file
    #[arg(short, long, default_value = "curve.svg", value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Print the values as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Maps {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// A technique with settings
    #[arg(short, long, alias = "techniques", default_value = "csm", value_name = "TECHNIQUE",
        value_parser = suggestions::TECHNIQUES, hide_possible_values = true)]
    pub(crate) technique: String,
    /// Mip level, 0 the finest
    #[arg(long, default_value_t = 0)]
    pub(crate) level: u32,
    /// Folder of the pictures; earlier ones there are replaced
    #[arg(short, long, default_value = "maps", value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Print what was written as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Reproduce {
    /// A figure or table (csm/figure-9), a source (csm), or all
    #[arg(required_unless_present = "list", value_name = "TARGET", value_parser = suggestions::TARGETS,
        hide_possible_values = true)]
    pub(crate) targets: Vec<String>,
    /// Show every target with the time it takes
    #[arg(long)]
    pub(crate) list: bool,
    /// Make everything small, to see that it works: pictures and maps of a quarter of the size each way,
    /// times of one frame
    #[arg(long)]
    pub(crate) quick: bool,
    /// Folder of the pages; pages of other targets there stay
    #[arg(short, long, default_value = "reproduction", value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Print the results as JSON instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Scenes {
    #[command(subcommand)]
    pub(crate) action: Option<SceneAction>,
    #[command(flatten)]
    pub(crate) list: List,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SceneAction {
    /// Write a scene as one binary glTF file, with its camera and light
    Export(Export),
}

#[derive(Debug, Args)]
pub(crate) struct Export {
    /// The name of a built-in scene, or a .glb, .gltf or .obj file
    #[arg(value_parser = suggestions::SCENES, hide_possible_values = true)]
    pub(crate) scene: String,
    /// The .glb file; an earlier one is replaced
    pub(crate) output: PathBuf,
    /// Seed of a built-in scene
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) file: FileArguments,
}

#[derive(Debug, Args)]
pub(crate) struct Techniques {
    /// Names of techniques; all if none is given
    #[arg(value_name = "TECHNIQUE", value_parser = suggestions::TECHNIQUES, hide_possible_values = true)]
    pub(crate) names: Vec<String>,
    #[command(flatten)]
    pub(crate) list: List,
}

#[derive(Debug, Args)]
pub(crate) struct List {
    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}
