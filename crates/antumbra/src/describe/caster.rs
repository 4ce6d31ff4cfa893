//! What casters leave for a technique.

/// What the casters' pass leaves for a technique.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Caster {
    /// Depth, drawn by the renderer's own pipelines; maps are encoded from it.
    Depth,
    /// The nearest triangle of each texel, drawn from [`CasterMesh`](crate::CasterMesh)es by the
    /// library's pipelines straight into the only one of the [maps](super::Description::maps), one layer per
    /// entry. The technique's WGSL, or one of its [slots](super::Description::slots), defines
    /// `packing_triangle(corners: mat3x3f, slope: vec2f) -> vec4u`, what all texels of a triangle
    /// share; `packing_slope(words: vec4u) -> vec2f`, its slope as decoded; and `packing_texel(shared:
    /// vec4u, corners: mat3x3f, distances: vec3f, centre: vec2f, size: vec2f, anchor: vec3f,
    /// slope: vec2f, alone: bool) -> vec4u`, what a texel stores. All zeros are an empty texel.
    Triangles(&'static [Coverage]),
    /// All triangles that touch each texel, drawn from [`CasterMesh`](crate::CasterMesh)es by the
    /// library's pipelines: [`Binding::List`](super::Binding::List). They are drawn twice, to count and to fill the lists, so
    /// that the closure of [`ShadowMap::encode`](crate::ShadowMap::encode) must draw the same in the
    /// same order both times. What exceeds the map's [`Capacity`](crate::Capacity) is left out.
    Lists,
    /// Some of the triangles that touch each texel, drawn once from
    /// [`CasterMesh`](crate::CasterMesh)es by the library's pipelines: [`Binding::Ranked`](super::Binding::Ranked). They are those
    /// that show their far side to the light, and then those that show the near one, from the light on.
    /// Sides are told by winding: where all triangles of an object are wound the wrong way around they are
    /// swapped, which does no harm. Beside them the depth of the texels' centres ([`Binding::Depth`](super::Binding::Depth)).
    Ranked {
        /// Triangles per texel, at least 1.
        keeps: u32,
    },
}

impl Caster {
    /// Whether it keeps triangles by id, for which a map needs [`Capacity`](crate::Capacity).
    #[must_use]
    pub fn keeps_ids(self) -> bool {
        match self {
            Self::Depth | Self::Triangles(_) => false,
            Self::Lists | Self::Ranked { .. } => true,
        }
    }
}

/// A buffer that [`Caster::Ranked`] leaves. The technique's WGSL reads it through a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ranked {
    /// `shadow_key(i: u32) -> u32`: of each texel the keys of its triangles, as in `key.wgsl`, the
    /// greatest first, 0 where there are fewer; with `shadow_key_bits() -> u32`, the bits of a triangle's id
    /// in them, and `shadow_near_over_far(view: u32) -> f32`, 1 for the sun, which makes depth linear.
    /// Those of texel (x, y) begin at `keeps` · ((view · height + y) · width + x).
    Keys,
    /// `shadow_corner(view: u32, triangle: u32, corner: u32) -> vec3f`: x and y in texels of the map, y down,
    /// z the depth as rasterised.
    Corners,
}

/// A texture that [`Caster::Lists`] leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum List {
    /// `texture_2d_array<u32>`: of each texel the first entry of its list in layer 2·view, the one
    /// behind its last in the next layer.
    Ranges,
    /// `texture_2d_array<u32>`: entry i, the number of a triangle, in texel (i mod 2048, ⌊i / 2048⌋ mod
    /// 2048) of layer ⌊i / 2048²⌋ of the view's, all of which have as many.
    Numbers,
    /// `texture_2d_array<f32>`: corner c of triangle n in texel (n mod 2048, ⌊n / 2048⌋) of layer
    /// 3·view + c: x and y in texels of the map, y down, z the depth as rasterised.
    Corners,
}

/// Which texels a triangle is drawn to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// All that it touches: conservative rasterisation.
    Touched,
    /// Those whose centre it covers, as rasterisers do.
    Centre,
}
