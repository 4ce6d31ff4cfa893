//! Puts a technique's WGSL together: its file, the shared files that it needs, its constants.

use super::{
    ShaderText, files,
    settings::{self, Reader},
    unroll,
};
use crate::{
    capabilities::Capabilities,
    describe::{Constant, Description, Technique},
    error::{DescriptionError, Unsupported},
    options::Options,
};

/// A description whose WGSL is put together: what all passes and receivers are written from.
#[derive(Debug)]
pub(crate) struct Composition {
    pub(crate) description: Description,
    /// Whether lookups ask about cut-outs.
    pub(crate) asks: bool,
    /// Whether views may be warped.
    pub(crate) warped: bool,
    /// Whether views may be parts of layers.
    pub(crate) tiled: bool,
    /// Most views and lights.
    pub(super) most: [u32; 2],
    /// The technique's file and all that it needs, needs first.
    library: ShaderText,
    /// All that lookups take but for what is bound.
    pub(super) looked_up: ShaderText,
}

impl Composition {
    /// Describes a technique and puts its WGSL together.
    ///
    /// # Errors
    /// What [`Technique::describe`] says, or [`Unsupported::Description`].
    pub(crate) fn of(
        technique: &dyn Technique,
        device: &Capabilities,
        options: &Options,
    ) -> Result<Self, Unsupported> {
        Self::new(technique.describe(device)?, options)
    }

    /// Puts the WGSL of a description together.
    ///
    /// # Errors
    /// [`Unsupported::Description`], [`Unsupported::Tiles`].
    pub(crate) fn new(description: Description, options: &Options) -> Result<Self, Unsupported> {
        let wrong = |error| Unsupported::Description { technique: description.about.name.into(), error };
        description.check().map_err(wrong)?;
        let tiled = options.layers.is_some();
        let slots = filled(&description, tiled);
        let library = ShaderText::library(&description, &slots).map_err(wrong)?;
        // What never asks where views lie takes each for a layer.
        if tiled && !library.filled.contains(&"tile_placed") {
            return Err(Unsupported::Tiles { technique: description.about.name.into() });
        }
        let mut looked_up = library.clone();
        looked_up.need("tile", &slots).map_err(wrong)?;
        looked_up.add(&["receiver"]);
        let asks = options.cutouts && description.storage.keeps_ids();
        if asks {
            looked_up.add(&["record"]);
        }
        let (warped, most) = (options.warped, [options.views, options.lights]);
        Ok(Self { description, asks, warped, tiled, most, library, looked_up })
    }

    /// Whether all that is compared with stored depth can be turned around.
    ///
    /// # Errors
    /// [`Unsupported::Depth`].
    pub(crate) fn takes_reversed_depth(&self) -> Result<(), Unsupported> {
        if self.library.filled.contains(&"stored_reversed") || !self.description.reads_depth() {
            return Ok(());
        }
        let name = self.description.about.name;
        Err(Unsupported::Depth {
            what: "direction",
            found: "reversed".into(),
            needed: format!("depth that grows, since the WGSL of {name} compares it without stored_depth"),
        })
    }

    /// The technique's functions for the passes between casting and lighting, which read settings from
    /// `convert`.
    pub(crate) fn for_convert(&self) -> String {
        self.library.text() + &settings::accessors(self, Reader::Convert)
    }

    /// The technique's functions for passes that bind nothing of the library's.
    pub(crate) fn alone(&self) -> ShaderText {
        let mut shader = self.library.clone();
        shader.push("settings", &settings::accessors(self, Reader::Alone));
        shader
    }
}

/// The files that fill slots: what a technique says, and what follows from where views lie.
fn filled(description: &Description, tiled: bool) -> Vec<&'static str> {
    let placed = |file: &&'static str| match *file {
        // The sampler knows the texture's edges alone.
        "level_hardware" if tiled => "level_placed",
        file => file,
    };
    let tile = if tiled { "tile_placed" } else { "tile_whole" };
    description.slots.iter().map(placed).chain([tile]).collect()
}

impl ShaderText {
    /// The technique's own file and all that it needs, constants replaced.
    fn library(description: &Description, slots: &[&'static str]) -> Result<Self, DescriptionError> {
        let Description { about, wgsl, constants, .. } = description;
        let mut shader = Self::of("raster", slots)?;
        shader.need_all(wgsl, slots)?;
        shader.push(about.name, wgsl);
        constants.iter().try_for_each(|constant| shader.replace(constant))?;
        shader.unroll()?;
        Ok(shader)
    }

    /// A shared file with all that it needs.
    pub(super) fn of(stem: &str, slots: &[&'static str]) -> Result<Self, DescriptionError> {
        let mut shader = Self::default();
        shader.need(stem, slots)?;
        Ok(shader)
    }

    /// Adds shared files that exist and leave no slot open.
    pub(crate) fn add(&mut self, stems: &[&str]) {
        for stem in stems {
            let added = self.need(stem, &[]);
            debug_assert!(added.is_ok(), "{added:?}");
        }
    }

    pub(super) fn push(&mut self, name: &str, text: &str) {
        let end = if text.is_empty() || text.ends_with('\n') { "" } else { "\n" };
        self.pieces.push((format!("{name}.wgsl"), format!("{text}{end}")));
    }

    fn need_all(&mut self, text: &str, slots: &[&'static str]) -> Result<(), DescriptionError> {
        let needs = text.lines().next().and_then(|line| line.strip_prefix("//! needs ")).unwrap_or_default();
        needs.split_whitespace().try_for_each(|stem| self.need(stem, slots))
    }

    fn need(&mut self, stem: &str, slots: &[&'static str]) -> Result<(), DescriptionError> {
        let slot = format!("{stem}_");
        let filled = slots.iter().find(|file| file.starts_with(&slot)).copied();
        self.filled.extend(filled);
        let stem = filled.unwrap_or(stem);
        let name = format!("{stem}.wgsl");
        if self.pieces.iter().any(|(n, _)| *n == name) {
            return Ok(());
        }
        let text = files::text(stem).ok_or_else(|| files::missing(stem))?;
        self.need_all(text, slots)?;
        self.push(stem, text);
        Ok(())
    }

    /// Writes the loops out that say so.
    fn unroll(&mut self) -> Result<(), DescriptionError> {
        let all = self.text();
        let count = |name: &str| {
            let value = all.lines().find_map(|l| l.strip_prefix(&format!("const {name}: u32 = ")))?;
            value.trim_end_matches([';', 'u']).parse().ok()
        };
        for (_, text) in &mut self.pieces {
            *text = unroll::unroll(text, count)?;
        }
        Ok(())
    }

    /// Replaces the one-line declaration of a constant.
    fn replace(&mut self, constant: &Constant) -> Result<(), DescriptionError> {
        let (name, declaration) = (constant.name(), constant.declaration());
        let starts = [format!("const {name} "), format!("const {name}:")];
        let mut found = 0;
        for (_, text) in &mut self.pieces {
            *text = text
                .split_inclusive('\n')
                .map(|line| match starts.iter().any(|s| line.starts_with(s)) {
                    true => {
                        found += 1;
                        format!("{declaration}\n")
                    }
                    false => line.to_string(),
                })
                .collect();
        }
        if found == 1 { Ok(()) } else { Err(DescriptionError::Constant { name: name.into(), found }) }
    }
}
