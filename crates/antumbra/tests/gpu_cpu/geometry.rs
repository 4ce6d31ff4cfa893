//! The geometry family: packing, quantisers, intersections, tangents, and what is rasterised.

use super::{INPUTS, Row, compare, compare_from, row, rows, run};
use antumbra::{
    Fit, Light, Options, Rgsm, ShadowMap, Size, Spsm, Technique, View, technique::rgsm, technique::spsm,
};
use antumbra_testing::Gpu;
use antumbra_testing::ask::{Random, caster_mesh, view};
use glam::{DVec2, Vec2, Vec3};

/// A shadow map that nothing was drawn to, for its functions.
fn functions(gpu: &Gpu, packing: spsm::Packing) -> ShadowMap {
    functions_of(gpu, &Spsm { packing, ..Spsm::default() })
}

fn functions_of(gpu: &Gpu, technique: &dyn Technique) -> ShadowMap {
    ShadowMap::new(&gpu.device, technique, Size::square(1024)).unwrap()
}

/// Three corners around the middle of a map of 1024² texels, at most four texels from it and no sliver;
/// then a point within one and a half texels, and two numbers.
fn triangle(r: &mut Random) -> Row {
    loop {
        let at: [Vec2; 3] = std::array::from_fn(|_| Vec2::new(r.range(-4.0, 4.0), r.range(-4.0, 4.0)));
        let area = (at[1] - at[0]).perp_dot(at[2] - at[0]);
        let deep = [r.range(0.2, 0.8), r.range(0.2, 0.8), r.range(0.2, 0.8)];
        let slope = (deep[0] - deep[1]).abs().max((deep[0] - deep[2]).abs()) / area;
        if area > 4.0 && slope < 0.1 {
            let [a, b, c] = at.map(|p| p + 512.5);
            return row([
                a.x,
                a.y,
                deep[0],
                b.x,
                b.y,
                deep[1],
                c.x,
                c.y,
                deep[2],
                r.range(-1.5, 1.5),
                r.range(-1.5, 1.5),
                r.unit(),
                r.range(-1.0, 1.0),
                r.range(-1.0, 1.0),
            ]);
        }
    }
}

/// Packs the triangle of a row for the texel around (512.5, 512.5).
const PACK: &str = "
    var corners = mat3x3f(take3(0u), take3(3u), take3(6u));
    let size = vec2f(1024.0);
    let centre = vec2f(512.5);
    let slope = coverage_slope(corners);
    let lines = coverage_lines(corners);
    let distances = vec3f(dot(lines[0].xy, centre) + lines[0].z, dot(lines[1].xy, centre) + lines[1].z, dot(lines[2].xy, centre) + lines[2].z);
    let at_centre = corners[0].z + dot(slope, centre - corners[0].xy);
    let half_words = packing_triangle(corners, slope * size);
    let decoded = packing_slope(half_words) / size;
    let texel_words = packing_texel(half_words, corners, distances, centre, size, vec3f(0.0, 0.0, at_centre), decoded, false);
    // Some drivers leave out packing that is undone at once: zero that they do not know.
    let words = texel_words ^ vec4u(u32(take(15u)));
    let point = take2(9u);
    let found = packing_lines(words, centre, size);
";

fn corners(r: &[f64; INPUTS]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|k| [r[3 * k], r[3 * k + 1], r[3 * k + 2]])
}

/// Distances of a point from the edges opposite each corner, positive outside, in which a texel's edge is
/// half a texel from its centre.
fn distances(r: &[f64; INPUTS]) -> [f64; 3] {
    let c = corners(r).map(|c| DVec2::new(c[0], c[1]));
    let p = DVec2::new(512.5 + r[9], 512.5 + r[10]);
    [0, 1, 2].map(|k| {
        let (a, b) = (c[(k + 1) % 3], c[(k + 2) % 3]);
        let along = b - a;
        -along.perp_dot(p - a) / along.abs().element_sum()
    })
}

/// Edges in reach: within a thousandth of a texel as edges, one over 2¹⁰ of four texels as floats, an
/// eighth of a texel over the map at 1024².
pub(crate) fn triangles_survive_packing(gpu: &Gpu) {
    use spsm::Packing;
    let body = format!(
        "{PACK}
        let at = vec3f(point, 1.0);
        put3(0u, vec3f(dot(found[0], at), dot(found[1], at), dot(found[2], at)));
        put(3u, f32(packing_holds(words)));"
    );
    // Where an edge passes far from the texel its distance is not kept.
    let near = |r: &Row| {
        let here = distances(&std::array::from_fn(|i| if i == 9 || i == 10 { 0.0 } else { f64::from(r[i]) }));
        here.iter().all(|d| *d > -1.95 && *d < 0.59)
    };
    let rows: Vec<Row> = rows(21, triangle).into_iter().filter(near).collect();
    assert!(rows.len() > 100, "{}", rows.len());
    for (packing, tolerance) in [(Packing::Edges, 2e-3), (Packing::Texel, 6e-3), (Packing::Map, 0.15)] {
        let found = run::<4>(gpu, &functions(gpu, packing), &body, &rows);
        let expected = |tolerance: f64| move |r: &[f64; INPUTS]| (distances(r), tolerance);
        compare::<4, 3>(&rows, &found, expected(tolerance)).unwrap();
        compare::<4, 3>(&rows, &found, expected(tolerance / 100.0)).unwrap_err();
        assert!(found.iter().all(|f| f[3] == 1.0));
    }
}

pub(crate) fn slopes_are_quantised(gpu: &Gpu) {
    let rows = rows(22, |r| row([(r.range(-1.55, 1.55)).tan(), r.unit()]));
    let body = "
        let level = quantizer_encode(take2(0u));
        put(0u, f32(level.x));
        put(1u, quantizer_decode(vec2f(level)).x);";
    let found = run::<2>(gpu, &functions(gpu, spsm::Packing::Map), body, &rows);
    let level = |scale: f64| move |r: &[f64; INPUTS]| ([spsm::reference::quantize(scale * r[0], 5)], 0.51);
    compare(&rows, &found, level(1.0)).unwrap();
    compare(&rows, &found, level(-1.0)).unwrap_err();
    // Half a level either way, and the driver's arc tangent.
    let decoded = |r: &[f64; INPUTS]| {
        let exact = spsm::reference::quantize(r[0], 5).round();
        let slope = spsm::reference::dequantize(exact, 5);
        let step = spsm::reference::dequantize((exact + 1.0).min(253.9), 5) - slope;
        ([slope], 1e-3 + 0.02 * slope.abs() + if (1.0..=253.0).contains(&exact) { step.abs() } else { 1e3 })
    };
    compare_from(1, &rows, &found, decoded).unwrap();
    compare_from(1, &rows, &found, |r| ([-decoded(r).0[0]], decoded(r).1)).unwrap_err();
}

/// All but points so near to an edge or to the plane that packing decides: half a level of slope, for
/// the benefit of the doubt, is up to a hundredth of the depth range here.
pub(crate) fn spsm_intersects(gpu: &Gpu) {
    let rows = rows(23, triangle);
    let body =
        format!("{PACK} put(0u, f32(spsm_intersects(words, centre, centre + point, take(11u), size)));");
    let found = run::<1>(gpu, &functions(gpu, spsm::Packing::Edges), &body, &rows);
    let wrong = |flip: bool| {
        let differs = |(r, f): (&Row, &[f32; 1])| {
            let r = r.map(f64::from);
            let point = [512.5 + r[9], 512.5 + r[10]];
            let depth = if flip { 1.0 - r[11] } else { r[11] };
            let behind = |more: f64| spsm::reference::intersects(corners(&r), point, depth + more);
            // Only texels that a triangle touches hold it.
            let at_centre = distances(&std::array::from_fn(|i| if i == 9 || i == 10 { 0.0 } else { r[i] }));
            let touches = at_centre.iter().all(|d| *d < 0.5);
            let clear =
                touches && distances(&r).iter().all(|d| d.abs() > 3e-3) && behind(-0.02) == behind(0.02);
            clear && (f[0] == 1.0) != behind(0.0)
        };
        rows.iter().zip(&found).filter(|pair| differs(*pair)).count()
    };
    let hits = found.iter().filter(|f| f[0] == 1.0).count();
    assert!(hits > 200, "{hits} of {} intersect", rows.len());
    assert_eq!(wrong(false), 0, "of {}", rows.len());
    assert!(wrong(true) > 200, "{}", wrong(true));
}

/// Likewise; of triangles that cover the centre, since others are not stored.
pub(crate) fn rgsm_meets_stored_triangles(gpu: &Gpu) {
    let covers_centre = |r: &Row| {
        let r: [f64; INPUTS] = std::array::from_fn(|i| if i == 9 || i == 10 { 0.0 } else { f64::from(r[i]) });
        distances(&r).iter().all(|d| *d < 0.0)
    };
    let rows: Vec<Row> = rows(27, triangle).into_iter().filter(covers_centre).collect();
    let body = format!(
        "{PACK}
        put(0u, f32(rgsm_meets(words, centre, point, size)));
        put(1u, f32(rgsm_before(words, point, take(11u), size)));"
    );
    let found = run::<2>(gpu, &functions_of(gpu, &Rgsm::default()), &body, &rows);
    let wrong = |flip: bool| {
        let differs = |(r, f): (&Row, &[f32; 2])| {
            let r = r.map(f64::from);
            let point = [512.5 + r[9], 512.5 + r[10]];
            let depth = if flip { 1.0 - r[11] } else { r[11] };
            let before = |more: f64| rgsm::reference::before(corners(&r), point, depth + more);
            let found = (f[0] == 1.0).then_some(f[1] == 1.0);
            let clear = distances(&r).iter().all(|d| d.abs() > 3e-3) && before(-0.02) == before(0.02);
            clear && found != before(0.0)
        };
        rows.iter().zip(&found).filter(|pair| differs(*pair)).count()
    };
    let met = found.iter().filter(|f| f[0] == 1.0).count();
    assert!(met > 200 && rows.len() > met + 50, "{met} of {} are met", rows.len());
    assert_eq!(wrong(false), 0, "of {}", rows.len());
    assert!(wrong(true) > 50, "{}", wrong(true));
}

pub(crate) fn spsm_finds_least_depths(gpu: &Gpu) {
    let rows = rows(24, triangle);
    // Without packing: lines from corners, in f32.
    let body = "
        let centre = vec3f(512.5, 512.5, 0.0);
        let corners = mat3x3f(take3(0u) - centre, take3(3u) - centre, take3(6u) - centre);
        put(0u, spsm_least(coverage_lines(corners), vec3f(take2(12u), take(11u))));";
    let found = run::<1>(gpu, &functions(gpu, spsm::Packing::Edges), body, &rows);
    let least = |r: &[f64; INPUTS], sign: f64| {
        let around = corners(r).map(|c| [c[0] - 512.5, c[1] - 512.5]);
        spsm::reference::least(around, [sign * r[12], sign * r[13], r[11]])
    };
    // Triangles that only just reach the texel may count or not.
    let wrong = |sign: f64| {
        let differs = |(r, f): (&Row, &[f32; 1])| {
            let expected = least(&r.map(f64::from), sign);
            if expected.is_finite() { (f64::from(f[0]) - expected).abs() > 2e-3 } else { f[0] < 1e29 }
        };
        rows.iter().zip(&found).filter(|pair| differs(*pair)).count()
    };
    assert!(wrong(1.0) < 10, "{} of {} differ", wrong(1.0), rows.len());
    assert!(wrong(-1.0) > 1000, "{}", wrong(-1.0));
}

/// Tangents are reckoned as the reference does, for all 256 patterns, and the k-th neighbour lies in the k-th direction.
pub(crate) fn spsm_tangents(gpu: &Gpu) {
    let rows: Vec<Row> = (0..256).map(|i| row([i as f32])).collect();
    let body = "
        let entry = spsm_tangents(u32(take(0u)));
        put(0u, f32(entry & 65535u));
        put(1u, f32(entry >> 16u));
        put2(2u, vec2f(spsm_neighbour(u32(take(0u)) % 8u)));";
    let found = run::<4>(gpu, &functions_of(gpu, &Spsm::PUBLISHED), body, &rows);
    let entry = |shift: u32| {
        move |r: &[f64; INPUTS]| {
            let pattern = (r[0] as u32 + shift) % 256;
            let entry = spsm::reference::tangents(pattern);
            let angle = std::f64::consts::FRAC_PI_4 * f64::from(pattern % 8);
            let low = f64::from(entry & 65535);
            ([low, f64::from(entry >> 16), angle.cos().round(), angle.sin().round()], 0.0)
        }
    };
    compare(&rows, &found, entry(0)).unwrap();
    compare(&rows, &found, entry(1)).unwrap_err();
}

/// Quadratic B-spline, on places up to two texels away.
pub(crate) fn splines_weigh_centres(gpu: &Gpu) {
    let rows = rows(31, |r| row([r.range(-2.0, 2.0), r.range(-2.0, 2.0)]));
    let found =
        run::<1>(gpu, &functions(gpu, spsm::Packing::Edges), "put(0u, spline_weight(take2(0u)));", &rows);
    let weight =
        |scale: f64| move |r: &[f64; INPUTS]| ([spsm::reference::weight([scale * r[0], r[1]])], 1e-6);
    compare(&rows, &found, weight(1.0)).unwrap();
    compare(&rows, &found, weight(0.99)).unwrap_err();
}

/// Whether a triangle overlaps the square of half side `half` around a centre: separating axes.
pub(crate) fn overlaps(triangle: &[DVec2; 3], centre: DVec2, half: f64) -> bool {
    let beside = |axis: DVec2, reach: f64| {
        let along = triangle.map(|p| axis.dot(p - centre));
        let (low, high) = (along[0].min(along[1]).min(along[2]), along[0].max(along[1]).max(along[2]));
        low > reach || high < -reach
    };
    let edge = |k: usize| (triangle[(k + 1) % 3] - triangle[k]).perp();
    let parted = |axis: DVec2| beside(axis, half * (axis.x.abs() + axis.y.abs()));
    ![DVec2::X, DVec2::Y, edge(0), edge(1), edge(2)].into_iter().any(parted)
}

/// Texels across of the map that triangles are drawn to, and of the cell that each has to itself.
const SIDE: u32 = 1024;
const CELL: u32 = 16;

/// Random triangles of one kind, one per cell, in texels.
fn field(kind: &str, random: &mut Random) -> Vec<[Vec2; 3]> {
    let cells = SIDE / CELL;
    let place = |i: u32| Vec2::new((i % cells) as f32, (i / cells) as f32) * CELL as f32 + 1.5;
    let room = CELL as f32 - 3.0;
    (0..cells * cells)
        .map(|i| {
            let mut point = |reach: f32| Vec2::new(random.range(0.0, reach), random.range(0.0, reach));
            let [a, b] = [point(room), point(room)];
            let corners = match kind {
                "sliver" => [a, b, a.lerp(b, 0.4) + 0.01 * (point(1.0) - 0.5)],
                "small" => [a, a + 0.5 * point(0.6), a + 0.5 * point(0.6)].map(|p| p.min(Vec2::splat(room))),
                "aligned" => [a.round(), Vec2::new(a.x.round(), b.y.round()), b.round()],
                _ => [a, b, point(room)],
            };
            corners.map(|p| place(i) + p)
        })
        .collect()
}

/// Whether each texel of each layer of the map holds a triangle.
fn drawn(gpu: &Gpu, size: Size, views: &[View], triangles: &[Vec3]) -> Vec<Vec<bool>> {
    let options = Options::from(size).views(views.len() as u32);
    let mut shadows = ShadowMap::new(&gpu.device, &Spsm::default(), options).unwrap();
    shadows.prepare(&gpu.queue, views).unwrap();
    let mesh = caster_mesh(gpu, triangles);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    let map = shadows.map_texture(0).unwrap();
    let layer =
        |layer| gpu.read_texture(map, layer, 0).chunks_exact(16).map(|t| t.iter().any(|b| *b != 0)).collect();
    (0..map.depth_or_array_layers()).map(layer).collect()
}

/// Exact overlap against what is rasterised, for 10⁵ triangles: none missed, and none drawn where a
/// square larger by a thousandth of a texel is still apart from the triangle. The second layer, drawn
/// at centres as usual, must fail this.
pub(crate) fn every_touched_texel_is_drawn(gpu: &Gpu) {
    let mut random = Random::new(25);
    let kinds = ["any", "sliver", "small", "aligned"];
    for kind in kinds.iter().cycle().take(25) {
        let triangles = field(kind, &mut random);
        // What the shader sees: positions rounded to f32.
        let positions: Vec<Vec3> = triangles
            .iter()
            .flatten()
            .map(|p| Vec3::new(2.0 * p.x / SIDE as f32 - 1.0, 1.0 - 2.0 * p.y / SIDE as f32, 0.5))
            .collect();
        let texel = |p: &Vec3| {
            let p = p.as_dvec3();
            DVec2::new(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y) * f64::from(SIDE)
        };
        let exact: Vec<[DVec2; 3]> =
            positions.chunks_exact(3).map(|t| [texel(&t[0]), texel(&t[1]), texel(&t[2])]).collect();
        let size = Size::square(SIDE);
        let layers = drawn(gpu, size, &[view(size)], &positions);
        let (mut touched, mut missed, mut extra, mut missed_at_centres) = (0, 0, 0, 0);
        for y in 0..SIDE {
            for x in 0..SIDE {
                let cell = (y / CELL * (SIDE / CELL) + x / CELL) as usize;
                let triangle = &exact[cell];
                // A triangle as thin as coordinates are rounded covers nothing.
                let area = (triangle[1] - triangle[0]).perp_dot(triangle[2] - triangle[0]);
                let centre = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let [conservative, ordinary] = [0, 1].map(|layer| layers[layer][(y * SIDE + x) as usize]);
                let touches = area.abs() > 1e-3 && overlaps(triangle, centre, 0.5);
                touched += usize::from(touches);
                missed += usize::from(touches && !conservative);
                missed_at_centres += usize::from(touches && !ordinary);
                extra += usize::from(conservative && !overlaps(triangle, centre, 0.501));
            }
        }
        assert!(touched > 4000, "{kind}: {touched}");
        assert_eq!((missed, extra), (0, 0), "{kind}: missed and extra of {touched}");
        assert!(10 * missed_at_centres > touched, "{kind}: {missed_at_centres} of {touched}");
    }
}

/// Rays from the apex through texels' centres hit what was drawn there, also of triangles that reach
/// behind the light.
pub(crate) fn triangles_behind_a_spot_are_cut(gpu: &Gpu) {
    const MAP: Size = Size::square(32);
    let mut random = Random::new(26);
    let mut point = |reach: f32| Vec3::from_array(std::array::from_fn(|_| random.range(-reach, reach)));
    let light = Light::Spot { position: Vec3::ZERO, direction: Vec3::NEG_Z, outer_angle: 0.7 };
    let bounds = antumbra::Bounds { min: Vec3::splat(-4.0), max: Vec3::splat(4.0) };
    let fit = Fit {
        casters: bounds,
        receivers: bounds.corners().collect(),
        size: MAP,
        margin_texels: 0.0,
        lean: true,
    };
    let view = light.view(&fit).unwrap();
    let world_from_clip = view.clip_from_world.inverse();
    let (mut hits, mut cut, mut missed) = (0, 0, 0);
    for _ in 0..150 {
        let triangle = [point(4.0), point(4.0), point(4.0)];
        let crosses = triangle.iter().any(|p| p.z > 0.0) && triangle.iter().any(|p| p.z < 0.0);
        let layers = drawn(gpu, MAP, &[view], &triangle);
        for (i, there) in layers[0].iter().enumerate() {
            let (x, y) = ((i as u32 % MAP.width) as f32 + 0.5, (i as u32 / MAP.width) as f32 + 0.5);
            let ndc = Vec3::new(x / 16.0 - 1.0, 1.0 - y / 16.0, 0.5);
            let ray = world_from_clip.project_point3(ndc).as_dvec3().normalize();
            let [a, b, c] = triangle.map(|p| p.as_dvec3());
            let weights = [b.cross(c), c.cross(a), a.cross(b)].map(|n| n.dot(ray));
            let inside = weights.iter().all(|w| *w > 1e-6) || weights.iter().all(|w| *w < -1e-6);
            // All of one sign: the line is met; in front of the apex if the sign is the triangle's own.
            let volume = a.dot(b.cross(c));
            let hit = inside && volume * weights[0] > 0.0;
            let near = volume / weights.iter().sum::<f64>() < 0.05;
            if hit && !near {
                hits += 1;
                cut += usize::from(crosses);
                missed += usize::from(!there);
            }
        }
    }
    assert!(hits > 2000 && cut > 500, "{hits} hits, {cut} of triangles that reach behind");
    assert_eq!(missed, 0, "of {hits}");
}
