//! Puts the shaders together that draw triangles: one skeleton, with small files in its slots.

use crate::{describe::Coverage, shader::ShaderText};

/// What shaders know of the view.
pub(super) const VIEW: &str = include_str!("view.wgsl.in");
/// Places the triangles of a [`CasterMesh`](crate::CasterMesh) on the map.
const MESH: &str = include_str!("mesh.wgsl.in");
/// What all texels need to know of a triangle.
const TRIANGLE: &str = include_str!("triangle.wgsl.in");
/// Vertices that see whole triangles.
pub(super) const PULLED: &str = include_str!("pulled.wgsl.in");

/// What is known beforehand of a pass that draws triangles. It leaves out code that software drivers would
/// run for nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TrianglePass {
    /// Nothing: any texels, any view.
    Any,
    /// Its texels, and whether the view is a spot's.
    Pulled(Coverage, bool),
    /// Its texels, which the device's rasteriser finds; vertices are shared, the view is the sun's.
    Indexed(Coverage),
}

impl TrianglePass {
    /// How far a texel reaches from its centre, and whether the view is a spot's, in WGSL.
    fn words(self) -> [&'static str; 2] {
        let reach = |coverage| if coverage == Coverage::Touched { "0.5" } else { "0.0" };
        match self {
            Self::Any => ["caster_view.reach", "(caster_view.perspective == 1u)"],
            Self::Pulled(coverage, true) => [reach(coverage), "true"],
            Self::Pulled(coverage, false) | Self::Indexed(coverage) => [reach(coverage), "false"],
        }
    }

    /// Whether texels may belong to it whose centres are beyond the triangle.
    pub(super) fn reaches(self) -> bool {
        match self {
            Self::Any => true,
            Self::Pulled(coverage, _) | Self::Indexed(coverage) => coverage == Coverage::Touched,
        }
    }
}

/// How parts of triangles are left out.
#[derive(Debug, Clone, Copy)]
pub(super) enum Holes<'a> {
    /// Nowhere.
    None,
    /// In texels, as the caller's WGSL says.
    ByTexel(&'a str),
    /// Where rays meet them, as the caller's WGSL will say; vertices have records from this entry on.
    ByRay(&'a str, u64),
}

/// Members of `CasterTriangle`: names and types.
pub(super) type Varyings = &'static [(&'static str, &'static str)];

/// Those of triangles with holes.
const SHARES: Varyings =
    &[("triangle", "u32"), ("share_0", "vec3f"), ("share_1", "vec3f"), ("share_2", "vec3f")];
/// Locations before a store's.
const LOCATIONS: usize = 4;

/// A whole shader: what is `needed` from the library, members of `CasterTriangle`, and the texts of a store.
pub(super) fn compose(
    pass: TrianglePass,
    holes: Holes<'_>,
    mut needed: ShaderText,
    varyings: &[(&str, &str)],
    texts: &[&str],
) -> String {
    needed.add(&["coverage"]);
    let (user, slots, more): (&str, &[&str], Varyings) = match holes {
        Holes::None => ("", &[include_str!("cutout/none.wgsl.in")], &[]),
        Holes::ByTexel(user) => {
            (user, &[include_str!("cutout/shares.wgsl.in"), include_str!("cutout/texel.wgsl.in")], SHARES)
        }
        Holes::ByRay(user, _) => {
            (user, &[include_str!("cutout/shares.wgsl.in"), include_str!("cutout/ray.wgsl.in")], SHARES)
        }
    };
    if !more.is_empty() {
        needed.add(&["ray", "record"]);
    }
    let records = if let Holes::ByRay(_, records) = holes { records } else { 0 };
    let members: String = (LOCATIONS..)
        .zip(varyings.iter().chain(more))
        .map(|(i, (name, ty))| format!("    @location({i}) @interpolate(flat) {name}: {ty},\n"))
        .collect();
    let [reach, spot] = pass.words();
    let glue: String = [VIEW, MESH, TRIANGLE]
        .into_iter()
        .chain(slots.iter().copied())
        .chain(texts.iter().copied())
        .collect();
    let glue = glue
        .replace("{varyings}", &members)
        .replace("{records}", &records.to_string())
        .replace("{spot}", spot)
        .replace("{reach}", reach);
    let enable = if matches!(pass, TrianglePass::Indexed(_)) { "enable primitive_index;\n" } else { "" };
    format!("{enable}{user}\n{}{glue}", needed.text())
}
