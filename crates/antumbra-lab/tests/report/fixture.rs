//! A small report: two techniques on a picture of 12 × 12 pixels.

use antumbra_lab::files;
use antumbra_lab::image::{GrayImage, Rgba8Image};
use antumbra_lab::metrics::{Score, score};
use antumbra_lab::report::{self, ReportError};
use antumbra_lab::results::{
    AdapterFacts, BoundsFacts, CameraFacts, Family, LensFacts, Lifetime, LightFacts, MemoryItem,
    MemoryResult, PassTime, Program, Results, RunFacts, SCHEMA, SceneFacts, Scores, Spread, TechniqueImages,
    TechniqueResult, TimeMethod, TimeResult, TruthFacts, TruthImages, ViewFacts, Work,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A folder of its own for each test, removed at its end.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("antumbra-report-test-{test}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

pub(crate) fn time() -> TimeResult {
    TimeResult {
        passes: vec![PassTime {
            name: "lookup".into(),
            median_ms: 0.5,
            min_ms: 0.4,
            max_ms: 0.7,
            cpu_ms: None,
            method: TimeMethod::Wall,
        }],
        frame: Spread { median_ms: 1.0, min_ms: 0.9, max_ms: 1.4 },
        frame_method: TimeMethod::Wall,
        rounds: 16,
        lookup_ratio_to_hard: None,
        frame_ratio_to_hard: Some(1.25),
    }
}

pub(crate) fn memory() -> MemoryResult {
    MemoryResult {
        items: vec![MemoryItem {
            name: "depth".into(),
            format: "depth32float".into(),
            width: 512,
            height: 512,
            layers: 1,
            mips: 1,
            bytes: 1 << 20,
            lifetime: Lifetime::Kept,
        }],
        kept_bytes: 1 << 20,
        transient_bytes: 0,
    }
}

pub(crate) fn technique(spec: &str, title: &str, family: Family, visibility: f32) -> TechniqueResult {
    let truth = GrayImage::from_fn(12, 12, |x, _| f32::from(x > 5));
    let test = GrayImage::from_fn(12, 12, |x, _| if x > 5 { visibility } else { 0.0 });
    let score = score(&test, &truth, &[true; 144]).unwrap();
    let stem = files::stem(spec);
    let image = |what: &str| format!("{stem}-{what}.png");
    TechniqueResult {
        name: spec.split('.').next().unwrap().into(),
        spec: spec.into(),
        title: title.into(),
        family,
        paper: "Somebody & others".into(),
        settings: BTreeMap::from([("c".into(), 80.into()), ("filter".into(), "gauss".into())]),
        scores: Scores { hard: score, light_space: score, screen_space: score },
        regions: BTreeMap::from([("contact".into(), score)]),
        classes: Vec::new(),
        time: time(),
        memory: memory(),
        work: Some(Work {
            bytes_per_texel: 4.0,
            bytes_per_texel_with_mips: 4.0,
            lookups: 1,
            passes: vec!["convert".into()],
        }),
        explain: vec!["chose depth32float".into()],
        invalid: None,
        images: TechniqueImages {
            picture: image("picture"),
            visibility: image("visibility"),
            error_hard: image("error-hard"),
            error_light_space: image("error-light-space"),
            classes: None,
        },
    }
}

fn adapter() -> AdapterFacts {
    AdapterFacts {
        name: "a device".into(),
        driver: "1.2".into(),
        backend: "Vulkan".into(),
        device_type: "Cpu".into(),
        features: vec![],
    }
}

pub(crate) fn results() -> Results {
    let techniques = vec![
        technique("hard", "Standard shadow map", Family::Comparison, 0.6),
        technique("esm.c=80,kernel=5", "Exponential shadow map", Family::Basis, 0.9),
    ];
    Results {
        schema: SCHEMA.into(),
        run: RunFacts {
            program: Program { name: "antumbra".into(), version: "0.1.0".into() },
            command: vec!["antumbra".into(), "it's here.glb".into()],
            scene: SceneFacts {
                name: "fence".into(),
                triangles: 1200,
                light: LightFacts::Directional { direction: [0.0, -1.0, 0.0] },
                camera: CameraFacts {
                    position: [0.0, 1.5, 4.0],
                    target: [0.0; 3],
                    up: [0.0, 1.0, 0.0],
                    lens: LensFacts::FovYDeg(45.0),
                },
                origin: [0.0; 3],
                bounds: BoundsFacts { min: [-1.0; 3], max: [1.0; 3] },
            },
            resolution: [12, 12],
            map_size: 512,
            kernel_texels: 5,
            bias: "auto".into(),
            views: vec![ViewFacts { texel_world: 0.01, depth_world: 10.0 }],
            adapter: adapter(),
            warnings: Vec::new(),
            notes: Vec::new(),
        },
        cascades: None,
        truth: TruthFacts {
            seconds_build: 0.01,
            seconds_hard: 0.1,
            seconds_light_space: 1.0,
            seconds_screen_space: 2.0,
            coverage_agreement: 0.999,
            coverage_explained: BTreeMap::new(),
            shadowable_pixels: 144,
            no_shadow: Score { pixel_match: 0.8, ..techniques[0].scores.hard },
            images: TruthImages {
                hard: "truth-hard.png".into(),
                light_space: "truth-light-space.png".into(),
                screen_space: "truth-screen-space.png".into(),
            },
        },
        techniques,
        left_out: Vec::new(),
        peak_memory_bytes: None,
        seconds_total: 4.0,
        files: vec![],
    }
}

pub(crate) fn images(results: &Results) -> BTreeMap<String, Vec<u8>> {
    let png = Rgba8Image::new(1, 1, vec![1, 2, 3, 255]).unwrap().to_png().unwrap();
    let truth = &results.truth.images;
    let mut names = vec![&truth.hard, &truth.light_space, &truth.screen_space];
    for t in &results.techniques {
        let images = &t.images;
        names.extend([&images.picture, &images.visibility, &images.error_hard, &images.error_light_space]);
    }
    names.into_iter().map(|name| (name.clone(), png.clone())).collect()
}

pub(crate) fn write(results: &Results, out: &Path) -> Result<PathBuf, ReportError> {
    report::write(results, &images(results), out)
}
