//! Plans what stores that keep triangles by id describe: texts, sizes, checks. `ids/on_device.rs` makes it.

use super::{
    Array, Cast, Element, Image, Owner, Plan, Site, Step, Store,
    arrays::{Storage, called},
    refused,
    split::Split,
    triangle::{self, Holes, PULLED, TrianglePass, VIEW},
};
use crate::{
    capacity,
    describe::Coverage,
    error::Unsupported,
    pipelines::Pipelines,
    shader::{Shader, ShaderText, check_files},
};
use std::ops::Deref;

mod on_device;

/// Where a store's arrays and images begin in group 0: behind view and step.
const FIRST: u32 = 2;
/// What shaders of a store know of a step.
const STEP: &str = "
struct CasterStep { view: u32, triangles: u32, words: vec2u }
@group(0) @binding(1) var<uniform> caster_step: CasterStep;
";
/// The vertices of all triangles, which the records of cut-outs follow.
const VERTICES: &str = "caster_vertices";

/// A store in a map, and everything that it keeps there.
pub(super) struct IdPlan<'a, P> {
    store: P,
    site: Site<'a>,
    storage: Storage,
}

impl<'a, P: Deref<Target = dyn Store>> IdPlan<'a, P> {
    pub(super) fn new(store: P, site: Site<'a>) -> Self {
        let triangles = u64::from(site.capacity.triangles);
        let mut arrays = store.arrays(&site);
        arrays.push(Array {
            name: VERTICES,
            title: "vertices",
            element: Element::Corners,
            length: triangles * (1 + u64::from(site.asks)),
            owner: Owner::View,
            cleared: false,
            looked_up: true,
        });
        if !site.device.stores_from_vertices() {
            arrays.push(Array {
                name: "caster_seen",
                title: "seen bits",
                element: Element::Word,
                length: triangles.div_ceil(32),
                owner: Owner::Shared,
                cleared: true,
                looked_up: false,
            });
        }
        let storage = Storage::new(arrays, store.images(&site), &site);
        Self { store, site, storage }
    }

    /// The entry of the vertices' array where records begin.
    fn records(&self) -> u64 {
        u64::from(self.site.capacity.triangles) * u64::from(self.site.views)
    }

    fn holes<'w>(&self, wgsl: &'w str) -> Holes<'w> {
        if self.site.asks { Holes::ByRay(wgsl, self.records()) } else { Holes::ByTexel(wgsl) }
    }

    /// The texts of a draw that call functions of arrays.
    fn texts(&self) -> [&'static str; 3] {
        let keeping = if self.site.device.stores_from_vertices() {
            include_str!("vertices/by_vertices.wgsl.in")
        } else {
            include_str!("vertices/by_fragments.wgsl.in")
        };
        [self.store.wgsl(), include_str!("vertices/keep.wgsl.in"), keeping]
    }

    fn draw_text(&self, pass: TrianglePass, holes: Holes<'_>) -> String {
        let mut needed = ShaderText::default();
        needed.add(self.store.needs());
        let varyings = [&[("id", "u32")], self.store.varyings()].concat();
        let texts = self.texts();
        let arrays = self.storage.written(&texts.concat(), FIRST);
        let texts = [&[STEP, &arrays], &texts[..], &[PULLED]].concat();
        triangle::compose(pass, holes, needed, &varyings, &texts)
    }

    fn compute_text(&self, wgsl: &str) -> String {
        format!("{VIEW}{STEP}{}{wgsl}", self.storage.written(wgsl, FIRST))
    }

    /// What a step's shader calls functions of.
    fn called_by(&self, step: &Step) -> String {
        match step {
            Step::Draw { .. } => self.texts().concat(),
            Step::Compute { wgsl, .. } => (*wgsl).into(),
        }
    }

    /// Whether buffers are no more than stages may have.
    fn check_buffers(&self) -> Result<(), Unsupported> {
        let limits = &self.site.device.limits;
        let found = limits.max_storage_buffers_per_shader_stage;
        let counts = |text: &str, others: u32| {
            let bound = self.storage.arrays.iter().filter(|(array, _)| called(array.name, text));
            bound.fold(others, |sum, (_, split)| sum.saturating_add(split.count()))
        };
        let of_step = |step: &Step| {
            // A mesh has two.
            counts(&self.called_by(step), if matches!(step, Step::Draw { .. }) { 2 } else { 0 })
        };
        let needed = self.store.steps(&self.site).iter().map(of_step).max().unwrap_or(0);
        let splits = || self.storage.arrays.iter().map(|(_, split)| split);
        // Shaders count elements with 32 bits.
        let few =
            |split: &Split| split.count() <= Split::MAX_BUFFERS && split.elements <= u64::from(u32::MAX);
        if needed <= found && splits().all(few) {
            return Ok(());
        }
        let what = format!("{needed} storage buffers in a stage ({found} are possible)");
        let instead = if splits().all(|split| split.count() == 1) {
            "take another technique".into()
        } else {
            let max = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
            format!(
                "a buffer holds {max} bytes here: take fewer texels or views, or fewer triangles (Options::capacity)"
            )
        };
        refused(self.site.technique, what, instead)
    }

    fn check_images(&self) -> Result<(), Unsupported> {
        let (limits, views) = (&self.site.device.limits, self.site.views);
        for Image { size, layers, .. } in &self.storage.images {
            let (layers, max) = (layers.saturating_mul(self.site.layers), limits.max_texture_array_layers);
            if !(1..=max).contains(&layers) {
                return Err(Unsupported::Layers { views, layers, max });
            }
            let (side, max) = (size[0].max(size[1]), limits.max_texture_dimension_2d);
            if side > max {
                let what = format!("textures of {side} texels ({max} are possible)");
                return refused(self.site.technique, what, "take another technique".into());
            }
        }
        Ok(())
    }
}

impl<P: Deref<Target = dyn Store>> Plan for IdPlan<'_, P> {
    fn check(&self) -> Result<(), Unsupported> {
        capacity::check(self.site.capacity)?;
        let wrong = |error| Unsupported::Description { technique: self.site.technique.into(), error };
        check_files(self.store.needs()).map_err(wrong)?;
        self.store.check(&self.site)?;
        self.check_images()?;
        self.check_buffers()
    }

    fn shaders(&self) -> Vec<Shader> {
        let shader = |pass, text| Shader { pass, text, targets: Vec::new() };
        let cast = |spot| {
            let pass = TrianglePass::Pulled(Coverage::Touched, spot);
            shader("cast", self.draw_text(pass, Holes::None))
        };
        let steps = self.store.steps(&self.site);
        let computed = steps.iter().filter_map(|step| match step {
            Step::Compute { label, wgsl, .. } => Some(shader(*label, self.compute_text(wgsl))),
            Step::Draw { .. } => None,
        });
        [false, true].map(cast).into_iter().chain(computed).collect()
    }

    fn cutout(&self, wgsl: &str) -> Option<Shader> {
        let text = self.draw_text(TrianglePass::Any, self.holes(wgsl));
        Some(Shader { pass: "cut-out", text, targets: Vec::new() })
    }

    fn lookups(&self, group: u32, first: u32) -> String {
        let holes = if self.site.asks {
            include_str!("vertices/holes.wgsl.in")
        } else {
            include_str!("vertices/whole.wgsl.in")
        };
        let vertices = [include_str!("vertices/lookup.wgsl.in"), holes].concat();
        let vertices = vertices
            .replace("{triangles}", &self.site.capacity.triangles.to_string())
            .replace("{records}", &self.records().to_string());
        self.storage.looked_up(group, first) + &vertices + &self.store.lookups(&self.site)
    }

    fn build(&self, device: &wgpu::Device, pipelines: &Pipelines) -> Box<dyn Cast> {
        Box::new(on_device::IdCast::new(self, device, pipelines))
    }
}
