//! Changes to a map that lives.

use super::ShadowMap;
use crate::{
    describe::{Description, Technique},
    error::{SettingError, Unsupported},
    technique::{self, Bias},
};

impl ShadowMap {
    /// Takes other settings of its technique where nothing but numbers in its uniforms follows from them, such as the
    /// reduction of light bleeding: what a slider changes. From the next [`prepare`](Self::prepare) on; nothing is
    /// allocated, no shader compiled.
    ///
    /// # Errors
    /// [`Unsupported::Setting`] for settings out of range, and [`Unsupported::Fixed`] where textures or shaders would be
    /// others, as with a kernel's width: that takes a new map. The settings before then stay.
    pub fn adjust(&mut self, technique: &dyn Technique) -> Result<(), Unsupported> {
        technique::check(technique)?;
        let mut description = technique.describe(&self.capabilities)?;
        self.textures.bring(&mut description);
        if !same_but_for_numbers(&description, self.description()) {
            return Err(Unsupported::Fixed {
                has: technique::spec(self.technique.as_ref()),
                asked: technique::spec(technique),
            });
        }
        self.uniforms.adjust(&description, &self.options);
        self.technique = technique.clone_box();
        self.composition.description = description;
        Ok(())
    }

    /// Takes another bias, from the next [`prepare`](Self::prepare) on.
    ///
    /// # Errors
    /// [`SettingError`] for terms that are not finite; the bias before then stays.
    pub fn set_bias(&mut self, bias: Bias) -> Result<(), SettingError> {
        bias.check()?;
        self.options.bias = bias;
        self.uniforms.adjust(&self.composition.description, &self.options);
        Ok(())
    }
}

/// Whether two descriptions differ at most in what uniforms hold, and in what is told of them.
fn same_but_for_numbers(new: &Description, old: &Description) -> bool {
    let names = |description: &Description| -> Vec<_> {
        description.uniforms.iter().map(|(name, _)| *name).collect()
    };
    let like_old = Description {
        uniforms: old.uniforms.clone(),
        bias: old.bias,
        depth_quantum: old.depth_quantum,
        ringing: old.ringing,
        ramp: old.ramp,
        notes: old.notes.clone(),
        ..new.clone()
    };
    names(new) == names(old) && like_old == *old
}
