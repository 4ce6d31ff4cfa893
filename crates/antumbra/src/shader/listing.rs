//! All shaders of a technique, without a device: for those who check or compile them beforehand.

use super::{Composition, Cutout, MapSize, ShaderText, TrianglePass, scan, triangles};
use crate::{
    capabilities::Capabilities,
    describe::{Caster, Coverage, Technique},
    error::Unsupported,
    map::{self, DEPTH_FORMAT, Options},
    pass::{self, Slot, Work},
};
use wgpu::TextureFormat;

/// A shader that a [`ShadowMap`](crate::ShadowMap) compiles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shader {
    /// What it is for: `cast`, `cut-out`, `scan`, `convert`, `blur`, `mips` or `sum`.
    pub pass: &'static str,
    /// A whole WGSL module with entry points `vertex` and `fragment`, or `compute`.
    pub text: String,
    /// Formats of the colours that it draws to.
    pub targets: Vec<TextureFormat>,
}

impl Shader {
    /// Every shader that a map of a technique with these options may compile on such a device, each text
    /// once; the receiver's is [`ShaderText::receiver`]. With `cutout`, the caller's WGSL for
    /// [`ShadowMap::cutout_caster`](crate::ShadowMap::cutout_caster), that pipeline's too.
    ///
    /// # Errors
    /// As [`Technique::describe`], or [`Unsupported::Description`].
    pub fn all(
        technique: &dyn Technique,
        device: &Capabilities,
        options: &Options,
        cutout: Option<&str>,
    ) -> Result<Vec<Self>, Unsupported> {
        let composition = Composition::of(technique, device, options)?;
        let mut shaders = casters(&composition, device, options, cutout);
        for step in pass::plan(&composition, device, options.size) {
            let format = |slot| match slot {
                Slot::Map(i) | Slot::Scratch(i) => composition.description.maps[i].format,
                Slot::Casters | Slot::Casts { .. } => DEPTH_FORMAT,
            };
            let targets = match step.work {
                Work::Draw => step.targets.iter().map(|target| format(target.slot)).collect(),
                Work::Lanes(_) => Vec::new(),
            };
            let shader = Self { pass: step.label, text: step.shader, targets };
            if !shaders.contains(&shader) {
                shaders.push(shader);
            }
        }
        Ok(shaders)
    }
}

/// Those that draw triangles.
fn casters(
    composition: &Composition,
    device: &Capabilities,
    options: &Options,
    cutout: Option<&str>,
) -> Vec<Shader> {
    use TrianglePass::{Any, Indexed, Pulled};
    let caster = composition.description.caster;
    let pulled = |coverage| [Pulled(coverage, false), Pulled(coverage, true)];
    let passes = match caster {
        Caster::Depth => return Vec::new(),
        Caster::Lists | Caster::Ranked { .. } => pulled(Coverage::Touched).to_vec(),
        Caster::Triangles(coverages) => {
            let can = |coverage: &&Coverage| match coverage {
                Coverage::Touched => device.rasterises_conservatively(),
                Coverage::Centre => device.numbers_triangles(),
            };
            let indexed = coverages.iter().filter(can).map(|coverage| Indexed(*coverage));
            coverages.iter().copied().flat_map(pulled).chain(indexed).collect()
        }
    };
    let targets: Vec<TextureFormat> = match caster {
        Caster::Triangles(_) => composition.description.maps.iter().map(|map| map.format).collect(),
        _ => Vec::new(),
    };
    let shader = |pass, text| Shader { pass, text, targets: targets.clone() };
    let splits = map::splits(caster, &device.limits, options);
    let cast = |pass| shader("cast", triangles(composition, device, None, pass, &splits));
    let mut shaders: Vec<Shader> = passes.into_iter().map(cast).collect();
    let by_ray = composition.asks;
    let holed = |wgsl| triangles(composition, device, Some(Cutout { wgsl, by_ray }), Any, &splits);
    shaders.extend(cutout.map(|wgsl| shader("cut-out", holed(wgsl))));
    if caster == Caster::Lists {
        shaders.push(Shader { pass: "scan", text: scan(&splits), targets: Vec::new() });
    }
    shaders
}

impl ShaderText {
    /// What [`ShadowMap::wgsl`](crate::ShadowMap::wgsl) gives for a map with these options on such a
    /// device, bound in `group`.
    ///
    /// # Errors
    /// As [`Technique::describe`], or [`Unsupported::Description`].
    pub fn receiver(
        technique: &dyn Technique,
        device: &Capabilities,
        options: &Options,
        group: u32,
    ) -> Result<Self, Unsupported> {
        let composition = Composition::of(technique, device, options)?;
        let splits = map::splits(composition.description.caster, &device.limits, options);
        let size = MapSize { views: options.views, capacity: options.capacity, splits };
        Ok(composition.receiver(size, group))
    }
}
