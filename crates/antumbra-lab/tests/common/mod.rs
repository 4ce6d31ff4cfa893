//! A scene on the GPU and under rays, and what techniques make of it.

#![allow(dead_code, reason = "each test program uses a part of it")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use antumbra::{Capacity, Kernel, Options, ShadowMap, Size, Technique, View, Weights, technique::Bias};
use antumbra_lab::{
    gpu::{Gpu, Wait},
    image::GrayImage,
    map_views,
    metrics::{self, Score},
    readback,
};
use antumbra_render::{Casters, GpuScene, Lighting, Lookup, views};
use antumbra_scene::{Camera, Geometry, Light, Scene};
use antumbra_truth::{CameraRays, Coverage, CoverageTolerance, Tracer, Visibility};

/// Kernel width of every technique and of the ideal, texels.
pub(crate) const KERNEL: u32 = 5;

/// One picture of one scene.
pub(crate) struct Picture {
    pub(crate) geometry: Geometry,
    pub(crate) camera: Camera,
    pub(crate) light: Light,
    pub(crate) resolution: [u32; 2],
    pub(crate) gpu: Gpu,
    pub(crate) gpu_scene: GpuScene,
    lighting: Lighting,
    /// What its maps have memory for: what the scene needs, unless a test wants otherwise.
    pub(crate) capacity: Capacity,
    /// Whether lookups may ask about cut-outs: where the scene has some, unless a test wants otherwise.
    pub(crate) cutouts: bool,
}

impl Picture {
    /// The scene's own camera and light.
    pub(crate) fn new(gpu: &antumbra_testing::Gpu, scene: &Scene, resolution: [u32; 2]) -> Self {
        Self::with(gpu, scene, resolution, |_| ())
    }

    /// The same of a geometry that is changed before.
    pub(crate) fn with(
        gpu: &antumbra_testing::Gpu,
        scene: &Scene,
        resolution: [u32; 2],
        change: impl FnOnce(&mut Geometry),
    ) -> Self {
        scene.validate().unwrap();
        let gpu = Gpu::adopt(gpu.device.clone(), gpu.queue.clone(), gpu.info.clone());
        let (mut geometry, camera, light) = (scene.flatten(), scene.main_camera(), scene.main_light());
        change(&mut geometry);
        let gpu_scene = GpuScene::new(&gpu, &geometry, &camera, &light, resolution).unwrap();
        let lighting = Lighting::new(&gpu, &gpu_scene);
        let capacity = gpu_scene.capacity();
        let cutouts = gpu_scene.tells_cutouts();
        Self { geometry, camera, light, resolution, gpu, gpu_scene, lighting, capacity, cutouts }
    }

    pub(crate) fn rays(&self) -> CameraRays {
        CameraRays::new(&self.camera, self.resolution[0], self.resolution[1]).unwrap()
    }

    /// Whether raster and rays see the same triangles.
    pub(crate) fn coverage(&self) -> Coverage {
        let (tracer, rays) = (Tracer::new(&self.geometry).unwrap(), self.rays());
        let ids = readback::triangle_ids(&self.gpu, &self.gpu_scene, &self.geometry).unwrap();
        assert_eq!(ids.len(), rays.pixel_count());
        tracer.coverage(&rays, &tracer.primary(&rays), &ids, CoverageTolerance::default())
    }

    /// Shadow maps that share one view.
    pub(crate) fn maps(
        &self,
        techniques: &[&dyn Technique],
        size: u32,
        bias: Bias,
    ) -> (Vec<ShadowMap>, View) {
        let options = Options::from(Size::square(size)).bias(bias).capacity(self.capacity);
        let options = options.cutouts(self.cutouts);
        let new = |t: &&dyn Technique| ShadowMap::new(&self.gpu.device, *t, options.clone()).unwrap();
        let mut maps: Vec<ShadowMap> = techniques.iter().map(new).collect();
        let all: Vec<&ShadowMap> = maps.iter().collect();
        let scene = self.geometry.bounds_around(self.camera.position).unwrap();
        let lean = all.iter().all(|map| map.leans());
        let view = views::fit(self.gpu_scene.camera_matrix(), scene, &self.light, 1, &all, lean).unwrap()[0];
        for map in &mut maps {
            map.prepare(&self.gpu.queue, &[view]).unwrap();
        }
        (maps, view)
    }

    /// What one of them answers for every pixel.
    pub(crate) fn visibility(&mut self, shadows: &ShadowMap) -> GrayImage {
        let lookup = Lookup::new(&self.gpu, &self.gpu_scene, shadows);
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let casters = Casters::new(&self.gpu, &self.gpu_scene, shadows).unwrap();
        shadows.encode(&mut encoder, |pass| self.gpu_scene.draw_casters(&casters, pass)).unwrap();
        self.gpu_scene.encode_surfaces(&mut encoder, None);
        self.lighting.encode_lookup(&mut encoder, &self.gpu_scene, &lookup, Some(shadows), None);
        self.gpu.finish(encoder).unwrap();
        readback::visibility(&self.gpu, &self.lighting).unwrap()
    }

    /// The same for a single technique.
    pub(crate) fn answer(&mut self, technique: &dyn Technique, size: u32, bias: Bias) -> GrayImage {
        let (maps, _) = self.maps(&[technique], size, bias);
        self.visibility(&maps[0])
    }

    pub(crate) fn hard_truth(&self) -> Visibility {
        Tracer::new(&self.geometry).unwrap().hard(&self.rays(), &self.light)
    }

    pub(crate) fn light_space_ideal(&self, view: &View) -> Visibility {
        let taps = Kernel::new(Weights::Gaussian, KERNEL, 0.0).taps;
        let kernel = antumbra_truth::Kernel::new(taps.iter().map(|w| f64::from(*w)).collect()).unwrap();
        let tracer = Tracer::new(&self.geometry).unwrap();
        tracer.light_space_ideal(&self.rays(), &self.light, &kernel, &map_views::texel_axes(view), &|_| ())
    }
}

/// An answer against a truth.
pub(crate) fn score(test: &GrayImage, truth: &Visibility) -> Score {
    let plane = GrayImage::new(truth.width, truth.height, truth.values.clone()).unwrap();
    metrics::score(test, &plane, &truth.shadowable).unwrap()
}
