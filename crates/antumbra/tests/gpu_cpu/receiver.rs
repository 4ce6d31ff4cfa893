//! Depth, projection and gradients of receivers.

use super::{INPUTS, Row, SIZE, compare, compare_from, row, rows, run, shadows};
use antumbra::{Capacity, Light, Options, ShadowMap, Size, technique};
use antumbra_testing::Gpu;
use antumbra_testing::ask::{Random, Receiver, caster_mesh, visibility};
use glam::{DMat4, DVec3, Mat4, Vec3};

/// A depth z is rounded by 6e-8, which the curve of a perspective depth magnifies by 1/(1 − (1 − r)z).
pub(crate) fn raster_depth_is_linearised(gpu: &Gpu) {
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    // r = near/far; z projected depth; l linear depth.
    let rows = rows(6, |r| row([r.unit(), 10f32.powf(r.range(-3.0, 0.0)), r.unit()]));
    let body = "
        let r = take(1u);
        let over = vec4f(0.0, 0.0, r, 0.0);
        let under = vec4f(0.0, 0.0, r - 1.0, 1.0);
        put(0u, raster_linear(vec3f(0.7, -0.3, take(0u)), over, under));
        let l = take(2u);
        put(1u, raster_slope(vec3f(0.7, -0.3, l / (r + l * (1.0 - r))), l, over, under));";
    let found = run::<2>(gpu, &shadows, body, &rows);
    // From distances: with far = 1, z = (1 − r/w)/(1 − r), linear depth (w − r)/(1 − r).
    let linear = |factor: f64| {
        move |row: &[f64; INPUTS]| {
            let (z, r) = (row[0], row[1] * factor);
            let w = r / (1.0 - z * (1.0 - r));
            let l = (w - r) / (1.0 - r).max(1e-12);
            ([l], 1e-6 + 3e-7 * l / (1.0 - (1.0 - r) * z))
        }
    };
    compare(&rows, &found, linear(1.0)).unwrap();
    compare(&rows, &found, linear(1.001)).unwrap_err();
    let projected = |l: f64, r: f64| l / (r + l * (1.0 - r));
    let slope = |factor: f64| {
        move |row: &[f64; INPUTS]| {
            let (h, l, r) = (1e-7, row[2], row[1] * factor);
            let s = (projected(l + h, r) - projected(l - h, r)) / (2.0 * h);
            // 1 − (1 − r)z loses the bits that it cancels.
            ([s], s * (1e-5 + 1.2e-7 * (r + l * (1.0 - r)) / r))
        }
    };
    compare_from(1, &rows, &found, slope(1.0)).unwrap();
    compare_from(1, &rows, &found, slope(1.001)).unwrap_err();
}

/// Not a number, infinities and depths out of range become the far plane; the rest stays, exactly.
pub(crate) fn raster_depth_is_cleaned(gpu: &Gpu) {
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e-6, -3.0, 1.000_001, 7.0];
    let good = [0.0, 1.0, 0.5, 1e-30, 0.999_999];
    let rows: Vec<Row> = odd.iter().chain(&good).map(|z| row([*z])).collect();
    let found = run::<1>(gpu, &shadows, "put(0u, raster_clean(take(0u)));", &rows);
    let expected: Vec<[f32; 1]> = odd.iter().map(|_| [1.0]).chain(good.map(|z| [z])).collect();
    assert_eq!(found, expected);
}

/// The matrix of a spot above a box.
fn spot() -> Mat4 {
    let bounds = antumbra::Bounds { min: Vec3::splat(-4.0), max: Vec3::splat(4.0) };
    let spot = Light::Spot {
        position: Vec3::new(1.0, 12.0, 2.0),
        direction: Vec3::new(0.1, -1.0, 0.2),
        outer_angle: 0.6,
    };
    let fit = antumbra::Fit {
        casters: bounds,
        receivers: bounds.corners().collect(),
        size: SIZE,
        margin_texels: 2.0,
        lean: true,
    };
    spot.view(&fit).unwrap().clip_from_world
}

/// Positions up to 4, distances of 8 to 16: a few roundings, none magnified.
pub(crate) fn receivers_are_projected(gpu: &Gpu) {
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    let matrix = spot();
    let m: Vec<String> = matrix.to_cols_array().iter().map(|v| format!("{v:?}")).collect();
    let rows = rows(7, |r| {
        let n = Vec3::new(r.range(-1.0, 1.0), r.range(-1.0, 1.0), r.range(-1.0, 1.0)).normalize();
        let p = Vec3::new(r.range(-4.0, 4.0), r.range(-4.0, 4.0), r.range(-4.0, 4.0));
        row([p.x, p.y, p.z, n.x, n.y, n.z])
    });
    let body = format!(
        "
        let matrix = mat4x4f({});
        let ndc = receiver_project(matrix, take3(0u));
        put4(0u, ndc);
        put3(4u, receiver_gradient(matrix, ndc, take3(3u)));
        put2(7u, receiver_uv(ndc.xy));
        put3(9u, receiver_tangent(take3(3u)));",
        m.join(", ")
    );
    let found = run::<12>(gpu, &shadows, &body, &rows);
    let matrix = matrix.as_dmat4();
    let project = |matrix: DMat4, p: DVec3| {
        let c = matrix * p.extend(1.0);
        (c.truncate() / c.w).extend(c.w)
    };
    let point = |r: &[f64; INPUTS]| (DVec3::new(r[0], r[1], r[2]), DVec3::new(r[3], r[4], r[5]));
    let ndc = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            (project(matrix * DMat4::from_scale(DVec3::splat(factor)), point(r).0).to_array(), 5e-6)
        }
    };
    compare(&rows, &found, ndc(1.0)).unwrap();
    compare(&rows, &found, ndc(1.001)).unwrap_err();
    let gradient = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let ((p, n), h) = (point(r), 1e-5);
            let change = (project(matrix, p + n * h) - project(matrix, p - n * h)) / (2.0 * h);
            ((change.truncate() * factor).to_array(), 2e-6)
        }
    };
    compare_from(4, &rows, &found, gradient(1.0)).unwrap();
    compare_from(4, &rows, &found, gradient(1.001)).unwrap_err();
    let uv = |r: &[f64; INPUTS]| {
        let ndc = project(matrix, point(r).0);
        ([0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y], 5e-6)
    };
    compare_from(7, &rows, &found, uv).unwrap();
    for (r, f) in rows.iter().zip(&found) {
        let (n, t) = (Vec3::new(r[3], r[4], r[5]), Vec3::new(f[9], f[10], f[11]));
        assert!((t.length() - 1.0).abs() < 1e-5 && n.dot(t).abs() < 1e-5, "tangent {t} of {n}");
    }
}

/// The gradient g of depth solves g·duv = ddepth along both tangents; a plane seen edge-on has none,
/// but its components stay finite and within the bound.
pub(crate) fn receiver_planes_are_solved(gpu: &Gpu) {
    const STEEPEST: f32 = 20.0;
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    let mut rows = rows(8, |r| {
        let mut values = row([0.0; 1]);
        values[..6].fill_with(|| r.range(-1.0, 1.0));
        values
    });
    // Edge-on: both tangents along one line, one of no length, both.
    let edge_on = rows.len();
    rows.push(row([0.3, 0.2, 0.6, 0.4, 0.5, 0.1]));
    rows.push(row([0.3, 0.2, 0.0, 0.0, 0.5, 0.1]));
    rows.push(row([0.0, 0.0, 0.0, 0.0, 0.5, -0.1]));
    rows.push(row([0.0; 1]));
    rows.push(row([1e-20, 0.0, 0.0, 1e-20, 1.0, 1.0]));
    let body = format!(
        "put2(0u, receiver_plane(take2(0u), take2(2u), take2(4u), vec2f({STEEPEST:?}, {STEEPEST:?})));"
    );
    let found = run::<2>(gpu, &shadows, &body, &rows);
    assert!(found.as_flattened().iter().all(|g| g.abs() <= STEEPEST), "a plane without bound");
    let solve = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let area = r[0] * r[3] - r[1] * r[2];
            let g = [(r[4] * r[3] - r[5] * r[1]) / area, (r[5] * r[0] - r[4] * r[2]) / area];
            let s = f64::from(STEEPEST);
            // Rounding of the products, divided by the area.
            (g.map(|g| (factor * g).clamp(-s, s)), 1e-6 + 2e-6 * (1.0 + s) / area.abs())
        }
    };
    compare(&rows[..edge_on], &found[..edge_on], solve(1.0)).unwrap();
    compare(&rows[..edge_on], &found[..edge_on], solve(1.01)).unwrap_err();
    let residual = |r: &Row, g: &[f32; 2]| {
        let along = |i: usize| g[0] * r[2 * i] + g[1] * r[2 * i + 1] - r[4 + i];
        along(0).abs().max(along(1).abs())
    };
    let within = |g: &[f32; 2]| g.iter().all(|g| g.abs() < STEEPEST);
    for (r, g) in rows[..edge_on].iter().zip(&found).filter(|(_, g)| within(g)) {
        assert!(residual(r, g) < 1e-3, "{g:?} for {r:?}");
    }
}

/// A share of the plane, or a steeper one, but no more than 1.5 times the diagonal's gain steeper.
pub(crate) fn steeper_planes_are_followed(gpu: &Gpu) {
    const DIAGONAL: f64 = 0.25;
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    let mut rows = rows(9, |r| row([r.range(-2.0, 2.0), r.range(-2.0, 2.0), r.range(0.0, 3.0)]));
    rows.push(row([0.0, 0.0, 2.0]));
    let body = format!("put2(0u, receiver_followed(take2(0u), take(2u), vec2f({DIAGONAL:?})));");
    let found = run::<2>(gpu, &shadows, &body, &rows);
    let followed = |most: f64| {
        move |r: &[f64; INPUTS]| {
            let slope = r[0].hypot(r[1]) / DIAGONAL;
            let steeper = (slope * (r[2] - 1.0)).min(most);
            let factor = if slope > 0.0 { 1.0 + steeper / slope } else { 0.0 };
            ([r[0] * factor, r[1] * factor], 4e-6)
        }
    };
    compare(&rows, &found, followed(1.5)).unwrap();
    compare(&rows, &found, followed(1.45)).unwrap_err();
    compare(&rows, &found, followed(f64::INFINITY)).unwrap_err();
}

/// Six views of one map, 45° to each side of the axes, leave no gap: a closed box around the light darkens
/// everything beyond it and nothing within, in whatever direction.
pub(crate) fn six_spots_are_a_point_light(gpu: &Gpu) {
    let size = Size::square(64);
    let capacity = Capacity { triangles: 24, ..Capacity::default() };
    let options = Options::from(size).views(6).capacity(capacity);
    let mut shadows = ShadowMap::new(&gpu.device, &technique::Exact, options).unwrap();
    let bounds = |half: f32| antumbra::Bounds { min: Vec3::splat(-half), max: Vec3::splat(half) };
    let axes = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    let view = |direction| {
        let position = Vec3::ZERO;
        let spot = Light::Spot { position, direction, outer_angle: std::f32::consts::FRAC_PI_4 };
        let (casters, receivers) = (bounds(1.0), bounds(3.0).corners().collect());
        spot.view(&antumbra::Fit {
            casters,
            receivers,
            size,
            margin_texels: shadows.margin_texels(),
            lean: true,
        })
        .unwrap()
    };
    let views: Vec<_> = axes.map(view).collect();
    shadows.prepare(&gpu.queue, &views).unwrap();
    let side = |n: Vec3| {
        let s = Vec3::new(n.y, n.z, n.x);
        let t = n.cross(s);
        [n + s + t, n - s + t, n - s - t, n + s + t, n - s - t, n + s - t]
    };
    let corners: Vec<Vec3> =
        views.iter().flat_map(|view| side(-view.clip_from_world.row(3).truncate())).collect();
    let mesh = caster_mesh(gpu, &corners);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    let mut random = Random::new(31);
    // Along edges and diagonals of the box, where two and three views meet, and anywhere.
    let grid = (0..27).map(|i| Vec3::new((i % 3) as f32, (i / 3 % 3) as f32, (i / 9) as f32) - 1.0);
    let directions: Vec<Vec3> = grid
        .chain((0..100).map(|_| Vec3::new(random.unit(), random.unit(), random.unit()) - 0.5))
        .filter_map(Vec3::try_normalize)
        .collect();
    for (distance, expected) in [(0.9, 1.0), (2.0, 0.0)] {
        let receiver = |direction: &Vec3| {
            let place = *direction * distance;
            let point = Receiver::point(0.5 + 0.5 * place.x, 0.5 - 0.5 * place.y, place.z);
            Receiver { normal: -*direction, ..point }
        };
        let receivers: Vec<Receiver> = directions.iter().map(receiver).collect();
        let found = visibility(gpu, &shadows, &receivers);
        for (direction, found) in directions.iter().zip(found) {
            assert_eq!(found, expected, "at {distance} along {direction}");
        }
    }
}
