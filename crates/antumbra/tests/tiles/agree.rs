//! Tiles as good as maps of their own.

use crate::casters::{self, Casters, LAYER, LAYERS, alone, ask, atlas, options, placed, seen, tiles};
use antumbra::{
    Capabilities, Description, NoProbe, ShadowMap, Size, Technique, Tile, technique,
    technique::{Access, Binding},
};
use antumbra_testing::{
    Gpu,
    ask::{Painter, Random, Receiver, depth_layers},
};
use glam::{Vec2, Vec3};

/// Everywhere in a view, as many near its edges as within, with footprints of all sizes, tilted.
fn receivers(seed: u64) -> Vec<Receiver> {
    let mut random = Random::new(seed);
    let mut place = |i: u32| {
        let all = random.unit();
        match i % 4 {
            0 => 0.06 * all,
            1 => 1.0 - 0.06 * all,
            _ => all,
        }
    };
    let places: Vec<Vec2> = (0..4096).map(|i| Vec2::new(place(i), place(i / 4))).collect();
    let receiver = |uv: Vec2| {
        let footprint = Vec2::new(random.range(-18.0, -3.0).exp2(), random.range(-18.0, -3.0).exp2());
        let normal = Vec3::new(random.range(-0.4, 0.4), random.range(-0.4, 0.4), -1.0).normalize();
        Receiver { footprint, normal, ..Receiver::point(uv.x, uv.y, random.unit()) }
    };
    places.into_iter().map(receiver).collect()
}

/// How far answers may be apart, and how many of a thousand farther. None where all that is read is read texel by
/// texel: whatever is reckoned is the same. Samplers weigh texels by their place in the layer, which rounds a place in
/// the view further, to 2⁻¹⁶ texels in 192; moments magnify that, and GPUs have weights of 8 bits beside. Powers of e
/// magnify it by what texels are behind the receiver, without bounds, though where a texel e^k times too bright leaves
/// any shadow is a share of about e^−k of the map.
fn tolerance(gpu: &Gpu, described: &Description) -> (f32, usize) {
    let linear = described.bindings.contains(&Binding::Compare(wgpu::FilterMode::Linear));
    let gathers = described.slots.contains(&"taps_gather");
    let sampled = described.maps.iter().any(|map| matches!(map.access, Access::Sampler | Access::Powers));
    let has = |name| described.uniforms.iter().any(|(n, _)| *n == name);
    match gpu.is_software() {
        _ if !sampled && (!linear || gathers) => (0.0, 0),
        true if has("c") => (1e-3, 5),
        true => (described.rounding, 0),
        false => (2e-2, 20),
    }
}

/// Answers of views in tiles are those of the same views with maps of their own.
pub(crate) fn tiles_are_maps(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    compare(gpu, technique, &atlas(gpu, technique, &tiles()), &tiles())
}

fn compare(gpu: &Gpu, technique: &dyn Technique, shadows: &ShadowMap, tiles: &[Tile]) -> Result<(), String> {
    let described = technique.describe(&Capabilities::of(&gpu.device)).unwrap();
    let (tolerance, most) = tolerance(gpu, &described);
    let mut levels = Vec::new();
    for (view, tile) in tiles.iter().enumerate() {
        let receivers = receivers(view as u64 + 1);
        let found = ask(gpu, shadows, Some(view), &receivers);
        let expected = ask(gpu, &alone(gpu, technique, view, tile.size), None, &receivers);
        let differ = |i: &usize| found[*i].is_nan() || (found[*i] - expected[*i]).abs() > tolerance;
        let differing: Vec<usize> = (0..receivers.len()).filter(differ).collect();
        if differing.len() > most * receivers.len() / 1000 {
            let (i, count) = (differing[0], differing.len());
            let Receiver { uv, depth, .. } = receivers[i];
            return Err(format!(
                "view {view} in {tile}: {count} differ, one is {} instead of {} at {uv} in depth {depth}",
                found[i], expected[i]
            ));
        }
        levels.extend(expected.iter().map(|v| (v * 1000.0) as u32));
    }
    // Two terms lifted over all that rings are lit everywhere.
    let dark = levels.iter().filter(|level| **level < 1000).count();
    if dark > 1000 || described.ringing >= 1.0 {
        Ok(())
    } else {
        Err(format!("only {dark} receivers are not lit"))
    }
}

/// A map in which the whole layer is one view has other texels along the edges of what were tiles.
pub(crate) fn neighbours_leak(gpu: &Gpu, technique: &dyn Technique) {
    let tiles = tiles();
    let inner: Vec<(usize, Tile)> = tiles.iter().copied().enumerate().filter(|(_, t)| t.layer == 1).collect();
    let shadows = atlas(gpu, technique, &tiles);
    let whole = Tile { layer: 0, origin: [0, 0], size: LAYER };
    let mut all = ShadowMap::new(&gpu.device, technique, options(gpu, LAYER)).unwrap();
    let content = |x: u32, y: u32| {
        let within = |(_, t): &&(usize, Tile)| {
            (t.origin[0]..t.origin[0] + t.size.width).contains(&x)
                && (t.origin[1]..t.origin[1] + t.size.height).contains(&y)
        };
        inner.iter().find(within).map_or(1.0, |(view, t)| {
            casters::depth(*view, 0, (x - t.origin[0]) as i32, (y - t.origin[1]) as i32)
        })
    };
    let painter = Painter::new(gpu, LAYER, 1, |_, x, y| content(x, y));
    Casters::Depth(painter).fill(gpu, &mut all, &[seen(whole.size).into()]);
    let (tiled, one) = (shadows.map_texture(0).unwrap(), all.map_texture(0).unwrap());
    let of_view = technique.describe(&Capabilities::of(&gpu.device)).unwrap().maps[0].layers;
    let texel = tiled.format().block_copy_size(None).unwrap();
    for mip in 0..tiled.mip_level_count().min(3) {
        let row = (LAYER.width >> mip) * texel;
        let [a, b] = [gpu.read_texture(tiled, of_view, mip), gpu.read_texture(one, 0, mip)];
        let differs = |x: u32, y: u32| {
            let at = (y * row + x * texel) as usize;
            a[at..at + texel as usize] != b[at..at + texel as usize]
        };
        let tile = tiles[0].at_mip(mip);
        let count = (0..tile.size.height).filter(|y| differs(tile.origin[0], tile.origin[1] + y)).count();
        assert!(count > 0, "level {mip} is the same beside the neighbour");
    }
}

/// The tile at a mip level.
trait AtMip {
    fn at_mip(&self, mip: u32) -> Tile;
}

impl AtMip for Tile {
    fn at_mip(&self, mip: u32) -> Tile {
        let size = Size { width: self.size.width >> mip, height: self.size.height >> mip };
        Tile { origin: self.origin.map(|x| x >> mip), size, ..*self }
    }
}

/// Other tiles in the next frame, without other textures.
pub(crate) fn tiles_move(gpu: &Gpu) {
    for spec in ["hard", "stratified", "vsm", "csm.sampling=summed,kernel=5", "spsm.layers=2", "dpm", "exact"]
    {
        let technique = technique::parse(spec).unwrap();
        let mut shadows = atlas(gpu, technique.as_ref(), &tiles());
        let before = shadows.memory();
        let mut moved = tiles();
        moved.swap(0, 3);
        moved[1] = Tile { layer: 1, origin: [128, 96], size: Size { width: 24, height: 32 } };
        let views: Vec<(usize, Tile)> = moved.iter().copied().enumerate().collect();
        Casters::new(gpu, technique.as_ref(), LAYER, &views).fill(gpu, &mut shadows, &placed(&moved));
        compare(gpu, technique.as_ref(), &shadows, &moved).unwrap_or_else(|e| panic!("{spec}: {e}"));
        assert_eq!(shadows.memory(), before, "{spec}");
        assert_eq!(shadows.tiles(), moved);
    }
}

/// A renderer's own depth, with views beside one another.
pub(crate) fn brought_depth(gpu: &Gpu) {
    for spec in ["pcf", "stratified", "esm"] {
        let technique = technique::parse(spec).unwrap();
        let casts = technique.describe(&Capabilities::of(&gpu.device)).unwrap().sample_offsets.len() as u32;
        let tiles = tiles();
        let depth = depth_layers(gpu, LAYER, LAYERS * casts, |layer, x, y| {
            let within = |t: &Tile| {
                t.layer == layer / casts
                    && (t.origin[0]..t.origin[0] + t.size.width).contains(&x)
                    && (t.origin[1]..t.origin[1] + t.size.height).contains(&y)
            };
            tiles.iter().position(within).map_or(0.0, |view| {
                let [left, top] = tiles[view].origin;
                casters::depth(view, (layer % casts) as usize, (x - left) as i32, (y - top) as i32)
            })
        });
        let options = options(gpu, Size::square(1)).views(5).lights(5).tiled(1);
        let mut shadows = ShadowMap::from_depth(&gpu.device, technique.as_ref(), &depth, options).unwrap();
        let views = placed(&tiles);
        let lights: Vec<_> = views.iter().map(std::slice::from_ref).collect();
        shadows.prepare_lights(&gpu.queue, &lights).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows.encode_filter(&mut encoder, &mut NoProbe);
        gpu.queue.submit([encoder.finish()]);
        compare(gpu, technique.as_ref(), &shadows, &tiles).unwrap_or_else(|e| panic!("{spec}: {e}"));
    }
}

/// Views without a tile, in a map that is made for tiles, take the layers with their numbers.
pub(crate) fn whole_layers(gpu: &Gpu) {
    for spec in ["pcf", "vsm", "dpm"] {
        let technique = technique::parse(spec).unwrap();
        let options = options(gpu, Size::square(64)).views(2).lights(2).tiled(2);
        let mut shadows = ShadowMap::new(&gpu.device, technique.as_ref(), options).unwrap();
        let tiles = [0, 1].map(|layer| Tile { layer, origin: [0, 0], size: Size::square(64) });
        let views = [(0, tiles[0]), (1, tiles[1])];
        let casters = Casters::new(gpu, technique.as_ref(), Size::square(64), &views);
        casters.fill(gpu, &mut shadows, &[seen(Size::square(64)).into(); 2]);
        assert_eq!(shadows.tiles(), tiles);
        compare(gpu, technique.as_ref(), &shadows, &tiles).unwrap_or_else(|e| panic!("{spec}: {e}"));
    }
}
