//! The lab's own WGSL: what asks a map about points, and a caster that has one depth.

/// A caster parallel to the map.
pub(crate) const FLAT_CASTER: &str = include_str!("curve/caster.wgsl");
/// Visibility of points, before a map's `shadow_visibility`.
pub(crate) const CURVE: &str = include_str!("curve/ask.wgsl");

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra::{Capabilities, Options, ShaderText, Size, technique};
    use antumbra_testing::shaders::{Needs, Shaders};

    /// Both files, the question with every technique's receiver.
    #[test]
    fn every_shader_is_portable() {
        let mut shaders = Shaders::default();
        shaders.add("flat caster", FLAT_CASTER.into(), &[], Needs::LEAST);
        let device = Capabilities::least();
        let options = Options::from(Size::square(64));
        for technique in technique::all() {
            let name = technique.about().name;
            let receiver = ShaderText::receiver(technique.as_ref(), &device, &options, 0).unwrap().text();
            shaders.add(&format!("{name}: curve"), format!("{CURVE}\n{receiver}"), &[], Needs::LEAST);
        }
        shaders.check("lab").unwrap();
    }
}
