//! Casters of several views, with another content each, and maps of them.

use antumbra::{
    Capabilities, Capacity, CasterMesh, Options, Placed, ShadowMap, Size, Technique, Tile, View,
    technique::CasterStorage,
};
use antumbra_testing::Gpu;
use antumbra_testing::ask::{self, Painter, Receiver, caster_mesh, compute, read_rows};
use glam::Vec3;

/// Texels of the layers, and how many.
pub(crate) const LAYER: Size = Size { width: 192, height: 128 };
pub(crate) const LAYERS: u32 = 2;

/// One beside the other in one layer, a smaller one in the other.
pub(crate) fn tiles() -> [Tile; 5] {
    let tile = |layer, x, y, width, height| Tile { layer, origin: [x, y], size: Size { width, height } };
    [
        tile(1, 64, 64, 64, 64),
        tile(0, 96, 32, 40, 24),
        tile(1, 128, 64, 48, 32),
        tile(1, 0, 64, 64, 64),
        tile(1, 64, 0, 96, 64),
    ]
}

/// Depth of a caster pass of a view in texel (x, y), which may lie beside the view: blocks of three texels.
pub(crate) fn depth(view: usize, cast: usize, x: i32, y: i32) -> f32 {
    let block = [x.div_euclid(3), y.div_euclid(3)].map(|i| i.wrapping_add(1000) as u64);
    let mut random = ask::Random::new((view as u64) << 40 | block[0] << 20 | block[1]);
    random.unit();
    0.2 + 0.7 * random.unit() + 0.002 * cast as f32
}

/// What draws the casters of some views, each with the texel of the target where its own begin.
pub(crate) enum Casters {
    Depth(Painter),
    Meshes(Vec<CasterMesh>),
}

impl Casters {
    /// Of those views, by number.
    pub(crate) fn new(gpu: &Gpu, technique: &dyn Technique, target: Size, views: &[(usize, Tile)]) -> Self {
        let described = technique.describe(&Capabilities::of(&gpu.device)).unwrap();
        if described.storage == CasterStorage::Depth {
            let casts = described.sample_offsets.len();
            return Self::Depth(Painter::new(gpu, target, (views.len() * casts) as u32, |layer, x, y| {
                let (view, tile) = views[layer as usize / casts];
                let [x, y] = [x as i32 - tile.origin[0] as i32, y as i32 - tile.origin[1] as i32];
                depth(view, layer as usize % casts, x, y)
            }));
        }
        Self::Meshes(views.iter().map(|(view, tile)| mesh(gpu, *view, tile.size)).collect())
    }

    /// A map whose lights see one view each, filled.
    pub(crate) fn fill(&self, gpu: &Gpu, shadows: &mut ShadowMap, views: &[Placed]) {
        let lights: Vec<&[Placed]> = views.iter().map(std::slice::from_ref).collect();
        shadows.prepare_lights(&gpu.queue, &lights).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows
            .encode(&mut encoder, |pass| match self {
                Self::Depth(painter) => {
                    let index = pass.index();
                    painter.draw(pass, index);
                }
                Self::Meshes(meshes) => pass.draw_mesh(&meshes[pass.index()], ..),
            })
            .unwrap();
        gpu.queue.submit([encoder.finish()]);
    }
}

/// Squares of three triangles for each texel of a view and those next to it, a little smaller than texels.
fn mesh(gpu: &Gpu, view: usize, size: Size) -> CasterMesh {
    const INSET: f32 = 2e-3;
    let mut corners = Vec::new();
    for (y, x) in (-2..size.height as i32 + 2).flat_map(|y| (-2..size.width as i32 + 2).map(move |x| (y, x)))
    {
        let z = depth(view, 0, x, y);
        let at = |right: f32, down: f32| {
            let end = |k: f32| k + INSET * (1.0 - 2.0 * k);
            let (u, v) =
                ((x as f32 + end(right)) / size.width as f32, (y as f32 + end(down)) / size.height as f32);
            Vec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, z)
        };
        let [a, b, c, d] = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
        let m = at(0.4, 0.0);
        corners.extend([m, c, d, m, d, b, m, a, c]);
    }
    caster_mesh(gpu, &corners)
}

/// Room for all of those triangles.
pub(crate) fn options(gpu: &Gpu, size: Size) -> Options {
    let capacity = Capacity { triangles: 1 << 15, ..Capacity::default() };
    Options::from(size).capacity(capacity).pipelines(&ask::pipelines(gpu))
}

/// A map in which the views lie in these tiles, with a light for each.
pub(crate) fn atlas(gpu: &Gpu, technique: &dyn Technique, tiles: &[Tile]) -> ShadowMap {
    let count = tiles.len() as u32;
    let options = options(gpu, LAYER).views(count).lights(count).tiled(LAYERS);
    let mut shadows = ShadowMap::new(&gpu.device, technique, options).unwrap();
    let views: Vec<(usize, Tile)> = tiles.iter().copied().enumerate().collect();
    Casters::new(gpu, technique, LAYER, &views).fill(gpu, &mut shadows, &placed(tiles));
    shadows
}

pub(crate) fn placed(tiles: &[Tile]) -> Vec<Placed> {
    tiles.iter().map(|tile| seen(tile.size).at(*tile)).collect()
}

pub(crate) fn seen(size: Size) -> View {
    ask::view(size)
}

/// A map of one of the views alone.
pub(crate) fn alone(gpu: &Gpu, technique: &dyn Technique, view: usize, size: Size) -> ShadowMap {
    let mut shadows = ShadowMap::new(&gpu.device, technique, options(gpu, size)).unwrap();
    let casters = Casters::new(gpu, technique, size, &[(view, Tile { layer: 0, origin: [0, 0], size })]);
    casters.fill(gpu, &mut shadows, &[seen(size).into()]);
    shadows
}

/// Visibility of a light at receivers; `light` is none where the map has one.
pub(crate) fn ask(gpu: &Gpu, shadows: &ShadowMap, light: Option<usize>, receivers: &[Receiver]) -> Vec<f32> {
    let rows = read_rows(receivers, light.unwrap_or(0) as f32);
    let light = if light.is_some() { "u32(row.position.w), " } else { "" };
    let user = format!(
        "struct Row {{ position: vec4f, ddx: vec4f, ddy: vec4f, normal: vec4f }}
        @group(1) @binding(0) var<storage, read> rows: array<Row>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
            if id.x >= arrayLength(&rows) {{ return; }}
            let row = rows[id.x];
            results[id.x] = shadow_visibility({light}row.position.xyz, row.normal.xyz, row.ddx.xyz, row.ddy.xyz);
        }}"
    );
    compute(gpu, shadows, &user, ask::bytes_of(rows.as_flattened()), receivers.len(), receivers.len())
}
