//! The WGSL against the same formulas in f64, on thousands of random inputs.
//!
//! Every comparison is repeated with a reference that is slightly wrong, and must then fail.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod basis;
mod classes;
mod comparison;
mod geometry;
mod lists;
mod lookups;
mod ranked;
mod receiver;
mod silhouettes;
mod split;
mod stored;

use antumbra::{Capabilities, Size, Technique, technique, technique::Encode};
use antumbra_testing::ask::{Random, compute, depth_texture, shadow_map};
use antumbra_testing::{Gpu, Trials};

const SIZE: Size = Size::square(64);
const ROWS: usize = 4096;
/// Floats of input per invocation.
const INPUTS: usize = 16;
type Row = [f32; INPUTS];

/// Encode functions that a trial below compares.
const ENCODE_FUNCTIONS: [&str; 11] = [
    "vsm_encode",
    "vsm_encode_sloped",
    "csm_encode",
    "esm_encode",
    "esm_depth",
    "evsm_encode",
    "msm_encode",
    "lvsm_encode",
    "packed_encode",
    "stratified_encode",
    "packing_texel",
];

fn rows(seed: u64, make: impl Fn(&mut Random) -> Row) -> Vec<Row> {
    let mut random = Random::new(seed);
    (0..ROWS).map(|_| make(&mut random)).collect()
}

/// A row that begins with these values.
fn row<const N: usize>(values: [f32; N]) -> Row {
    std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
}

fn shadows(gpu: &Gpu, technique: &dyn Technique, seed: u64) -> antumbra::ShadowMap {
    shadow_map(gpu, technique, &depth_texture(gpu, SIZE, noise(seed)), SIZE.into())
}

fn noise(seed: u64) -> impl Fn(u32, u32) -> f32 {
    let mut random = Random::new(seed);
    let depths: Vec<f32> = (0..SIZE.width * SIZE.height).map(|_| random.unit()).collect();
    move |x, y| depths[(y * SIZE.width + x) as usize]
}

/// Runs `body`, which reads `take(i)` and writes `put(i, value)` for i < N, on every row.
fn run<const N: usize>(gpu: &Gpu, shadows: &antumbra::ShadowMap, body: &str, rows: &[Row]) -> Vec<[f32; N]> {
    let user = format!(
        "
        @group(1) @binding(0) var<storage, read> rows: array<f32>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        var<private> me: u32;
        fn take(i: u32) -> f32 {{ return rows[me * {INPUTS}u + i]; }}
        fn take2(i: u32) -> vec2f {{ return vec2f(take(i), take(i + 1u)); }}
        fn take3(i: u32) -> vec3f {{ return vec3f(take(i), take(i + 1u), take(i + 2u)); }}
        fn put(i: u32, value: f32) {{ results[me * {N}u + i] = value; }}
        fn put2(i: u32, value: vec2f) {{ put(i, value.x); put(i + 1u, value.y); }}
        fn put3(i: u32, value: vec3f) {{ put2(i, value.xy); put(i + 2u, value.z); }}
        fn put4(i: u32, value: vec4f) {{ put2(i, value.xy); put2(i + 2u, value.zw); }}
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
            if id.x * {INPUTS}u >= arrayLength(&rows) {{ return; }}
            me = id.x;
            {body}
        }}"
    );
    let input = bytemuck::cast_slice(rows.as_flattened());
    let flat = compute(gpu, shadows, &user, input, rows.len() * N, rows.len());
    flat.chunks_exact(N).map(|c| std::array::from_fn(|i| c[i])).collect()
}

/// `expected` gives values and the tolerance of each.
fn compare<const N: usize, const M: usize>(
    rows: &[Row],
    found: &[[f32; N]],
    expected: impl Fn(&[f64; INPUTS]) -> ([f64; M], f64),
) -> Result<(), String> {
    compare_from::<N, M>(0, rows, found, expected)
}

/// The same for the results from number `first` on.
fn compare_from<const N: usize, const M: usize>(
    first: usize,
    rows: &[Row],
    found: &[[f32; N]],
    expected: impl Fn(&[f64; INPUTS]) -> ([f64; M], f64),
) -> Result<(), String> {
    for (row, found) in rows.iter().zip(found) {
        let (values, tolerance) = expected(&row.map(f64::from));
        for (i, (f, e)) in found[first..].iter().zip(values).enumerate() {
            let difference = (f64::from(*f) - e).abs();
            if difference.is_nan() || difference > tolerance {
                return Err(format!("result {i}: {f} instead of {e} ± {tolerance:e} for {row:?}"));
            }
        }
    }
    Ok(())
}

/// What an interpolated number may be off, as a share of what its texels differ by: weights of GPUs'
/// samplers have 8 bits along each of two axes, rounded or cut off; software drivers' are floats.
fn sampler_error(gpu: &Gpu) -> f64 {
    if gpu.is_software() { 1e-5 } else { 2.0 / 256.0 }
}

/// Texel (x, y) of an image, edges repeated.
fn clamped(x: f64, y: f64, side: usize) -> usize {
    let index = |v: f64| v.clamp(0.0, side as f64 - 1.0) as usize;
    index(y) * side + index(x)
}

/// Bilinear interpolation of `image(index)` over a square of `side` texels.
fn bilinear(u: f64, v: f64, side: usize, image: impl Fn(usize) -> f64) -> f64 {
    let (x, y) = (u * side as f64 - 0.5, v * side as f64 - 0.5);
    let (fx, fy) = (x - x.floor(), y - y.floor());
    let at = |dx: f64, dy: f64| image(clamped(x.floor() + dx, y.floor() + dy, side));
    let top = at(0.0, 0.0) * (1.0 - fx) + at(1.0, 0.0) * fx;
    let bottom = at(0.0, 1.0) * (1.0 - fx) + at(1.0, 1.0) * fx;
    top * (1.0 - fy) + bottom * fy
}

type Comparison = (&'static str, fn(&Gpu));

/// What is compared.
const COMPARISONS: &[Comparison] = &[
    ("esm encodes and bounds", basis::esm_encodes_and_bounds),
    ("esm of logarithms", basis::esm_of_logarithms),
    ("esm's Z-Max misses nothing that Threshold finds", classes::zmax_misses_nothing),
    ("vsm encodes", basis::vsm_encodes),
    ("vsm and chebyshev bound", basis::vsm_and_chebyshev_bound),
    ("evsm encodes and bounds", basis::evsm_encodes_and_bounds),
    ("msm encodes and bounds", basis::msm_encodes_and_bounds),
    ("lvsm encodes and bounds", basis::lvsm_encodes_and_bounds),
    ("csm sums its series", basis::csm_sums_its_series),
    ("raster depth is linearised", receiver::raster_depth_is_linearised),
    ("raster depth is cleaned", receiver::raster_depth_is_cleaned),
    ("six spots are a point light", receiver::six_spots_are_a_point_light),
    ("receivers are projected", receiver::receivers_are_projected),
    ("receiver planes are solved", receiver::receiver_planes_are_solved),
    ("steeper planes are followed", receiver::steeper_planes_are_followed),
    ("pcf is a weighted sum", comparison::pcf_is_a_weighted_sum),
    ("taps agree", comparison::taps_agree),
    ("merged taps follow the plane", comparison::merged_taps_follow_the_plane),
    ("bicubic is a convolution", comparison::bicubic_is_a_convolution),
    ("poisson is the mean of its disk", comparison::poisson_is_the_mean_of_its_disk),
    ("footprint is the mean of its pixel", comparison::footprint_is_the_mean_of_its_pixel),
    ("packed encodes", stored::packed_encodes),
    ("packed is the mean around a corner", stored::packed_is_the_mean_around_a_corner),
    ("stratified is the mean of its samples", stored::stratified_is_the_mean_of_its_samples),
    ("precision rounds the map", stored::precision_rounds_the_map),
    ("lookups interpolate", lookups::lookups_interpolate),
    ("logarithms are interpolated as powers", lookups::logarithms_interpolate_as_powers),
    ("words add up", lookups::words_add_up),
    ("sums are means over boxes", lookups::sums_are_means_over_boxes),
    ("sums at 2048² are exact", lookups::sums_are_exact_at_2048),
    ("triangles survive packing", geometry::triangles_survive_packing),
    ("slopes are quantised as published", geometry::slopes_are_quantised),
    ("spsm intersects (Algorithm 1)", geometry::spsm_intersects),
    ("rgsm meets stored triangles", geometry::rgsm_meets_stored_triangles),
    ("spsm finds consistent least depths", geometry::spsm_finds_least_depths),
    ("spsm's table of tangents", geometry::spsm_tangents),
    ("splines weigh centres", geometry::splines_weigh_centres),
    ("every touched texel is drawn", geometry::every_touched_texel_is_drawn),
    ("lists hold all triangles", lists::lists_hold_all_triangles),
    ("split buffers answer the same", split::split_buffers_answer_the_same),
    ("lists beyond the capacity are cut", lists::lists_beyond_the_capacity_are_cut),
    ("lists tell their memory", lists::lists_tell_their_memory),
    ("the first triangles are kept", ranked::the_first_are_kept),
    ("triangles beyond the capacity are left out", ranked::triangles_beyond_the_capacity_are_left_out),
    ("keys keep what they are of", ranked::keys_keep_what_they_are_of),
    ("mirrored objects show their other side", ranked::mirrored_objects_show_their_other_side),
    ("centres have their depth", ranked::centres_have_their_depth),
    ("exact intersects", lists::exact_intersects),
    ("records keep every bit", lists::records_keep_every_bit),
    ("long thin triangles are met", lists::thin_triangles_are_met),
    ("silhouettes of fine meshes are recovered", silhouettes::fine_meshes),
    ("steep triangles stay behind", silhouettes::steep_triangles_stay_behind),
    ("sheets count among closed casters", silhouettes::sheets_count_among_closed_casters),
    ("edges of large triangles are smooth", silhouettes::edges_are_smooth),
    ("holes of cut-outs stay open", silhouettes::holes_stay_open),
    ("draws come in any order", silhouettes::draws_come_in_any_order),
    ("triangles that reach behind a spot are cut", geometry::triangles_behind_a_spot_are_cut),
];

fn main() {
    let mut trials = Trials::default();
    trials.add_plain("every encode function is compared", || {
        let device = Capabilities::least();
        for technique in technique::all() {
            for map in technique.describe(&device).unwrap().maps {
                let (Encode::Texel(name) | Encode::Neighbours(name)) = map.encode else {
                    panic!("teach this test {:?}", map.encode)
                };
                assert!(ENCODE_FUNCTIONS.contains(&name), "compare {name} here");
            }
        }
    });
    for (name, compared) in COMPARISONS {
        trials.add(*name, *compared);
    }
    trials.run();
}
