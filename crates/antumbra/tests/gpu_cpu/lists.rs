//! Lists of all triangles: what is counted, given room and entered; intersection.

use super::{INPUTS, Row, geometry::overlaps, row, rows, run};
use antumbra::{
    Capacity, CasterPass, Exact, Lifetime, Options, ShadowMap, Size, Technique, View, technique::exact,
};
use antumbra_testing::Gpu;
use antumbra_testing::ask::{Random, caster_mesh, compute, view};
use glam::{DVec2, Mat4, Vec2, Vec3};
use std::collections::BTreeSet;

pub(super) const MAP: Size = Size { width: 48, height: 32 };
pub(super) const TEXELS: usize = 48 * 32;
/// Triangles of two meshes, the second drawn in two parts.
const MESHES: [u32; 2] = [90, 150];
pub(super) const TRIANGLES: u32 = MESHES[0] + MESHES[1];
/// Enough for all of them.
pub(super) const ALL: Capacity = Capacity { triangles: TRIANGLES, triangles_per_texel: 40 };
/// Most entries of a texel that are read.
const MOST: usize = 96;

/// Triangles of many sizes, some beside the map.
pub(super) fn soup(random: &mut Random) -> Vec<[Vec3; 3]> {
    let mut triangle = || {
        let size = 10f32.powf(random.range(-1.7, 0.3));
        let middle = Vec2::new(random.range(-1.1, 1.1), random.range(-1.1, 1.1));
        std::array::from_fn(|_| {
            let away = size * Vec2::new(random.range(-1.0, 1.0), random.range(-1.0, 1.0));
            (middle + away).extend(random.range(0.1, 0.9))
        })
    };
    (0..TRIANGLES).map(|_| triangle()).collect()
}

/// The view of the tests, and the same seen in a mirror.
pub(super) fn views() -> [View; 2] {
    let plain = view(MAP);
    [plain, View { clip_from_world: Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0)), ..plain }]
}

pub(super) fn drawn(
    gpu: &Gpu,
    technique: &dyn Technique,
    capacity: Capacity,
    triangles: &[[Vec3; 3]],
) -> ShadowMap {
    let options = Options::from(MAP).views(2).capacity(capacity);
    let mut shadows = ShadowMap::new(&gpu.device, technique, options).unwrap();
    shadows.prepare(&gpu.queue, &views()).unwrap();
    let (first, second) = triangles.as_flattened().split_at(3 * MESHES[0] as usize);
    let meshes = [first, second].map(|corners| caster_mesh(gpu, corners));
    // Twice: nothing of the first time may be left.
    for _ in 0..2 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let draw = |pass: &mut CasterPass<'_>| {
            pass.draw_mesh(&meshes[0], ..);
            pass.draw_mesh(&meshes[1], ..40);
            pass.draw_mesh(&meshes[1], 40..);
        };
        shadows.encode(&mut encoder, draw).unwrap();
        gpu.queue.submit([encoder.finish()]);
    }
    shadows
}

/// Of every texel of a view where its list begins and ends, and its entries: numbers and corners.
struct Found {
    ranges: Vec<[u32; 2]>,
    numbers: Vec<Vec<u32>>,
    corners: Vec<[Vec3; 3]>,
}

fn found(gpu: &Gpu, shadows: &ShadowMap, view: u32) -> Found {
    let user = format!(
        "@group(1) @binding(0) var<storage, read> unused: array<f32>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        fn keep(p: vec3f) -> f32 {{ return shadow_visibility(p, p, p, p) + unused[0]; }}
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
            let size = vec2u(tile_size(0u));
            if id.x >= size.x * size.y + {TRIANGLES}u {{ return; }}
            let me = id.x * {stride}u;
            if id.x >= size.x * size.y {{
                let n = id.x - size.x * size.y;
                for (var k = 0u; k < 9u; k += 1u) {{
                    results[me + k] = shadow_corner({view}u, n, k / 3u)[k % 3u];
                }}
                return;
            }}
            let texel = vec2i(vec2u(id.x % size.x, id.x / size.x));
            let list = shadow_list({view}u, texel);
            let start = list.x;
            let end = list.y;
            results[me] = f32(start);
            results[me + 1u] = f32(end);
            for (var i = start; i < min(end, start + {MOST}u); i += 1u) {{
                let n = shadow_entry({view}u, i);
                results[me + 2u + i - start] = f32(n);
            }}
        }}",
        stride = MOST + 2,
    );
    let count = TEXELS + TRIANGLES as usize;
    let flat = compute(gpu, shadows, &user, &[0; 16], count * (MOST + 2), count);
    let (texels, corners) = flat.split_at(TEXELS * (MOST + 2));
    let ranges = texels.chunks_exact(MOST + 2).map(|t| [t[0] as u32, t[1] as u32]).collect();
    let entries = |t: &[f32]| {
        let length = (t[1] - t[0]) as usize;
        assert!(length <= MOST, "{length} entries");
        t[2..2 + length].iter().map(|n| *n as u32).collect()
    };
    let corners = corners.chunks_exact(MOST + 2);
    Found {
        ranges,
        numbers: texels.chunks_exact(MOST + 2).map(entries).collect(),
        corners: corners
            .map(|c| [0, 1, 2].map(|k| Vec3::new(c[3 * k], c[3 * k + 1], c[3 * k + 2])))
            .collect(),
    }
}

/// The triangles in texels of a view, depth in z.
pub(super) fn on_map(view: &View, triangles: &[[Vec3; 3]]) -> Vec<[Vec3; 3]> {
    let texels = |p: Vec3| {
        let clip = view.clip_from_world.transform_point3(p);
        let uv = Vec2::new(0.5, -0.5) * clip.truncate() + 0.5;
        (uv * Vec2::new(MAP.width as f32, MAP.height as f32)).extend(clip.z)
    };
    triangles.iter().map(|t| t.map(texels)).collect()
}

/// Numbers of the triangles that overlap the square of half side `half` around a texel's centre.
pub(super) fn overlapping(triangles: &[[Vec3; 3]], texel: usize, half: f64) -> BTreeSet<u32> {
    let centre = DVec2::new((texel % 48) as f64 + 0.5, (texel / 48) as f64 + 0.5);
    let flat = |t: &[Vec3; 3]| t.map(|p| p.truncate().as_dvec2());
    let hit = |(n, t): (u32, &[Vec3; 3])| overlaps(&flat(t), centre, half).then_some(n);
    (0..).zip(triangles).filter_map(hit).collect()
}

/// Totals of both views.
fn totals(gpu: &Gpu, shadows: &ShadowMap) -> Vec<u32> {
    let bytes = gpu.read_buffer(shadows.abuffer_totals().unwrap());
    bytes.chunks_exact(4).map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect()
}

/// Every texel lists every triangle that touches it, once, and none that is a thousandth of a texel away;
/// lists lie behind one another without gaps; numbers lead to the triangles' corners.
pub(crate) fn lists_hold_all_triangles(gpu: &Gpu) {
    let triangles = soup(&mut Random::new(31));
    let shadows = drawn(gpu, &Exact, ALL, &triangles);
    for (index, view) in (0..).zip(&views()) {
        let placed = on_map(view, &triangles);
        let Found { mut ranges, numbers, corners } = found(gpu, &shadows, index);
        let mut longest = 0;
        for (texel, list) in numbers.iter().enumerate() {
            let held: BTreeSet<u32> = list.iter().copied().collect();
            assert_eq!(held.len(), list.len(), "a triangle is listed twice: {list:?}");
            assert!(overlapping(&placed, texel, 0.5).is_subset(&held), "texel {texel}: {held:?}");
            assert!(held.is_subset(&overlapping(&placed, texel, 0.501)), "texel {texel}: {held:?}");
            longest = longest.max(list.len());
        }
        assert!(longest > 12, "{longest}");
        // A rasteriser that asks centres would miss many.
        let missed = |texel: &usize| overlapping(&placed, *texel, 0.0).len() < numbers[*texel].len();
        assert!((0..TEXELS).filter(missed).count() > TEXELS / 2);
        ranges.sort_unstable();
        assert!(ranges.windows(2).all(|pair| pair[0][1] == pair[1][0]), "lists overlap or leave gaps");
        assert_eq!(ranges[0][0], 0);
        let total: usize = numbers.iter().map(Vec::len).sum();
        assert_eq!(totals(gpu, &shadows)[2 * index as usize..][..2], [total as u32, longest as u32]);
        let same = |found: &[Vec3; 3], expected: &[Vec3; 3]| {
            expected.iter().all(|p| found.iter().any(|q| p.distance(*q) < 1e-4))
        };
        let listed: BTreeSet<u32> = numbers.concat().into_iter().collect();
        assert!(listed.len() > TRIANGLES as usize / 2);
        let right = |shift: usize| {
            let right =
                |n: &&u32| same(&corners[**n as usize], &placed[(**n as usize + shift) % placed.len()]);
            listed.iter().filter(right).count()
        };
        assert_eq!(right(0), listed.len());
        assert!(right(1) < 3, "{} of the next number", right(1));
    }
}

/// What exceeds the capacity is left out and told; nothing else is written.
pub(crate) fn lists_beyond_the_capacity_are_cut(gpu: &Gpu) {
    let triangles = soup(&mut Random::new(32));
    let whole = drawn(gpu, &Exact, ALL, &triangles);
    let needed = totals(gpu, &whole);
    let cut = drawn(gpu, &Exact, Capacity { triangles_per_texel: 2, ..ALL }, &triangles);
    assert_eq!(totals(gpu, &cut), needed);
    let most = 2 * TEXELS as u32;
    assert!(needed[0] > 2 * most, "{needed:?}");
    for view in [0, 1] {
        let [full, few] = [&whole, &cut].map(|shadows| found(gpu, shadows, view));
        assert!(few.ranges.iter().all(|[start, end]| start <= end && *end <= most));
        let held: usize = few.numbers.iter().map(Vec::len).sum();
        assert_eq!(held as u32, most);
        for (few, full) in few.numbers.iter().zip(&full.numbers) {
            let full: BTreeSet<u32> = full.iter().copied().collect();
            assert!(few.iter().all(|n| full.contains(n)), "{few:?} of {full:?}");
        }
    }
    let fewer = drawn(gpu, &Exact, Capacity { triangles: 50, ..ALL }, &triangles);
    assert!(found(gpu, &fewer, 0).numbers.concat().iter().all(|n| *n < 50));
    assert!(totals(gpu, &fewer)[0] < needed[0]);
    assert_eq!(fewer.triangles_drawn(), TRIANGLES);
}

pub(crate) fn lists_tell_their_memory(gpu: &Gpu) {
    let options = Options::from(MAP).views(2).capacity(Capacity { triangles: 3000, ..Capacity::default() });
    let shadows = ShadowMap::new(&gpu.device, &Exact, options).unwrap();
    let memory = shadows.memory();
    let bytes = |name: &str| memory.items.iter().find(|i| i.name == name).map_or(0, |i| i.bytes);
    let texels = TEXELS as u64;
    assert_eq!(bytes("A-buffer ranges"), 2 * 8 * texels);
    assert_eq!(bytes("A-buffer ids"), 2 * 4 * (6 * texels).next_multiple_of(2048));
    assert_eq!(bytes("A-buffer vertices"), 2 * 48 * 3000);
    assert_eq!(bytes("A-buffer counts"), 4 * texels);
    let counts = memory.items.iter().find(|i| i.name == "A-buffer counts").unwrap();
    assert_eq!(counts.lifetime, Lifetime::Transient);
    assert!(shadows.explain().join("\n").contains("6 per texel, of 3000"), "{:?}", shadows.explain());
}

/// A triangle around the receiver or not, in texels; its corners' depths.
fn around(r: &mut Random) -> Row {
    row(std::array::from_fn::<f32, 9, _>(|i| if i % 3 == 2 { r.unit() } else { r.range(-1.0, 1.0) }))
}

pub(crate) fn exact_intersects(gpu: &Gpu) {
    let rows = rows(33, around);
    let shadows = ShadowMap::new(&gpu.device, &Exact, MAP).unwrap();
    let found = run::<1>(gpu, &shadows, "put(0u, ray_depth(take3(0u), take3(3u), take3(6u)));", &rows);
    let depth = |r: &[f64; INPUTS], at: [f64; 2]| {
        let corners = [0, 1, 2].map(|k| [r[3 * k], r[3 * k + 1], r[3 * k + 2]]);
        exact::reference::depth(corners, at).min(1e30)
    };
    // Rays that all but touch an edge may go either way.
    let clear = |r: &&(Row, [f32; 1])| {
        let r = r.0.map(f64::from);
        [-1.0, 1.0].iter().all(|x| {
            let near = [[1e-5 * x, 1e-5], [1e-5 * x, -1e-5]];
            near.iter().all(|at| (depth(&r, *at) > 1e29) == (depth(&r, [0.0; 2]) > 1e29))
        })
    };
    let pairs: Vec<(Row, [f32; 1])> = rows.into_iter().zip(found).collect();
    let (rows, found): (Vec<Row>, Vec<[f32; 1]>) = pairs.iter().filter(clear).copied().unzip();
    assert!(found.iter().filter(|f| f[0] < 1.0).count() > 500);
    let close = |a: f64, b: f64| if b > 1e29 { a > 1e29 } else { (a - b).abs() < 2e-3 };
    let wrong = |at: [f64; 2]| {
        let pairs = rows.iter().zip(&found);
        pairs.filter(|(r, f)| !close(f64::from(f[0]), depth(&r.map(f64::from), at))).count()
    };
    assert_eq!(wrong([0.0; 2]), 0);
    assert!(wrong([0.05, 0.0]) > 500, "{}", wrong([0.05, 0.0]));
}

/// A triangle with an edge of some `length` in any direction and the third corner `width` above the place
/// `opposite` along it, seen from a receiver at `place` along and `inside` up, all three 0 to 1. It gains as
/// much depth along its length as across.
fn sliver(r: &mut Random, [length, width]: [f64; 2], opposite: f64, [place, inside]: [f64; 2]) -> Row {
    let along = DVec2::from_angle(f64::from(r.range(0.0, std::f32::consts::TAU)));
    let corners = [[0.0, 0.0], [1.0, 0.0], [opposite, 1.0]]
        .map(|[x, y]| ((x - place) * length * along + (y - inside) * width * along.perp()).as_vec2());
    let start = (r.unit() * 3.0) as usize;
    let ends = [r.unit(), r.unit()];
    let apex = ends[0] + opposite as f32 * (ends[1] - ends[0]) + r.range(-1.0, 1.0) * (width / length) as f32;
    let depths = [ends[0], ends[1], apex];
    let mut row = [0.0; INPUTS];
    for (k, corner) in corners.iter().enumerate() {
        let at = 3 * ((k + start) % 3);
        row[at..at + 3].copy_from_slice(&[corner.x, corner.y, depths[k]]);
    }
    row
}

/// A long thin triangle around the receiver, thousandths of a texel to one wide.
fn thin(r: &mut Random) -> Row {
    let size = [f64::from(r.range(50.0, 800.0)), 10f64.powf(f64::from(r.range(-2.7, 0.0)))];
    // Where the opposite corner is along the longest edge, and the receiver between the three.
    let opposite = f64::from(r.range(0.05, 0.95));
    let inside = f64::from(r.range(0.2, 0.8));
    let place = inside * opposite + (1.0 - inside) * f64::from(r.range(0.1, 0.9));
    sliver(r, size, opposite, [place, inside])
}

/// Half of a rail's side that reaches far beyond the map, thousands of texels long and some wide: its longest edge
/// is the diagonal, and the receiver is beside the edge to the next side.
fn rail(r: &mut Random) -> Row {
    let size = [f64::from(r.range(4000.0, 20_000.0)), f64::from(r.range(0.5, 10.0))];
    let inside = 10f64.powf(f64::from(r.range(-5.0, -3.0)));
    let opposite = f64::from(r.unit().round());
    let place = f64::from(r.range(0.2, 0.8));
    sliver(r, size, opposite, [place, inside])
}

/// Depths of long thin triangles, and what their planes gain per texel, are as right as the corners: floats
/// place these, some hundred texels from the receiver, to within 5·10⁻⁵ of a texel, and some thousand away to
/// within 10⁻³.
pub(crate) fn thin_triangles_are_met(gpu: &Gpu) {
    let shadows = ShadowMap::new(&gpu.device, &Exact, MAP).unwrap();
    let body = "
        let a = take3(0u);
        let b = take3(3u);
        let c = take3(6u);
        put(0u, ray_depth(a, b, c));
        let areas = vec3f(ray_area(b, c), ray_area(c, a), ray_area(a, b));
        put(1u, dot(areas, vec3f(a.z, b.z, c.z)) / (areas.x + areas.y + areas.z));";
    for (rows, texels) in [(rows(40, thin), 2e-4), (rows(42, rail), 4e-3)] {
        let depth = |r: &Row| {
            exact::reference::depth([0, 1, 2].map(|k| [0, 1, 2].map(|i| f64::from(r[3 * k + i]))), [0.0; 2])
        };
        let found = run::<2>(gpu, &shadows, body, &rows);
        // Rays that all but touch an edge may miss.
        let met = |(r, f): &(Row, [f32; 2])| depth(r).is_finite() && f[0] < 1e29;
        let (rows, found): (Vec<Row>, Vec<_>) = rows.into_iter().zip(found).filter(met).unzip();
        assert!(rows.len() > 300, "{} are met", rows.len());
        let wrong = |which: usize| {
            let off = |r: &Row, found: f32| {
                let [a, b, c] = [0, 1, 2].map(|k| [0, 1, 2].map(|i| f64::from(r[3 * k + i])));
                let [p, q] = [[b, a], [c, a]].map(|[q, p]| [0, 1, 2].map(|i| q[i] - p[i]));
                let area = p[0] * q[1] - p[1] * q[0];
                let gain = DVec2::new(p[2] * q[1] - q[2] * p[1], q[2] * p[0] - p[2] * q[0]) / area;
                (f64::from(found) - depth(r)).abs() > 2e-6 + texels * gain.length()
            };
            rows.iter().zip(&found).filter(|(r, f)| off(r, f[which])).count()
        };
        assert_eq!(wrong(0), 0);
        assert!(wrong(1) > 50, "areas alone: {}", wrong(1));
    }
}

/// Ids and tags come back, whatever their 32 bits.
pub(crate) fn records_keep_every_bit(gpu: &Gpu) {
    let half = |r: &mut Random| if r.unit() < 0.3 { 65535.0 } else { (r.unit() * 65535.0).floor() };
    let rows = rows(41, |r| row([half(r), half(r), half(r), half(r)]));
    let shadows = ShadowMap::new(&gpu.device, &Exact, Options::from(MAP).cutouts(true)).unwrap();
    let body = "
        let given = vec2u((u32(take(0u)) << 16u) | u32(take(1u)), (u32(take(2u)) << 16u) | u32(take(3u)));
        let words = record_packed(given.x, given.y);
        let found = record_unpacked(words);
        put4(0u, vec4f(vec4u(found.x >> 16u, found.x & 65535u, found.y >> 16u, found.y & 65535u)));
        put(4u, max(words.x, max(words.y, words.z)));
    }
    fn shadow_covers(tag: u32, triangle: u32, weights: vec3f) -> bool {
        return true;";
    for (row, found) in rows.iter().zip(run::<5>(gpu, &shadows, body, &rows)) {
        assert_eq!(found[..4], row[..4]);
        assert!(found[4] < 16_777_216.0, "{found:?}");
    }
}
