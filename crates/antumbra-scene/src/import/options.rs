//! What of a file is loaded, and how.

use super::error::{Problem, invalid};

/// What of a file is loaded, and how. The default is what the file itself says, in the pose at rest.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Options {
    /// Which scene of a glTF file, by number or else by name; without it the file's default, or else
    /// its first.
    pub scene: Option<String>,
    /// Seconds into an animation, clamped to its keys; without it nodes, skins and morph targets
    /// rest as the file leaves them.
    pub time: Option<f64>,
    /// Which animation of a glTF file, by number or else by name; without it the first. Without
    /// [`Options::time`] its beginning.
    pub animation: Option<String>,
    /// What becomes of surfaces that let light through.
    pub blend: Blend,
}

/// What becomes of surfaces that let light through: in glTF those whose `alphaMode` is `BLEND`, and
/// those that transmit (`KHR_materials_transmission`), in OBJ those that dissolve (`d`, `Tr`). A shadow map
/// holds one depth a texel, so a point of a surface is there or is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Blend {
    /// A point is there where its alpha is ½ or more, and is no glass that lets half of the light or
    /// more through: leaves keep their outlines, panes cast no shadow.
    #[default]
    Mask,
    /// All of it is there, opaque.
    Cast,
    /// None of it is there.
    Ignore,
}

impl Options {
    /// Refuses choices that a format has no use for.
    pub(super) fn refuse_gltf_choices(&self, format: &str) -> Result<(), Problem> {
        let time = self.time.map(|t| t.to_string());
        let allowed = format!("{format} files have neither scenes nor animations; leave it out");
        for (name, value) in [("scene", &self.scene), ("time", &time), ("animation", &self.animation)] {
            if let Some(value) = value {
                return Err(invalid(format!("option {name}"), format!("'{value}'"), allowed));
            }
        }
        Ok(())
    }
}

/// The place of the entry that `wanted` means in a list of names: a number, or else a name.
pub(super) fn choose(
    list: &str,
    option: &str,
    wanted: &str,
    names: &[Option<&str>],
) -> Result<usize, Problem> {
    let element = format!("option {option}");
    let shown = format!("'{wanted}'");
    let all: Vec<String> = names
        .iter()
        .enumerate()
        .map(|(i, name)| name.map_or_else(|| i.to_string(), |name| format!("{i} '{name}'")))
        .collect();
    let allowed = match names.len() {
        0 => format!("the file has no {list}; leave it out"),
        _ => format!("allowed is the number or name of one of the file's {list}: {}", all.join(", ")),
    };
    if let Ok(number) = wanted.parse::<usize>()
        && number < names.len()
    {
        return Ok(number);
    }
    let mut found = (0..names.len()).filter(|&i| names[i] == Some(wanted));
    match (found.next(), found.next()) {
        (Some(place), None) => Ok(place),
        (Some(_), Some(_)) => {
            Err(invalid(element, shown, format!("several of the file's {list} have that name; {allowed}")))
        }
        _ => Err(invalid(element, shown, allowed)),
    }
}
