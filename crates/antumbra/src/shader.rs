//! Puts WGSL together: a technique's file, the shared files that it needs, and generated glue.
//!
//! WGSL files hold functions, constants and uniform structs only; textures and samplers reach them
//! as parameters, settings and buffers through functions that are written beside what is bound. The first
//! line may be `//! needs a b`: stems of other files, or a slot such as `lookup` that one of the technique's
//! [slots](crate::Description::slots) fills (`lookup_fitted`). Bound globals exist in the glue alone.

use crate::{
    capabilities::Capabilities,
    describe::{Caster, Coverage},
};
use split::Splits;

pub(crate) mod buffers;
mod compose;
mod files;
mod listing;
mod receiver;
pub(crate) mod settings;
pub(crate) mod split;
mod unroll;

pub(crate) use compose::Composition;
pub use files::CASTER_WGSL;
pub(crate) use files::text as file;
pub use listing::Shader;
pub(crate) use receiver::MapSize;

/// A shader in pieces that remember which file they came from.
#[derive(Debug, Clone, Default)]
pub struct ShaderText {
    pieces: Vec<(String, String)>,
}

impl ShaderText {
    /// Everything as one text.
    #[must_use]
    pub fn text(&self) -> String {
        self.pieces.iter().map(|(_, text)| text.as_str()).collect()
    }

    /// The caller's shader, followed by this one: her `enable` lines stay first and her line
    /// numbers stay right.
    #[must_use]
    pub fn after(&self, user: &str) -> wgpu::ShaderSource<'static> {
        wgpu::ShaderSource::Wgsl(format!("{user}\n{}", self.text()).into())
    }

    /// File and line (from 1) of line `line` (from 1) of [`after`](Self::after)`(user)`, if it is
    /// not the caller's own.
    #[must_use]
    pub fn locate(&self, user: &str, line: usize) -> Option<(&str, usize)> {
        // `lines` would drop a final empty line, which the joining newline makes real.
        let mut start = user.split('\n').count();
        for (name, text) in &self.pieces {
            let length = text.matches('\n').count();
            if (start + 1..=start + length).contains(&line) {
                return Some((name, line - start));
            }
            start += length;
        }
        None
    }
}

/// Places the triangles of a [`CasterMesh`](crate::CasterMesh) on the map.
const MESH: &str = include_str!("shader/mesh.wgsl.in");

/// What texels store of triangles.
const TRIANGLES: &str = include_str!("shader/triangles.wgsl.in");

/// What is known beforehand of a pass that draws triangles. It leaves out code that software drivers would
/// run for nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TrianglePass {
    /// Nothing: any texels, any view.
    Any,
    /// Its texels, and whether the view is a spot's.
    Pulled(Coverage, bool),
    /// Its texels, which the device's rasteriser finds; vertices are shared, the view is the sun's.
    Indexed(Coverage),
}

/// How parts of triangles are left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cutout<'a> {
    /// The caller's WGSL that says which.
    pub(crate) wgsl: &'a str,
    /// Whether lookups ask about them, ray by ray; else texels leave them out.
    pub(crate) by_ray: bool,
}

/// The pass that draws triangles for casters that are not [`Caster::Depth`].
pub(crate) fn triangles(
    composition: &Composition,
    device: &Capabilities,
    cutout: Option<Cutout<'_>>,
    pass: TrianglePass,
    splits: &Splits,
) -> String {
    let caster = composition.description.caster;
    let mut shader = match caster {
        // Nothing that it looks up is bound here.
        Caster::Ranked { .. } => {
            let mut shader = ShaderText::default();
            shader.add(&["key", "raster"]);
            shader
        }
        _ => composition.alone(),
    };
    shader.add(&["coverage"]);
    if cutout.is_some() {
        shader.add(&["ray", "record"]);
    }
    let text = shader.text();
    let indexed = matches!(pass, TrianglePass::Indexed(_));
    let entry = match caster {
        Caster::Lists => [include_str!("shader/lists.wgsl.in"), ""],
        Caster::Ranked { .. } => [include_str!("shader/ranked.wgsl.in"), ""],
        _ if indexed => [TRIANGLES, include_str!("shader/triangles/indexed.wgsl.in")],
        Caster::Depth | Caster::Triangles(_) => [TRIANGLES, include_str!("shader/triangles/pulled.wgsl.in")],
    };
    // Least depths are planes, which corners tell unless vertices are shared or depth may not be unclamped.
    let own_depth = !device.clamps_depth() || pass == TrianglePass::Indexed(Coverage::Touched);
    let alone = if cutout.is_some() { "true" } else { "false" };
    let by_vertices = device.stores_from_vertices();
    let by_ray = cutout.is_some_and(|cutout| cutout.by_ray);
    let kept = [
        (by_vertices, "// by vertices"),
        (!by_vertices, "// by fragments"),
        (cutout.is_some(), compose::CUT_OUTS),
        (by_ray, "// by ray"),
        (cutout.is_some() && !by_ray, "// by texel"),
        (own_depth, "// own depth"),
    ];
    let left_out = |line: &&str| kept.iter().any(|(kept, mark)| !kept && line.contains(mark));
    let buffers = buffers::of_casters(caster, splits);
    let entry = entry.map(|text| text.replace("{buffers}\n", &buffers));
    let glue = MESH.lines().chain(entry.iter().flat_map(|text| text.lines())).filter(|line| !left_out(line));
    let reach = |coverage| if coverage == Coverage::Touched { "0.5" } else { "0.0" };
    let (reach, spot) = match pass {
        TrianglePass::Any => ("caster_view.reach", "(caster_view.perspective == 1u)"),
        TrianglePass::Pulled(coverage, true) => (reach(coverage), "true"),
        TrianglePass::Pulled(coverage, false) | TrianglePass::Indexed(coverage) => (reach(coverage), "false"),
    };
    let glue: String = glue.flat_map(|line| [line, "\n"]).collect();
    format!(
        "{}{}\n{text}{}",
        if indexed { "enable primitive_index;\n" } else { "" },
        cutout.map_or("", |cutout| cutout.wgsl),
        glue.replace("{asked}", if by_ray { "1.0" } else { "0.0" })
            .replace("{alone}", alone)
            .replace("{spot}", spot)
            .replace("{reach}", reach)
    )
}

/// The pass between counting and filling lists.
pub(crate) fn scan(splits: &Splits) -> String {
    include_str!("shader/scan.wgsl.in").replace("{buffers}\n", &buffers::of_scan(splits))
}

#[cfg(test)]
mod tests;
