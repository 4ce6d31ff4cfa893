//! Bias: what keeps a surface from shadowing itself.

use crate::error::SettingError;
use std::{fmt, str::FromStr};

/// How far receivers are pulled towards the light before they are compared.
///
/// As text (`parse`, `to_string`): `auto`, `none`, or terms such as `constant_texels=1,receiver_plane=1`;
/// those not named are 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Bias {
    /// What the technique needs ([`Description::bias`](crate::technique::Description::bias)), no more.
    #[default]
    Auto,
    /// These terms, whatever the technique.
    Fixed(BiasTerms),
}

impl Bias {
    /// No bias at all.
    pub const NONE: Self = Self::Fixed(BiasTerms::NONE);

    /// The terms, where `auto` is what the technique needs.
    #[must_use]
    pub fn terms(self, auto: BiasTerms) -> BiasTerms {
        match self {
            Self::Auto => auto,
            Self::Fixed(terms) => terms,
        }
    }

    /// A bias that is not a number would shadow everything without a word.
    pub(crate) fn check(self) -> Result<(), SettingError> {
        let Self::Fixed(mut terms) = self else { return Ok(()) };
        match terms.named().into_iter().find(|(_, value)| !value.is_finite()) {
            None => Ok(()),
            Some((name, value)) => Err(SettingError::OutOfRange {
                parameter: format!("bias.{name}"),
                value: value.to_string(),
                allowed: "finite".into(),
            }),
        }
    }
}

impl From<BiasTerms> for Bias {
    fn from(terms: BiasTerms) -> Self {
        Self::Fixed(terms)
    }
}

impl fmt::Display for Bias {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Fixed(mut terms) = *self else { return f.write_str("auto") };
        let set = terms.named().into_iter().filter(|(_, value)| **value != 0.0);
        let set: Vec<String> = set.map(|(name, value)| format!("{name}={value}")).collect();
        f.write_str(if set.is_empty() { "none" } else { "" })?;
        f.write_str(&set.join(","))
    }
}

impl FromStr for Bias {
    type Err = SettingError;

    fn from_str(text: &str) -> Result<Self, SettingError> {
        let mut terms = BiasTerms::NONE;
        match text {
            "auto" => return Ok(Self::Auto),
            "none" => return Ok(Self::NONE),
            _ => {}
        }
        for setting in text.split(',') {
            let syntax = |reason: String| SettingError::BiasSyntax { text: text.into(), reason };
            let (name, value) =
                setting.split_once('=').ok_or_else(|| syntax(format!("'{setting}' has no '='")))?;
            let mut named = terms.named();
            let known = named.each_ref().map(|(name, _)| *name).join(", ");
            let term = named.iter_mut().find(|(n, _)| *n == name.trim());
            let (_, term) = term.ok_or_else(|| syntax(format!("there is no '{name}', only {known}")))?;
            **term = value
                .trim()
                .parse()
                .map_err(|_| syntax(format!("'{value}' is no number, as {name} must be")))?;
        }
        Self::Fixed(terms).check()?;
        Ok(Self::Fixed(terms))
    }
}

/// A [`Bias`] in numbers; terms add up.
///
/// The steeper a receiver, the deeper the texels of a kernel reach into it: following its plane
/// ([`receiver_plane`](Self::receiver_plane)) removes that exactly, wherever the surface is flat, and
/// leaves rounding and curvature to the other terms.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BiasTerms {
    /// Along the light, in texels (world size of one texel at the receiver).
    pub constant_texels: f32,
    /// Times the depth that the receiver's plane gains over one texel in x plus one in y. Without
    /// `receiver_plane` one half covers the distance from a point to the centre of its texel.
    pub slope_texels: f32,
    /// Along the receiver's normal, in texels.
    pub normal_offset_texels: f32,
    /// Along the receiver's normal, in texels, times (1 − cos θ)², θ being the angle between normal and
    /// light: an offset for receivers that the light grazes, which does not push the shadows on others
    /// aside.
    pub grazing_offset_texels: f32,
    /// How much of the receiver's plane comparisons follow uphill: 0, every texel is compared with the
    /// receiver's own depth; 1, with the depth of the plane there; beyond 1, with that of a plane so many
    /// times as steep, but at most 1.5 texels of depth per texel steeper: a bias that grows with the distance
    /// in the kernel. The comparison family alone reads it.
    pub receiver_plane: f32,
    /// Towards the light, in steps of the stored depth
    /// ([`Description::depth_quantum`](crate::technique::Description::depth_quantum)) and, as floats have no
    /// steps, in what these lose on the way (8 units in the last place of a projected depth from ½ to 1);
    /// one half covers rounding.
    pub depth_steps: f32,
}

impl BiasTerms {
    /// No bias at all.
    pub const NONE: Self = Self {
        constant_texels: 0.0,
        slope_texels: 0.0,
        normal_offset_texels: 0.0,
        grazing_offset_texels: 0.0,
        receiver_plane: 0.0,
        depth_steps: 0.0,
    };

    /// For texels that are compared one by one, each with the plane at its own centre.
    ///
    /// The rasteriser snaps vertices to 1/256 texel, which tilts small facets: on steep ones depths err by
    /// a share of their slope. And a facet is not the whole surface: in a fold the neighbours stand above
    /// its plane, by more the farther away they are, so a steeper plane is followed; and a rough surface
    /// stands off its own facets, which an offset along the normal clears however steep they are, and
    /// which moves the receiver no farther than it is long. All of it costs shadows of whatever else
    /// hangs as near, so what grows with the slope is bounded: `docs/bias.md` says how the constants were
    /// chosen, and compares them, view by view, with the best fixed bias.
    pub(crate) const TEXELS: Self = Self {
        constant_texels: 0.1,
        slope_texels: 0.3,
        normal_offset_texels: 0.0,
        grazing_offset_texels: 0.4,
        receiver_plane: 1.75,
        depth_steps: 0.5,
    };

    /// Bias for 2×2 texels that are compared at once, with the receiver's plane at the texel where it is nearest to
    /// the light. For the other three texels that plane is too near by half a texel's slope or more, which is most of
    /// the bias that they need.
    pub(crate) const FOURS: Self = Self { slope_texels: 0.05, grazing_offset_texels: 0.18, ..Self::TEXELS };

    /// For receivers whose ray meets triangles themselves, unrounded but for floats.
    pub(crate) const RAYS: Self =
        Self { constant_texels: 0.005, slope_texels: 0.005, depth_steps: 8.0, ..Self::NONE };

    /// The terms by name.
    fn named(&mut self) -> [(&'static str, &mut f32); 6] {
        [
            ("constant_texels", &mut self.constant_texels),
            ("slope_texels", &mut self.slope_texels),
            ("normal_offset_texels", &mut self.normal_offset_texels),
            ("grazing_offset_texels", &mut self.grazing_offset_texels),
            ("receiver_plane", &mut self.receiver_plane),
            ("depth_steps", &mut self.depth_steps),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn biases_are_read_back_as_written() {
        let terms = BiasTerms { slope_texels: 0.25, receiver_plane: 1.0, ..BiasTerms::NONE };
        for bias in [Bias::Auto, Bias::NONE, terms.into(), BiasTerms::TEXELS.into()] {
            assert_eq!(bias.to_string().parse::<Bias>().unwrap(), bias);
        }
        assert_eq!(Bias::Fixed(terms).to_string(), "slope_texels=0.25,receiver_plane=1");
    }

    #[test]
    fn unreadable_ones_are_refused_by_name() {
        for (text, says) in [
            ("", "no '='"),
            ("some", "no '='"),
            ("slope=1", "only constant_texels"),
            ("slope_texels=x", "'x' is no number"),
            ("slope_texels=inf", "finite"),
            ("auto,slope_texels=1", "no '='"),
        ] {
            let error = text.parse::<Bias>().unwrap_err().to_string();
            assert!(error.contains(says), "{error}");
        }
    }

    #[test]
    fn fixed_terms_ignore_what_is_needed() {
        assert_eq!(Bias::Auto.terms(BiasTerms::TEXELS), BiasTerms::TEXELS);
        assert_eq!(Bias::NONE.terms(BiasTerms::TEXELS), BiasTerms::NONE);
    }
}
