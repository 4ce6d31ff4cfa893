//! What of a file is loaded, and how: the same options in every command that takes a scene.

use antumbra_scene::import::{Blend, Options};
use anyhow::{Result, bail};
use clap::{Args, ValueEnum};

/// What of a file is loaded, and how.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Files")]
pub(crate) struct FileArguments {
    /// Scene of a glTF file, by number or name; default: the file's default scene, else its first
    #[arg(id = "file_scene", long = "scene", value_name = "N|NAME")]
    pub(crate) scene: Option<String>,
    /// Pose that an animation of a glTF file has after so many seconds; default: the pose at rest
    #[arg(long, allow_hyphen_values = true, value_name = "SECONDS")]
    pub(crate) time: Option<f64>,
    /// Animation of a glTF file, by number or name; default: the first
    #[arg(long, value_name = "N|NAME")]
    pub(crate) animation: Option<String>,
    /// What becomes of surfaces that blend, dissolve or transmit light
    #[arg(long, value_enum, default_value_t = BlendMode::Mask)]
    pub(crate) blend: BlendMode,
}

/// What becomes of surfaces that let light through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum BlendMode {
    /// They cast where their alpha is ½ or more, and not where they transmit half of the light
    #[default]
    Mask,
    /// They cast everywhere
    Cast,
    /// They are left out
    Ignore,
}

impl FileArguments {
    pub(crate) fn options(&self) -> Options {
        let mut options = Options::default();
        options.scene.clone_from(&self.scene);
        options.time = self.time;
        options.animation.clone_from(&self.animation);
        options.blend = match self.blend {
            BlendMode::Mask => Blend::Mask,
            BlendMode::Cast => Blend::Cast,
            BlendMode::Ignore => Blend::Ignore,
        };
        options
    }

    /// Refuses choices that a built-in scene has no use for.
    pub(crate) fn check_built_in(&self, name: &str) -> Result<()> {
        let time = self.time.map(|time| time.to_string());
        for (option, value) in [("scene", &self.scene), ("time", &time), ("animation", &self.animation)] {
            if let Some(value) = value {
                bail!(
                    "--{option} {value}: {name} is built in and has neither scenes nor animations; leave it out"
                );
            }
        }
        Ok(())
    }
}
