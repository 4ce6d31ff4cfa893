//! The list of all techniques, and how they are read from text.
//!
//! What a technique is says [`Technique`]; its vocabulary is public here too. To add one to the list, write
//! `technique/x.rs` and `technique/x.wgsl` and add a line at the end of this file.

use crate::{error::SettingError, parameter::Parameter};

pub use crate::{
    bias::{Bias, BiasTerms},
    describe::{
        About, Access, Binding, CasterStorage, Class, Combine, Constant, Coverage, DepthSpace, Description,
        Encode, Family, Map, Pass, Technique, Uniform,
    },
    kernel::{Adaptive, Width},
};

/// Checks every setting of a technique.
///
/// # Errors
/// The first [`SettingError::OutOfRange`].
pub fn check(technique: &dyn Technique) -> Result<(), SettingError> {
    let name = technique.about().name;
    technique.clone_box().parameters().iter().try_for_each(|p| p.check(name))
}

/// Sets one parameter by name.
///
/// # Errors
/// [`SettingError::UnknownParameter`], [`SettingError::OutOfRange`].
pub fn set(technique: &mut dyn Technique, name: &str, value: &str) -> Result<(), SettingError> {
    let about = technique.about();
    let mut parameters = technique.parameters();
    match parameters.iter_mut().find(|p| p.name == name) {
        Some(parameter) => parameter.set(about.name, value),
        None => Err(SettingError::UnknownParameter {
            technique: about.name.into(),
            name: name.into(),
            known: parameters.iter().map(|p| p.name.into()).collect(),
        }),
    }
}

/// Reads `name` or `name.parameter=value,parameter=value`, starting from the defaults.
///
/// # Errors
/// [`SettingError`]: unknown name or parameter, value out of range, syntax.
pub fn parse(spec: &str) -> Result<Box<dyn Technique>, SettingError> {
    let (name, settings) = spec.split_once('.').unwrap_or((spec, ""));
    let Some(mut technique) = all().into_iter().find(|t| t.about().name == name) else {
        let known = all().iter().map(|t| t.about().name.to_string()).collect();
        return Err(SettingError::UnknownTechnique { name: name.into(), known });
    };
    for setting in settings.split(',').filter(|s| !s.is_empty()) {
        let (key, value) = setting.split_once('=').ok_or_else(|| SettingError::Syntax {
            spec: spec.into(),
            reason: format!("'{setting}' has no '='"),
        })?;
        set(technique.as_mut(), key.trim(), value.trim())?;
    }
    Ok(technique)
}

/// The text that [`parse`] would read to get this technique: its name and what differs from the
/// defaults.
#[must_use]
pub fn spec(technique: &dyn Technique) -> String {
    let name = technique.about().name;
    let mut plain = parse(name).unwrap_or_else(|_| technique.clone_box());
    let plain: Vec<String> = plain.parameters().iter().map(Parameter::value).collect();
    let mut this = technique.clone_box();
    let changed: Vec<String> = std::iter::zip(this.parameters(), plain)
        .filter(|(p, default)| p.value() != *default)
        .map(|(p, _)| format!("{}={}", p.name, p.value()))
        .collect();
    if changed.is_empty() { name.to_string() } else { format!("{name}.{}", changed.join(",")) }
}

/// Declares the modules and [`all`]: one line per technique.
macro_rules! techniques {
    ($($module:ident :: $name:ident),+ $(,)?) => {
        $(pub mod $module;)+

        /// The types of all techniques.
        pub(crate) mod types {
            $(pub use super::$module::$name;)+
        }
        pub use types::*;

        /// Every technique with its default settings, in the order in which tables list them.
        #[must_use]
        pub fn all() -> Vec<Box<dyn Technique>> {
            vec![$(Box::new($name::default())),+]
        }
    };
}

techniques! {
    hard::Hard,
    pcf::Pcf,
    poisson::Poisson,
    bicubic::Bicubic,
    footprint::Footprint,
    packed::Packed,
    stratified::Stratified,
    vsm::Vsm,
    csm::Csm,
    esm::Esm,
    evsm::Evsm,
    msm::Msm,
    lvsm::Lvsm,
    rgsm::Rgsm,
    spsm::Spsm,
    dpm::Dpm,
    exact::Exact,
}

#[cfg(test)]
mod tests;
