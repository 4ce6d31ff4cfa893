//! The shared WGSL files by name.

use crate::error::DescriptionError;

/// WGSL for casters: `caster_pancaked(clip_from_world, position) -> vec4f`, for devices without
/// depth clamping (see [`Capabilities::clamps_depth`](crate::Capabilities::clamps_depth)).
pub const CASTER_WGSL: &str = include_str!("caster.wgsl");

/// Every shared WGSL file by its stem; a folder's name is part of the stem.
pub(super) const FILES: &[(&str, &str)] = &[
    ("blur_adaptive", include_str!("blur/adaptive.wgsl")),
    ("blur_fixed", include_str!("blur/fixed.wgsl")),
    ("caster", CASTER_WGSL),
    ("chebyshev", include_str!("chebyshev.wgsl")),
    ("coverage", include_str!("coverage.wgsl")),
    ("key", include_str!("key.wgsl")),
    ("level_hardware", include_str!("level/hardware.wgsl")),
    ("level_logarithmic", include_str!("level/logarithmic.wgsl")),
    ("level_manual", include_str!("level/manual.wgsl")),
    ("level_placed", include_str!("level/placed.wgsl")),
    ("lookup_anisotropic", include_str!("lookup/anisotropic.wgsl")),
    ("lookup_bilinear", include_str!("lookup/bilinear.wgsl")),
    ("lookup_fitted", include_str!("lookup/fitted.wgsl")),
    ("lookup_nearest", include_str!("lookup/nearest.wgsl")),
    ("lookup_summed", include_str!("lookup/summed.wgsl")),
    ("lookup_trilinear", include_str!("lookup/trilinear.wgsl")),
    ("packing_corners", include_str!("packing/corners.wgsl")),
    ("packing_edges", include_str!("packing/edges.wgsl")),
    ("points_map", include_str!("points/map.wgsl")),
    ("points_texel", include_str!("points/texel.wgsl")),
    ("quantizer", include_str!("quantizer.wgsl")),
    ("raster", include_str!("raster.wgsl")),
    ("ray", include_str!("ray.wgsl")),
    ("receiver", include_str!("receiver.wgsl")),
    ("record", include_str!("record.wgsl")),
    ("reference_exact", include_str!("reference/exact.wgsl")),
    ("reference_stepped", include_str!("reference/stepped.wgsl")),
    ("samples", include_str!("samples.wgsl")),
    ("spin_fixed", include_str!("spin/fixed.wgsl")),
    ("spin_noise", include_str!("spin/noise.wgsl")),
    ("spline", include_str!("spline.wgsl")),
    ("stored", include_str!("stored.wgsl")),
    ("stored_reversed", include_str!("stored/reversed.wgsl")),
    ("taps_bilinear", include_str!("taps/bilinear.wgsl")),
    ("taps_gather", include_str!("taps/gather.wgsl")),
    ("taps_merged", include_str!("taps/merged.wgsl")),
    ("taps_nearest", include_str!("taps/nearest.wgsl")),
    ("taps_weights", include_str!("taps/weights.wgsl")),
    ("tile_placed", include_str!("tile/placed.wgsl")),
    ("tile_whole", include_str!("tile/whole.wgsl")),
    ("uphill", include_str!("uphill.wgsl")),
    ("words_1", include_str!("words/1.wgsl")),
    ("words_2", include_str!("words/2.wgsl")),
    ("words_4", include_str!("words/4.wgsl")),
];

/// Text of a shared file.
pub(crate) fn text(stem: &str) -> Option<&'static str> {
    FILES.iter().find(|(name, _)| *name == stem).map(|(_, text)| *text)
}

/// What to say of a stem that is no file: a slot that nothing fills, or a name that does not exist.
pub(super) fn missing(stem: &str) -> DescriptionError {
    let all = || FILES.iter().map(|(name, _)| (*name).to_string());
    let files: Vec<String> = all().filter(|name| name.starts_with(&format!("{stem}_"))).collect();
    if files.is_empty() {
        return DescriptionError::File { stem: stem.into(), known: all().collect() };
    }
    DescriptionError::Slot { slot: stem.into(), files }
}

/// Whether files of these stems exist that leave no slot open.
///
/// # Errors
/// [`DescriptionError::File`], [`DescriptionError::Slot`].
pub(crate) fn check(stems: &[&str]) -> Result<(), DescriptionError> {
    stems.iter().try_for_each(|stem| text(stem).map(drop).ok_or_else(|| missing(stem)))
}
