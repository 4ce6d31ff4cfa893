//! Writes a report about images that are drawn by formulas, to look at the page without a GPU.
//!
//! `cargo run --release -p antumbra-lab --example sample_report -- FOLDER`
//!
//! The scores are measured on those images; times and memory are made up, and the page says so.

use antumbra_lab::files;
use antumbra_lab::image::{GrayImage, Rgba8Image, crop, error_heat_map};
use antumbra_lab::metrics::{Score, no_shadow_baseline, score};
use antumbra_lab::report;
use antumbra_lab::results::{
    AdapterFacts, BoundsFacts, CameraFacts, Family, LensFacts, Lifetime, LightFacts, MemoryItem,
    MemoryResult, PassTime, Program, Results, RunFacts, SCHEMA, SceneFacts, Scores, Spread, TechniqueImages,
    TechniqueResult, TimeMethod, TimeResult, TruthFacts, TruthImages, ViewFacts, Work,
};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::PathBuf;

const WIDTH: u32 = 640;
const HEIGHT: u32 = 400;
/// Rows of sky above the floor: not shadowable.
const HORIZON: u32 = 70;
/// The rectangle of the region "contact".
const CONTACT: [u32; 4] = [40, 300, 200, 90];

type Images = BTreeMap<String, Vec<u8>>;

/// The three truths and the mask.
struct Truth {
    hard: GrayImage,
    light_space: GrayImage,
    screen_space: GrayImage,
    shadowable: Vec<bool>,
}

/// A made-up technique: its words, its picture, its cost.
struct Sample {
    spec: &'static str,
    title: &'static str,
    family: Family,
    paper: &'static str,
    visibility: fn(f32, f32) -> f32,
    passes: &'static [(&'static str, f64)],
    textures: &'static [(&'static str, &'static str, u32, u32, u64, Lifetime)],
}

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args_os()
        .nth(1)
        .map_or_else(|| std::env::temp_dir().join("antumbra-sample-report"), PathBuf::from);
    let mut images = Images::new();
    let truth = truth(&mut images)?;
    let techniques =
        SAMPLES.iter().map(|s| technique(s, &truth, &mut images)).collect::<Result<Vec<_>, _>>()?;
    let folder = report::write(&results(&truth, techniques)?, &images, &out)?;
    println!("{}", folder.join("index.html").display());
    Ok(())
}

/// Distance in pixels to the edge of the shadow: negative inside. A railing and a ball on a floor
/// that recedes towards the horizon.
fn edge(x: f32, y: f32) -> f32 {
    let depth = (HEIGHT as f32 - HORIZON as f32) / (y - HORIZON as f32 + 6.0);
    let (fx, fz) = ((x - WIDTH as f32 / 2.0) * depth / 60.0, depth);
    let scale = 60.0 / depth;
    let post = ((fx + 0.35 * fz).rem_euclid(1.0) - 0.5).abs() - 0.09;
    let railing = post.max((fz - 3.2).abs() - 1.5);
    let beam = ((fz - 1.75).abs() - 0.06).min((fz - 4.6).abs() - 0.08);
    let ball = ((fx + 2.9) / 1.4).hypot((fz - 1.15) / 0.16) * 0.25 - 0.25;
    railing.min(beam).min(ball) * scale
}

fn hard(x: f32, y: f32) -> f32 {
    f32::from(u8::from(edge(x, y) > 0.0))
}

fn smooth(x: f32, y: f32, width: f32) -> f32 {
    let t = (edge(x, y) / width + 0.5).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn texel(x: f32, y: f32) -> (f32, f32) {
    ((x / 5.0).floor() * 5.0 + 2.5, (y / 3.0).floor() * 3.0 + 1.5)
}

const fn mega(bytes: u64) -> u64 {
    bytes << 20
}

const SAMPLES: [Sample; 7] = [
    Sample {
        spec: "hard",
        title: "Standard shadow map",
        family: Family::Comparison,
        paper: "Williams 1978",
        visibility: |x, y| {
            let (tx, ty) = texel(x, y);
            let acne = (x as u32 * 7 + y as u32 * 13).is_multiple_of(97) && x > 480.0;
            if acne { 0.0 } else { hard(tx, ty) }
        },
        passes: &[("cast", 0.21), ("lookup", 0.11)],
        textures: &[("depth", "depth32float", 1, 1, mega(4), Lifetime::Kept)],
    },
    Sample {
        spec: "pcf.kernel=5",
        title: "Percentage-closer filtering",
        family: Family::Comparison,
        paper: "Reeves, Salesin and Cook 1987",
        visibility: |x, y| {
            let (tx, ty) = texel(x, y);
            let taps = (0..25).map(|i| hard(tx + (i % 5 - 2) as f32 * 2.0, ty + (i / 5 - 2) as f32 * 1.2));
            taps.sum::<f32>() / 25.0
        },
        passes: &[("cast", 0.21), ("lookup", 0.46)],
        textures: &[("depth", "depth32float", 1, 1, mega(4), Lifetime::Kept)],
    },
    Sample {
        spec: "vsm.kernel=5",
        title: "Variance shadow map",
        family: Family::Basis,
        paper: "Donnelly and Lauritzen 2006",
        visibility: |x, y| {
            let bleeding = 0.4 * (1.0 - ((x - 190.0) / 110.0).abs()).max(0.0);
            smooth(x, y, 9.0).max(bleeding) * 0.98 + 0.02
        },
        passes: &[("cast", 0.21), ("convert", 0.05), ("blur", 0.14), ("lookup", 0.13)],
        textures: &[
            ("depth", "depth32float", 1, 1, mega(4), Lifetime::Transient),
            ("moments", "rg32float", 1, 11, mega(8) * 4 / 3, Lifetime::Kept),
            ("blurred", "rg32float", 1, 1, mega(8), Lifetime::Transient),
        ],
    },
    Sample {
        spec: "csm.order=16,kernel=5",
        title: "Convolution shadow map",
        family: Family::Basis,
        paper: "Annen et al. 2007",
        visibility: |x, y| (smooth(x, y, 13.0) * 0.96 + 0.04 * (edge(x, y) * 0.5).sin()).clamp(0.0, 1.0),
        passes: &[("cast", 0.21), ("convert", 0.31), ("blur", 0.74), ("lookup", 0.58)],
        textures: &[
            ("depth", "depth32float", 1, 1, mega(4), Lifetime::Transient),
            ("basis", "rgba8unorm", 8, 11, mega(32) * 4 / 3, Lifetime::Kept),
            ("blurred", "rgba8unorm", 8, 1, mega(32), Lifetime::Transient),
        ],
    },
    Sample {
        spec: "esm.c=80,kernel=5",
        title: "Exponential shadow map",
        family: Family::Basis,
        paper: "Annen et al. 2008",
        visibility: |x, y| {
            let contact = if x < 240.0 && y > 300.0 { 0.25 } else { 0.0 };
            (smooth(x, y, 9.0) + contact * smooth(x, y, 40.0)).min(1.0)
        },
        passes: &[("cast", 0.21), ("convert", 0.04), ("blur", 0.08), ("lookup", 0.11)],
        textures: &[
            ("depth", "depth32float", 1, 1, mega(4), Lifetime::Transient),
            ("exponential", "r32float", 1, 11, mega(4) * 4 / 3, Lifetime::Kept),
            ("blurred", "r32float", 1, 1, mega(4), Lifetime::Transient),
        ],
    },
    Sample {
        spec: "evsm.kernel=5",
        title: "Exponential variance shadow map",
        family: Family::Basis,
        paper: "Lauritzen and McCool 2008",
        visibility: |x, y| smooth(x + 0.3, y, 9.6),
        passes: &[("cast", 0.21), ("convert", 0.07), ("blur", 0.27), ("lookup", 0.15)],
        textures: &[
            ("depth", "depth32float", 1, 1, mega(4), Lifetime::Transient),
            ("moments", "rgba32float", 1, 11, mega(16) * 4 / 3, Lifetime::Kept),
            ("blurred", "rgba32float", 1, 1, mega(16), Lifetime::Transient),
        ],
    },
    Sample {
        spec: "spsm",
        title: "Sub-pixel shadow map",
        family: Family::Geometry,
        paper: "Lecocq et al. 2014",
        visibility: |x, y| hard(x + 0.3 * (y * 0.9).sin(), y),
        passes: &[("cast", 0.62), ("lookup", 0.97)],
        textures: &[
            ("depth", "depth32float", 1, 1, mega(4), Lifetime::Transient),
            ("triangles", "rgba32uint", 1, 1, mega(16), Lifetime::Kept),
        ],
    },
];

fn plane(visibility: impl Fn(f32, f32) -> f32) -> GrayImage {
    let floor = |x, y| if y < HORIZON { 1.0 } else { visibility(x as f32 + 0.5, y as f32 + 0.5) };
    GrayImage::from_fn(WIDTH, HEIGHT, floor)
}

fn truth(images: &mut Images) -> Result<Truth, Box<dyn Error>> {
    let many = |x: f32, y: f32| {
        let offset = |i: u8| f32::from(i) / 8.0 - 7.0 / 16.0;
        (0..64).map(|i| hard(x + offset(i % 8), y + offset(i / 8))).sum::<f32>() / 64.0
    };
    let truth = Truth {
        hard: plane(hard),
        light_space: plane(|x, y| smooth(x, y, 9.0)),
        screen_space: plane(many),
        shadowable: (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |_| y >= HORIZON)).collect(),
    };
    images.insert("truth-hard.png".into(), truth.hard.to_gray_png()?);
    images.insert("truth-light-space.png".into(), truth.light_space.to_gray_png()?);
    images.insert("truth-screen-space.png".into(), truth.screen_space.to_gray_png()?);
    Ok(truth)
}

fn picture(visibility: &GrayImage) -> Result<Rgba8Image, Box<dyn Error>> {
    let encode = |linear: f32| (linear.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8;
    let pixel = |(i, v): (usize, &f32)| {
        let y = (i as u32 / WIDTH) as f32;
        let colour = if y < HORIZON as f32 {
            [0.35 + y * 0.004, 0.5 + y * 0.003, 0.75]
        } else {
            [[0.06, 0.55], [0.07, 0.47], [0.09, 0.36]].map(|[ambient, sun]| ambient + sun * v)
        };
        let [r, g, b] = colour.map(encode);
        [r, g, b, 255]
    };
    let rgba = visibility.values.iter().enumerate().flat_map(pixel).collect();
    Ok(Rgba8Image::new(WIDTH, HEIGHT, rgba)?)
}

fn technique(s: &Sample, truth: &Truth, images: &mut Images) -> Result<TechniqueResult, Box<dyn Error>> {
    let visibility = plane(s.visibility);
    let stem = files::stem(s.spec);
    let mut add = |what: &str, png: Vec<u8>| {
        let name = format!("{stem}-{what}.png");
        images.insert(name.clone(), png);
        name
    };
    let heat = |truth_plane| error_heat_map(&visibility, truth_plane, &truth.shadowable);
    let names = TechniqueImages {
        picture: add("picture", picture(&visibility)?.to_png()?),
        visibility: add("visibility", visibility.to_gray_png()?),
        error_hard: add("error-hard", heat(&truth.hard)?.to_png()?),
        error_light_space: add("error-light-space", heat(&truth.light_space)?.to_png()?),
        classes: None,
    };
    let against = |plane: &GrayImage| score(&visibility, plane, &truth.shadowable);
    Ok(TechniqueResult {
        name: s.spec.split('.').next().unwrap_or(s.spec).into(),
        spec: s.spec.into(),
        title: s.title.into(),
        family: s.family,
        paper: s.paper.into(),
        settings: settings(s.spec),
        scores: Scores {
            hard: against(&truth.hard)?,
            light_space: against(&truth.light_space)?,
            screen_space: against(&truth.screen_space)?,
        },
        regions: BTreeMap::from([("contact".into(), contact(&visibility, truth)?)]),
        classes: Vec::new(),
        time: time(s.passes),
        memory: memory(s.textures),
        work: Some(work(s)),
        explain: vec![
            "Sample data: times and memory are made up.".into(),
            "Filters 32-bit floats in hardware.".into(),
        ],
        invalid: None,
        images: names,
    })
}

fn contact(visibility: &GrayImage, truth: &Truth) -> Result<Score, Box<dyn Error>> {
    let [x, y, w, h] = CONTACT;
    let mask = crop(&truth.shadowable, [WIDTH, HEIGHT], CONTACT)?;
    Ok(score(&visibility.crop(x, y, w, h)?, &truth.light_space.crop(x, y, w, h)?, &mask)?)
}

fn settings(spec: &str) -> BTreeMap<String, serde_json::Value> {
    let pairs = spec.split_once('.').map_or("", |(_, pairs)| pairs).split(',');
    let pair = |text: &str| {
        text.split_once('=').and_then(|(k, v)| Some((k.to_owned(), v.parse::<u32>().ok()?.into())))
    };
    pairs.filter_map(pair).collect()
}

fn time(passes: &[(&str, f64)]) -> TimeResult {
    let total: f64 = passes.iter().map(|(_, ms)| ms).sum::<f64>() + 0.09;
    let lookup = passes.last().map_or(0.0, |(_, ms)| *ms);
    let pass = |&(name, ms): &(&str, f64)| PassTime {
        name: name.into(),
        median_ms: ms,
        min_ms: ms * 0.96,
        max_ms: ms * 1.11,
        cpu_ms: Some(0.004),
        method: TimeMethod::Timestamps,
    };
    TimeResult {
        passes: passes.iter().map(pass).collect(),
        frame: Spread { median_ms: total, min_ms: total * 0.96, max_ms: total * 1.11 },
        frame_method: TimeMethod::Wall,
        rounds: 64,
        lookup_ratio_to_hard: Some(lookup / 0.11),
        frame_ratio_to_hard: Some(total / 0.41),
    }
}

fn memory(textures: &[(&str, &str, u32, u32, u64, Lifetime)]) -> MemoryResult {
    let item =
        |&(name, format, layers, mips, bytes, lifetime): &(&str, &str, u32, u32, u64, Lifetime)| MemoryItem {
            name: name.into(),
            format: format.into(),
            width: 1024,
            height: 1024,
            layers,
            mips,
            bytes,
            lifetime,
        };
    let items: Vec<MemoryItem> = textures.iter().map(item).collect();
    let sum = |lifetime: Lifetime| items.iter().filter(|i| i.lifetime == lifetime).map(|i| i.bytes).sum();
    MemoryResult { kept_bytes: sum(Lifetime::Kept), transient_bytes: sum(Lifetime::Transient), items }
}

fn work(s: &Sample) -> Work {
    let kept = s.textures.iter().filter(|t| t.5 == Lifetime::Kept);
    let bytes = kept.map(|t| t.4 as f64).sum::<f64>() / f64::from(1024 * 1024);
    let mips = s.textures.iter().any(|t| t.3 > 1);
    Work {
        bytes_per_texel: if mips { 0.75 * bytes } else { bytes },
        bytes_per_texel_with_mips: bytes,
        lookups: 1,
        passes: s.passes[1..s.passes.len() - 1].iter().map(|(name, _)| (*name).into()).collect(),
    }
}

fn results(truth: &Truth, techniques: Vec<TechniqueResult>) -> Result<Results, Box<dyn Error>> {
    let no_shadow = no_shadow_baseline(&truth.hard, &truth.shadowable)?;
    Ok(Results {
        schema: SCHEMA.into(),
        run: RunFacts {
            program: Program { name: "antumbra".into(), version: env!("CARGO_PKG_VERSION").into() },
            command: ["antumbra", "compare", "a sample", "--kernel", "5"].map(String::from).into(),
            scene: SceneFacts {
                name: "Sample report, not a measurement".into(),
                triangles: 12_480,
                light: LightFacts::Directional { direction: [0.408, -0.816, 0.408] },
                camera: CameraFacts {
                    position: [0.0, 1.7, 6.0],
                    target: [0.0, 0.0, 0.0],
                    up: [0.0, 1.0, 0.0],
                    lens: LensFacts::FovYDeg(50.0),
                },
                origin: [0.0; 3],
                bounds: BoundsFacts { min: [-8.0, 0.0, -8.0], max: [8.0, 2.4, 8.0] },
            },
            resolution: [WIDTH, HEIGHT],
            map_size: 1024,
            kernel_texels: 5,
            bias: "auto".into(),
            views: vec![ViewFacts { texel_world: 0.01, depth_world: 10.0 }],
            adapter: AdapterFacts {
                name: "Sample adapter (times are made up)".into(),
                driver: "none".into(),
                backend: "none".into(),
                device_type: "none".into(),
                features: vec!["float32-filterable".into(), "timestamp-query".into()],
            },
            warnings: Vec::new(),
            notes: Vec::new(),
        },
        cascades: None,
        truth: TruthFacts {
            seconds_build: 0.021,
            seconds_hard: 0.34,
            seconds_light_space: 8.1,
            seconds_screen_space: 16.7,
            coverage_agreement: 0.9998,
            coverage_explained: BTreeMap::from([("on a shared edge".into(), 48), ("unexplained".into(), 3)]),
            shadowable_pixels: no_shadow.shadowable_pixels,
            no_shadow,
            images: TruthImages {
                hard: "truth-hard.png".into(),
                light_space: "truth-light-space.png".into(),
                screen_space: "truth-screen-space.png".into(),
            },
        },
        techniques,
        left_out: Vec::new(),
        peak_memory_bytes: Some(mega(212)),
        seconds_total: 31.4,
        files: Vec::new(),
    })
}
