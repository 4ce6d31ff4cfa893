//! The first triangles of texels: which ones are kept, in which order, and where their corners are.

use super::{
    lists::{ALL, MAP, TEXELS, TRIANGLES, drawn, on_map, overlapping, soup, views},
    row, rows, run,
};
use antumbra::{Capacity, Dpm, Fit, Light, Options, ShadowMap, Size};
use antumbra_testing::Gpu;
use antumbra_testing::ask::{Random, caster_mesh, compute};
use glam::{DVec2, Mat4, Vec3};
use std::collections::BTreeSet;

/// What a key says: near side seen, step of depth, number. The order of these is that of keys.
type Key = (bool, u32, u32);

/// Keys of each texel of a view, and the corners of every triangle.
fn found(
    gpu: &Gpu,
    shadows: &ShadowMap,
    keeps: usize,
    view: u32,
    triangles: u32,
) -> (Vec<Vec<Key>>, Vec<[Vec3; 3]>) {
    let stride = 9.max(3 * keeps);
    let user = format!(
        "@group(1) @binding(0) var<storage, read> unused: array<f32>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
            if id.x >= {TEXELS}u + {triangles}u {{ return; }}
            let me = id.x * {stride}u;
            if id.x >= {TEXELS}u {{
                let n = id.x - {TEXELS}u;
                for (var k = 0u; k < 9u; k += 1u) {{
                    results[me + k] = shadow_corner({view}u, n, k / 3u)[k % 3u];
                }}
                return;
            }}
            for (var i = 0u; i < {keeps}u; i += 1u) {{
                let key = shadow_key(({view}u * {TEXELS}u + id.x) * {keeps}u + i);
                let at = me + 3u * i;
                results[at] = select(select(0.0, 1.0, key_is_near(key)), -1.0, key == 0u);
                results[at + 1u] = f32((~key & ~key_near) >> shadow_key_bits());
                results[at + 2u] = f32(key_number(key, shadow_key_bits()));
            }}
        }}
        fn keep(p: vec3f) -> f32 {{ return shadow_visibility(p, p, p, p) + unused[0]; }}"
    );
    let count = TEXELS + triangles as usize;
    let flat = compute(gpu, shadows, &user, &[0; 16], count * stride, count);
    let (texels, corners) = flat.split_at(TEXELS * stride);
    let keys = |t: &[f32]| {
        let held = t[..3 * keeps].chunks_exact(3).take_while(|k| k[0] >= 0.0);
        held.map(|k| (k[0] == 1.0, k[1] as u32, k[2] as u32)).collect()
    };
    let corner = |c: &[f32]| [0, 1, 2].map(|k| Vec3::new(c[3 * k], c[3 * k + 1], c[3 * k + 2]));
    (texels.chunks_exact(stride).map(keys).collect(), corners.chunks_exact(stride).map(corner).collect())
}

/// The key of a triangle in a texel; its step may be off by rounding.
fn key(triangle: &[Vec3; 3], number: u32, texel: usize) -> Key {
    let [a, b, c] = triangle.map(|p| p.as_dvec3());
    let centre = DVec2::new((texel % 48) as f64 + 0.5, (texel / 48) as f64 + 0.5);
    let normal = (b - a).cross(c - a);
    let slope = -normal.truncate() / normal.z;
    let plane = a.z + slope.dot(centre - a.truncate()) - 0.5 * (slope.x.abs() + slope.y.abs());
    let least = plane.clamp(a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z));
    let steps = (1u32 << (31 - ALL.id_bits())) - 2;
    (normal.z < 0.0, (least * f64::from(steps)) as u32, number)
}

/// With vertices that can store, and without: every texel keeps the first of all triangles that touch it, in
/// order, and numbers lead to corners.
pub(crate) fn the_first_are_kept(gpu: &Gpu) {
    let lesser = antumbra_testing::gpu_without(wgpu::Features::VERTEX_WRITABLE_STORAGE).unwrap();
    for gpu in [gpu, &lesser] {
        for keeps in [1, 3, 8] {
            keeps_the_first(gpu, keeps);
        }
    }
}

fn keeps_the_first(gpu: &Gpu, keeps: usize) {
    let triangles = soup(&mut Random::new(35));
    let technique = Dpm { keeps: keeps as u32, samples: 1 };
    let shadows = drawn(gpu, &technique, ALL, &triangles);
    assert_eq!(shadows.triangles_drawn(), TRIANGLES);
    for (index, view) in (0..).zip(&views()) {
        let placed = on_map(view, &triangles);
        let (texels, corners) = found(gpu, &shadows, keeps, index, TRIANGLES);
        let (mut full, mut unordered) = (0, 0);
        for (texel, held) in texels.iter().enumerate() {
            let numbers: BTreeSet<u32> = held.iter().map(|k| k.2).collect();
            assert_eq!(numbers.len(), held.len(), "a triangle is kept twice: {held:?}");
            assert!(numbers.is_subset(&overlapping(&placed, texel, 0.501)), "texel {texel}: {held:?}");
            assert!(held.is_sorted(), "{held:?}");
            for found in held {
                let (near, step, _) = key(&placed[found.2 as usize], found.2, texel);
                // A steep plane's depth is worth little, in 32 bits as in 64.
                let off = f64::from(step.abs_diff(found.1));
                assert!(near == found.0 && off <= 1.0 + 1e-4 * f64::from(step), "{found:?}, {step}");
            }
            let missing = overlapping(&placed, texel, 0.5).into_iter().filter(|n| !numbers.contains(n));
            let missing: Vec<Key> = missing.map(|n| key(&placed[n as usize], n, texel)).collect();
            if held.len() < keeps {
                assert!(missing.is_empty(), "texel {texel} has room for {missing:?}");
                continue;
            }
            let last = held[keeps - 1];
            let later = |k: &&Key| (k.0, k.1 + 1 + k.1 / 10_000) >= (last.0, last.1);
            assert_eq!(missing.iter().filter(later).count(), missing.len(), "{held:?} before {missing:?}");
            full += usize::from(!missing.is_empty());
            unordered += usize::from(missing.iter().any(|k| (k.1, k.0) < (last.1, last.0)));
        }
        assert!(full > TEXELS / 8, "{full} full texels");
        assert!(keeps > 1 || unordered > 20, "order of depth alone would do: {unordered}");
        let same = |found: &[Vec3; 3], expected: &[Vec3; 3]| {
            expected.iter().all(|p| found.iter().any(|q| p.distance(*q) < 1e-4))
        };
        let kept: BTreeSet<u32> = texels.concat().iter().map(|k| k.2).collect();
        let right = |shift: usize| {
            let of = |n: &&u32| same(&corners[**n as usize], &placed[(**n as usize + shift) % placed.len()]);
            kept.iter().filter(of).count()
        };
        assert_eq!(right(0), kept.len());
        assert!(right(1) < 3, "{} of the next number", right(1));
    }
}

/// Triangles beyond the capacity are left out and told.
pub(crate) fn triangles_beyond_the_capacity_are_left_out(gpu: &Gpu) {
    let triangles = soup(&mut Random::new(36));
    let few = Capacity { triangles: 50, ..ALL };
    let shadows = drawn(gpu, &Dpm { keeps: 6, samples: 1 }, few, &triangles);
    assert_eq!(shadows.triangles_drawn(), TRIANGLES);
    let held: BTreeSet<u32> = found(gpu, &shadows, 6, 0, 50).0.concat().iter().map(|k| k.2).collect();
    assert!(held.len() > 20 && held.iter().all(|n| *n < 50), "{held:?}");
    let memory = ShadowMap::new(&gpu.device, &Dpm::default(), Options::from(MAP).views(2)).unwrap().memory();
    let bytes = |name: &str| memory.items.iter().find(|i| i.name == name).map_or(0, |i| i.bytes);
    assert_eq!(bytes("k-buffer keys"), 2 * 4 * 4 * TEXELS as u64);
    assert_eq!(bytes("k-buffer vertices"), 2 * 48 * (1 << 19));
}

/// The depth of texels' centres is that of the nearest triangle there, also of triangles that reach behind
/// a spot.
pub(crate) fn centres_have_their_depth(gpu: &Gpu) {
    const MAP: Size = Size::square(32);
    let mut random = Random::new(37);
    let mut point = || Vec3::from_array(std::array::from_fn(|_| random.range(-4.0, 4.0)));
    let light = Light::Spot { position: Vec3::ZERO, direction: Vec3::NEG_Z, outer_angle: 0.7 };
    let bounds = antumbra::Bounds { min: Vec3::splat(-4.0), max: Vec3::splat(4.0) };
    let fit = Fit {
        casters: bounds,
        receivers: bounds.corners().collect(),
        size: MAP,
        margin_texels: 0.0,
        lean: false,
    };
    let view = light.view(&fit).unwrap();
    let world_from_clip = view.clip_from_world.inverse();
    let user = "@group(1) @binding(0) var<storage, read> unused: array<f32>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
            results[id.x] = textureLoad(shadow_binding_0, vec2u(id.x % 32u, id.x / 32u), 0, 0);
        }
        fn keep(p: vec3f) -> f32 { return shadow_visibility(p, p, p, p) + unused[0]; }";
    let (mut cut, mut empty, mut wrong) = (0, 0, 0);
    for _ in 0..30 {
        let triangles: Vec<[Vec3; 3]> = (0..6).map(|_| [point(), point(), point()]).collect();
        let mut shadows = ShadowMap::new(&gpu.device, &Dpm::default(), MAP).unwrap();
        shadows.prepare(&gpu.queue, &[view]).unwrap();
        let mesh = caster_mesh(gpu, triangles.as_flattened());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..)).unwrap();
        gpu.queue.submit([encoder.finish()]);
        let depths = compute(gpu, &shadows, user, &[0; 16], 1024, 1024);
        for (i, found) in depths.into_iter().enumerate() {
            let (x, y) = ((i % 32) as f32 + 0.5, (i / 32) as f32 + 0.5);
            let ndc = Vec3::new(x / 16.0 - 1.0, 1.0 - y / 16.0, 0.5);
            let ray = world_from_clip.project_point3(ndc).as_dvec3().normalize();
            let mut nearest = (1.0, false);
            let mut clear = true;
            for triangle in &triangles {
                let [a, b, c] = triangle.map(|p| p.as_dvec3());
                let volume = a.dot(b.cross(c));
                let weights = [b.cross(c), c.cross(a), a.cross(b)].map(|n| n.dot(ray) * volume.signum());
                clear &= weights.iter().all(|w| w.abs() > 0.02);
                if weights.iter().all(|w| *w > 0.0) {
                    let hit = ray * (volume.abs() / weights.iter().sum::<f64>());
                    let depth = view.clip_from_world.project_point3(hit.as_vec3()).z.max(0.0);
                    if depth < nearest.0 {
                        nearest = (depth, triangle.iter().any(|p| p.z > 0.0));
                    }
                }
            }
            if clear {
                cut += usize::from(nearest.1);
                empty += usize::from(nearest.0 == 1.0);
                wrong += usize::from((nearest.0 - found).abs() > 1e-4);
            }
        }
    }
    assert!(cut > 1000 && empty > 1000, "{cut} of triangles that reach behind, {empty} without any");
    assert!(wrong < 10, "{wrong} texels have another depth");
}

/// Side, depth and number of keys with few and many bits for numbers, also at the far plane.
pub(crate) fn keys_keep_what_they_are_of(gpu: &Gpu) {
    let inputs = |r: &mut Random| {
        let bits = 1 + (23.0 * r.unit()) as u32;
        let depth = if r.unit() < 0.2 { 1.0 } else { r.range(-0.2, 1.2) };
        let number = (r.unit() * ((1 << bits) - 1) as f32) as u32;
        row([bits as f32, depth, number as f32, f32::from(r.unit() < 0.5)])
    };
    let rows = rows(39, inputs);
    let body = "
        let bits = u32(take(0u));
        let key = key_of(take(3u) == 1.0, take(1u), u32(take(2u)), bits);
        let step = (~key & ~key_near) >> bits;
        put(0u, f32(key_is_near(key)));
        put(1u, f32(key_number(key, bits)));
        put(2u, f32(step) / f32((1u << (31u - bits)) - 2u));
        put(3u, f32(key == 0u || key_deeper(key, key_step(take(1u), bits), bits)));";
    let shadows = ShadowMap::new(&gpu.device, &Dpm::default(), MAP).unwrap();
    let found = run::<4>(gpu, &shadows, body, &rows);
    for (r, found) in rows.iter().zip(found) {
        let step = 1.0 / (2f32.powi(31 - r[0] as i32) - 2.0);
        assert_eq!([found[0], found[1], found[3]], [r[3], r[2], 0.0], "{r:?}");
        assert!((found[2] - r[1].clamp(0.0, 1.0)).abs() <= step + 1e-6, "{r:?}: {found:?}");
    }
}

/// The same triangle is seen from its other side where its object is mirrored.
pub(crate) fn mirrored_objects_show_their_other_side(gpu: &Gpu) {
    let corners = [Vec3::new(-0.8, -0.7, 0.4), Vec3::new(0.9, -0.6, 0.5), Vec3::new(0.1, 0.8, 0.6)];
    let seen = |scale: f32| {
        let technique = Dpm { keeps: 1, samples: 1 };
        let options = Options::from(MAP).capacity(Capacity { triangles: 1, ..ALL });
        let mut shadows = ShadowMap::new(&gpu.device, &technique, options).unwrap();
        shadows.prepare(&gpu.queue, &views()[..1]).unwrap();
        let mesh = caster_mesh(gpu, &corners.map(|p| p * Vec3::new(scale, 1.0, 1.0)));
        mesh.place(&gpu.queue, Mat4::from_scale(Vec3::new(scale, 1.0, 1.0)));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..)).unwrap();
        gpu.queue.submit([encoder.finish()]);
        let keys = found(gpu, &shadows, 1, 0, 1).0.concat();
        assert!(keys.len() > 300, "{} texels", keys.len());
        assert!(keys.iter().all(|key| key.0 == keys[0].0), "both sides at once");
        keys[0].0
    };
    assert_ne!(seen(1.0), seen(-1.0));
}
