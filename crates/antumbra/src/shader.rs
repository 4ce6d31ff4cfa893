//! Puts WGSL together: a technique's file, the shared files that it needs, and generated glue.
//!
//! WGSL files hold functions, constants and uniform structs only; textures and samplers reach them
//! as parameters. The first line may be `//! needs a b`: stems of other files, or a slot such as
//! `lookup` that one of the technique's [parts](crate::Technique::parts) fills
//! (`lookup_fitted`). Bound globals exist in the glue alone.

use crate::{
    capabilities::Capabilities,
    map::Capacity,
    technique::{Binding, Caster, Constant, Coverage, DepthSpace, Family, List, Map, Ranked, Technique},
};
use split::Splits;
use std::fmt::Write;

/// Every shared WGSL file by its stem; a folder's name is part of the stem.
const FILES: &[(&str, &str)] = &[
    ("caster", include_str!("shader/caster.wgsl")),
    ("blur_adaptive", include_str!("shader/blur/adaptive.wgsl")),
    ("blur_fixed", include_str!("shader/blur/fixed.wgsl")),
    ("chebyshev", include_str!("shader/chebyshev.wgsl")),
    ("coverage", include_str!("shader/coverage.wgsl")),
    ("key", include_str!("shader/key.wgsl")),
    ("level_hardware", include_str!("shader/level/hardware.wgsl")),
    ("level_logarithmic", include_str!("shader/level/logarithmic.wgsl")),
    ("level_manual", include_str!("shader/level/manual.wgsl")),
    ("lookup_anisotropic", include_str!("shader/lookup/anisotropic.wgsl")),
    ("lookup_bilinear", include_str!("shader/lookup/bilinear.wgsl")),
    ("lookup_fitted", include_str!("shader/lookup/fitted.wgsl")),
    ("lookup_nearest", include_str!("shader/lookup/nearest.wgsl")),
    ("lookup_summed", include_str!("shader/lookup/summed.wgsl")),
    ("lookup_trilinear", include_str!("shader/lookup/trilinear.wgsl")),
    ("packing_corners", include_str!("shader/packing/corners.wgsl")),
    ("packing_edges", include_str!("shader/packing/edges.wgsl")),
    ("points_map", include_str!("shader/points/map.wgsl")),
    ("points_texel", include_str!("shader/points/texel.wgsl")),
    ("quantizer", include_str!("shader/quantizer.wgsl")),
    ("raster", include_str!("shader/raster.wgsl")),
    ("ray", include_str!("shader/ray.wgsl")),
    ("receiver", include_str!("shader/receiver.wgsl")),
    ("record", include_str!("shader/record.wgsl")),
    ("reference_exact", include_str!("shader/reference/exact.wgsl")),
    ("reference_stepped", include_str!("shader/reference/stepped.wgsl")),
    ("samples", include_str!("shader/samples.wgsl")),
    ("spin_fixed", include_str!("shader/spin/fixed.wgsl")),
    ("spin_noise", include_str!("shader/spin/noise.wgsl")),
    ("spline", include_str!("shader/spline.wgsl")),
    ("taps_bilinear", include_str!("shader/taps/bilinear.wgsl")),
    ("taps_gather", include_str!("shader/taps/gather.wgsl")),
    ("taps_merged", include_str!("shader/taps/merged.wgsl")),
    ("taps_nearest", include_str!("shader/taps/nearest.wgsl")),
    ("taps_weights", include_str!("shader/taps/weights.wgsl")),
    ("words_1", include_str!("shader/words/1.wgsl")),
    ("words_2", include_str!("shader/words/2.wgsl")),
    ("words_4", include_str!("shader/words/4.wgsl")),
];

/// WGSL for casters: `caster_pancaked(clip_from_world, position) -> vec4f`, for devices without
/// depth clamping (see [`Capabilities::clamps_depth`]).
pub const CASTER_WGSL: &str = FILES[0].1;

/// A shader in pieces that remember which file they came from.
#[derive(Debug, Clone)]
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

    fn push(&mut self, name: &str, text: &str) {
        let end = if text.ends_with('\n') { "" } else { "\n" };
        self.pieces.push((format!("{name}.wgsl"), format!("{text}{end}")));
    }

    /// The technique's own file and all that it needs, constants replaced, needs first. Without what is for
    /// cut-outs alone.
    pub(crate) fn library(technique: &dyn Technique, device: &Capabilities) -> Self {
        let mut shader = Self::asking(technique, device, false);
        if technique.blur().is_some() {
            shader.push("shadow_blur", NO_BLUR);
        }
        shader
    }

    /// The same; `asks` says whether it has what is for cut-outs.
    fn asking(technique: &dyn Technique, device: &Capabilities, asks: bool) -> Self {
        let mut shader = Self { pieces: Vec::new() };
        let parts = technique.parts(device);
        shader.need("raster", &parts);
        shader.need_all(technique.wgsl(), &parts);
        // Empty lines instead of those left out, so that line numbers stay right.
        let line = |line: &'static str| if asks || !line.contains(CUT_OUTS) { line } else { "" };
        let text: String = technique.wgsl().lines().flat_map(|l| [line(l), "\n"]).collect();
        shader.push(technique.page().name, &text);
        for constant in technique.constants() {
            shader.replace(&constant);
        }
        shader.unroll();
        shader
    }

    /// A file's text with all that it needs.
    fn file(stem: &str, parts: &[&str]) -> Self {
        let mut shader = Self { pieces: Vec::new() };
        shader.need(stem, parts);
        shader
    }

    fn need_all(&mut self, text: &str, parts: &[&str]) {
        let needs = text.lines().next().and_then(|line| line.strip_prefix("//! needs ")).unwrap_or_default();
        for stem in needs.split_whitespace() {
            self.need(stem, parts);
        }
    }

    fn need(&mut self, stem: &str, parts: &[&str]) {
        let slot = format!("{stem}_");
        let stem = parts.iter().find(|part| part.starts_with(&slot)).copied().unwrap_or(stem);
        let name = format!("{stem}.wgsl");
        if self.pieces.iter().any(|(n, _)| *n == name) {
            return;
        }
        let text = FILES.iter().find(|(s, _)| *s == stem).map_or("", |(_, text)| *text);
        debug_assert!(!text.is_empty(), "no WGSL file fills '{stem}' with the parts {parts:?}");
        self.need_all(text, parts);
        self.push(stem, text);
    }

    /// Writes the loops out that say so.
    fn unroll(&mut self) {
        let all = self.text();
        let count = |name: &str| {
            let value = all.lines().find_map(|l| l.strip_prefix(&format!("const {name}: u32 = ")))?;
            value.trim_end_matches([';', 'u']).parse().ok()
        };
        for (_, text) in &mut self.pieces {
            *text = unroll::unroll(text, count);
        }
    }

    /// Replaces the one-line declaration of a constant.
    fn replace(&mut self, constant: &Constant) {
        let (name, declaration) = match constant {
            Constant::Count(name, n) => (name, format!("const {name}: u32 = {n}u;")),
            Constant::Number(name, x) => (name, format!("const {name}: f32 = {x:?};")),
            Constant::Array(name, values) => {
                let list: Vec<String> = values.iter().map(|v| format!("{v:?}")).collect();
                (name, format!("const {name} = array<f32, {}>({});", values.len(), list.join(", ")))
            }
        };
        let starts = [format!("const {name} "), format!("const {name}:")];
        let mut replaced = 0;
        for (_, text) in &mut self.pieces {
            *text = text
                .split_inclusive('\n')
                .map(|line| match starts.iter().any(|s| line.starts_with(s)) {
                    true => {
                        replaced += 1;
                        format!("{declaration}\n")
                    }
                    false => line.to_string(),
                })
                .collect();
        }
        debug_assert_eq!(replaced, 1, "constant {name} must be declared once, on one line");
    }
}

/// For texts that look nothing up.
const NO_BLUR: &str = "fn shadow_blur(view: u32) -> f32 { return 0.0; }\n";

/// Variance of the blur, for receivers.
const BLUR: &str = "fn shadow_blur(view: u32) -> f32 { return shadow.views[view].blur; }\n";

/// Ends lines that are for cut-outs alone.
const CUT_OUTS: &str = "// cut-outs";

/// What projecting, interpolating and storing as a float do to a projected depth: eight units in the
/// last place from ½ to 1.
const ROUNDING: &str = "4.8e-7";

/// WGSL type of a binding.
fn wgsl_type(binding: Binding, maps: &[Map]) -> &'static str {
    match binding {
        Binding::Depth => "texture_depth_2d_array",
        Binding::Compare(_) => "sampler_comparison",
        Binding::Map(i) if maps.get(i).is_some_and(Map::holds_integers) => "texture_2d_array<u32>",
        Binding::Map(_) | Binding::List(List::Corners) => "texture_2d_array<f32>",
        Binding::List(List::Ranges | List::Numbers) => "texture_2d_array<u32>",
        Binding::Sampler => "sampler",
        // Declared by `Split`.
        Binding::Ranked(_) => "array<vec4f>",
    }
}

/// What generated text needs to know of a map's size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MapSize {
    pub(crate) views: u32,
    pub(crate) capacity: Capacity,
    pub(crate) splits: Splits,
    /// Whether lookups ask about cut-outs.
    pub(crate) asks: bool,
}

/// The functions through which a technique reads a buffer, which WGSL cannot pass on.
fn accessors(ranked: Ranked, name: &str, size: MapSize) -> String {
    let Capacity { triangles, .. } = size.capacity;
    match ranked {
        Ranked::Keys => format!(
            "fn shadow_key(i: u32) -> u32 {{ {} }}\n\
             fn shadow_key_bits() -> u32 {{ return {}u; }}\n\
             fn shadow_near_over_far(view: u32) -> f32 {{ return shadow.views[view].near_over_far; }}\n",
            size.splits.keys.chosen(name, |buffer, i| format!("return {buffer}[{i}];")),
            size.capacity.id_bits()
        ),
        Ranked::Corners if size.asks => format!(
            "fn shadow_vertex(i: u32, corner: u32) -> vec4f {{ {} }}\n\
             fn shadow_corner(view: u32, triangle: u32, corner: u32) -> vec3f {{ \
             return shadow_vertex(view * {triangles}u + triangle, corner).xyz; }}\n\
             fn shadow_has_holes(view: u32, triangle: u32) -> bool {{ \
             return shadow_vertex(view * {triangles}u + triangle, 0u).w != 0.0; }}\n\
             fn shadow_record(view: u32, triangle: u32, corner: u32) -> vec4f {{ \
             return shadow_vertex({}u + view * {triangles}u + triangle, corner); }}\n",
            size.splits.corners.chosen(name, |buffer, i| format!("return {buffer}[3u * {i} + corner];")),
            size.splits.corners.elements / 2
        ),
        Ranked::Corners => format!(
            "fn shadow_corner(view: u32, triangle: u32, corner: u32) -> vec3f {{ \
             let i = view * {triangles}u + triangle; {} }}\n",
            size.splits.corners.chosen(name, |buffer, i| format!("return {buffer}[3u * {i} + corner].xyz;"))
        ),
    }
}

/// `shadow_visibility` and everything it needs, bound in `group`; it may call the user's
/// `shadow_covers` about cut-outs.
pub(crate) fn receiver(
    technique: &dyn Technique,
    device: &Capabilities,
    size: MapSize,
    group: u32,
) -> ShaderText {
    let mut shader = ShaderText::asking(technique, device, size.asks);
    shader.need("receiver", &[]);
    if size.asks {
        shader.need("record", &[]);
        shader.push("shadow_stops", include_str!("shader/stops.wgsl.in"));
    }
    let name = technique.page().name;
    let widths: String =
        technique.widths().iter().map(|(width, _)| format!(", width_{width}: f32")).collect();
    let blur = technique.blur().map_or("", |_| ", blur: f32");
    let mut glue = format!(
        "struct ShadowView {{ clip_from_world: mat4x4f, depth_plane: vec4f, to_light: vec4f, texel_world: f32, near_over_far: f32, reach_x: f32, reach_y: f32{widths}{blur} }}\n\
         struct ShadowUniforms {{\n    views: array<ShadowView, {}>,\n    view_count: u32, width: f32, height: f32,\n    constant_texels: f32, slope_texels: f32, normal_offset_texels: f32, grazing_offset_texels: f32,\n    receiver_plane: f32, constant_depth: f32, float_steps: f32,\n",
        size.views
    );
    for (uniform, _) in technique.uniforms() {
        let _ = writeln!(glue, "    setting_{uniform}: f32,");
    }
    let _ = writeln!(glue, "}}\n@group({group}) @binding(0) var<uniform> shadow: ShadowUniforms;");
    glue += technique.blur().map_or("", |_| BLUR);
    let mut arguments = String::new();
    let maps = technique.maps(device).unwrap_or_default();
    // Further buffers of split arrays come behind all bindings.
    let mut more = technique.bindings().len() as u32;
    for (i, binding) in technique.bindings().into_iter().enumerate() {
        if let Binding::Ranked(ranked) = binding {
            let (split, of) = match ranked {
                Ranked::Keys => (size.splits.keys, "u32"),
                Ranked::Corners => (size.splits.corners, "vec4f"),
            };
            let name = format!("shadow_binding_{i}");
            glue += &split.declared(&name, "read", of, group, |k| match k {
                0 => i as u32 + 1,
                k => more + k,
            });
            more += split.count() - 1;
            glue += &accessors(ranked, &name, size);
            continue;
        }
        let _ = writeln!(
            glue,
            "@group({group}) @binding({}) var shadow_binding_{i}: {};",
            i + 1,
            wgsl_type(binding, &maps)
        );
        let _ = write!(arguments, "shadow_binding_{i}, ");
    }
    let uniforms = technique.uniforms().into_iter().map(|(uniform, _)| format!(", shadow.setting_{uniform}"));
    let widths = technique.widths().into_iter().map(|(width, _)| format!(", (*light).width_{width}"));
    let settings: String = uniforms.chain(widths).collect();
    let (depth, slopes, scale, rounding) = match technique.depth_space() {
        DepthSpace::Raster => {
            ("ndc.z", "vec2f(s.z, t.z)", "raster_slope(linear, (*light).near_over_far)", ROUNDING.to_string())
        }
        DepthSpace::Linear => (
            "linear",
            "vec2f(dot((*light).depth_plane.xyz, tangent), dot((*light).depth_plane.xyz, bitangent))",
            "1.0",
            format!("{ROUNDING} / raster_slope(linear, (*light).near_over_far)"),
        ),
    };
    // Other families do not compare texels one by one: what they do with the plane is no bias.
    let followed = match technique.page().family {
        Family::Comparison => "receiver_followed(plane, shadow.receiver_plane, diagonal)",
        Family::Basis | Family::Geometry => "plane",
    };
    let mut function = |kind: &str, result: &str, outside: &str| {
        let call = format!(
            "{name}_{kind}({arguments}uv, view, depth, {followed}, gradient_x, gradient_y{settings})"
        );
        glue += &include_str!("shader/visibility.wgsl.in")
            .replace("{kind}", kind)
            .replace("{result}", result)
            .replace("{outside}", outside)
            .replace("{depth}", depth)
            .replace("{slopes}", slopes)
            .replace("{scale}", scale)
            .replace("{rounding}", &rounding)
            .replace("{call}", &call);
    };
    function("visibility", "f32", "1.0");
    if !technique.classes().is_empty() {
        function("class", "u32", "0u");
    }
    shader.push("shadow_visibility", &glue);
    shader
}

/// Text of a shared file.
pub(crate) fn file(stem: &str) -> &'static str {
    FILES.iter().find(|(name, _)| *name == stem).map_or("", |(_, text)| text)
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
    technique: &dyn Technique,
    device: &Capabilities,
    cutout: Option<Cutout<'_>>,
    pass: TrianglePass,
    splits: &Splits,
) -> String {
    let mut shader = match technique.caster() {
        // Nothing that it looks up is bound here.
        Caster::Ranked { .. } => {
            let mut shader = ShaderText::file("key", &[]);
            shader.need("raster", &[]);
            shader
        }
        _ => ShaderText::library(technique, device),
    };
    shader.need("coverage", &[]);
    if cutout.is_some() {
        shader.need("ray", &[]);
        shader.need("record", &[]);
    }
    let text = shader.text();
    let indexed = matches!(pass, TrianglePass::Indexed(_));
    let entry = match technique.caster() {
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
        (cutout.is_some(), CUT_OUTS),
        (by_ray, "// by ray"),
        (cutout.is_some() && !by_ray, "// by texel"),
        (own_depth, "// own depth"),
    ];
    let left_out = |line: &&str| kept.iter().any(|(kept, mark)| !kept && line.contains(mark));
    let buffers = buffers::of_casters(technique.caster(), splits);
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

pub(crate) mod buffers;
mod listing;
pub(crate) mod split;
mod unroll;

pub use listing::Shader;

#[cfg(test)]
mod tests;
