//! What is kept of casters for a technique.

/// What is kept of the casters for a technique.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CasterStorage {
    /// Depth, drawn by the renderer's own pipelines; maps are encoded from it.
    Depth,
    /// The nearest triangle of each texel, drawn from [`CasterMesh`](crate::CasterMesh)es by the
    /// library's pipelines straight into the only one of the [maps](super::Description::maps), one layer per
    /// entry. The technique's WGSL, or one of its [slots](super::Description::slots), defines
    /// `packing_triangle(corners: mat3x3f, slope: vec2f) -> vec4u`, what all texels of a triangle
    /// share; `packing_slope(words: vec4u) -> vec2f`, its slope as decoded; and `packing_texel(shared:
    /// vec4u, corners: mat3x3f, distances: vec3f, centre: vec2f, size: vec2f, anchor: vec3f,
    /// slope: vec2f, alone: bool) -> vec4u`, what a texel stores. All zeros are an empty texel.
    NearestTriangle(&'static [Coverage]),
    /// All triangles that touch each texel, drawn from [`CasterMesh`](crate::CasterMesh)es by the library's
    /// pipelines. The technique's WGSL calls `shadow_list(view: u32, texel: vec2i) -> vec2u`, the first
    /// entry of the list of a view's texel and the one behind its last;
    /// `shadow_entry(view: u32, i: u32) -> u32`, the id of the triangle of an entry; and what all ids lead
    /// to: `shadow_corner(view: u32, id: u32, corner: u32) -> vec3f`, x and y in texels of the map, y down, z
    /// the depth as rasterised, and `shadow_stops(view: u32, id: u32, a: vec3f, b: vec3f, c: vec3f) -> bool`,
    /// whether a ray that these corners lie around meets no hole. Casters are drawn twice, to count and to
    /// fill the lists, so that the closure of [`ShadowMap::encode`](crate::ShadowMap::encode) must draw the
    /// same in the same order both times. What exceeds the map's [`Capacity`](crate::Capacity) is left out.
    ABuffer,
    /// Some of the triangles that touch each texel, drawn once from [`CasterMesh`](crate::CasterMesh)es by
    /// the library's pipelines. Far sides, which show their back to the light, come before near sides,
    /// and of each the ones nearer to the light first. Winding tells the sides: an object that is wound the wrong
    /// way around has its near sides kept first, which shadow as well. The depth of the texels' centres is kept, too
    /// ([`Binding::Depth`](super::Binding::Depth)).
    ///
    /// The technique's WGSL calls `shadow_key(i: u32) -> u32`: of each texel the keys of its triangles, as in
    /// `key.wgsl`, the greatest first, 0 where there are fewer; those of a texel begin at `k` ·
    /// `tile_index(view, texel)`. `shadow_key_bits() -> u32` are the bits of a triangle's id in them, and
    /// `shadow_near_over_far(view: u32) -> f32`, 1 for the sun, makes depth linear. Ids lead to corners as in
    /// [`ABuffer`](Self::ABuffer).
    KBuffer {
        /// Triangles per texel, at least 1.
        k: u32,
    },
    /// Triangles by id, as a store of the technique's own keeps them.
    #[cfg(feature = "store")]
    Own(super::store::OwnStore),
}

impl CasterStorage {
    /// Whether it keeps triangles by id, for which a map needs [`Capacity`](crate::Capacity).
    #[must_use]
    pub fn keeps_ids(self) -> bool {
        !matches!(self, Self::Depth | Self::NearestTriangle(_))
    }
}

/// Which texels a triangle is drawn to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// All that it touches: conservative rasterisation.
    Touched,
    /// Those whose centre it covers, as rasterisers do.
    Centre,
}
