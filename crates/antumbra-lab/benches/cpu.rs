//! What the processor does: instructions, counted by valgrind, and allocations. Both are the same on every run, but
//! for what drivers and hashes with random seeds add. `make bench-cpu` prints them; with `--json` as a table.
//!
//! Each case runs in a process of its own under callgrind, which counts only inside [`measured`]: one call on its
//! thread, wgpu's share included.

#![allow(clippy::unwrap_used, reason = "benchmarks fail by panicking")]

use antumbra::{
    Bounds, CameraFit, Capabilities, Cascades, Light, Options, Shader, ShaderText, ShadowMap, Size,
    Unsupported, View, technique,
};
use antumbra_scene::procedural;
use antumbra_truth::Tracer;
use glam::{Vec3, camera::rh};
use std::{
    hint::black_box,
    process::{Command, ExitCode},
};

/// Names of the cases, whose words [`run`] reads.
const CASES: [&str; 25] = [
    "prepare hard, 1 view",
    "prepare hard, 4 views",
    "prepare esm, 1 view",
    "prepare esm, 4 views",
    "prepare csm, 4 views",
    "prepare stratified, 4 views",
    "prepare spsm, 1 view",
    "prepare dpm, 1 view",
    "encode hard, 1 view",
    "encode hard, 4 views",
    "encode esm, 1 view",
    "encode esm, 4 views",
    "encode csm, 1 view",
    "fit a spot",
    "fit the sun, 1 view",
    "fit the sun, 4 cascades",
    "compose hard",
    "compose pcf",
    "compose esm",
    "compose csm",
    "compose evsm",
    "compose spsm",
    "compose dpm",
    "build a tree of contact",
    "build a tree of spheres",
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(case) = arguments.iter().position(|a| a == "--case") {
        run(&arguments[case + 1]);
        return ExitCode::SUCCESS;
    }
    let counts: Result<Vec<Count>, String> = CASES.iter().map(|case| count(case)).collect();
    match counts {
        Ok(counts) if arguments.iter().any(|a| a == "--json") => print_json(&counts),
        Ok(counts) => counts.iter().for_each(Count::print),
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

/// The only function that callgrind counts.
#[inline(never)]
fn measured<T>(work: impl FnOnce() -> T) -> T {
    black_box(work())
}

/// Calls `work` three times: the first time does not count, the second time instructions are, the third time
/// allocations, which are printed.
fn counted<T, E: std::fmt::Debug>(mut work: impl FnMut() -> Result<T, E>) {
    let mut work = || drop(black_box(work().unwrap()));
    work();
    measured(&mut work);
    println!("{}", allocation_counter::measure(work).count_total);
}

/// Runs a case.
fn run(case: &str) {
    let words: Vec<&str> = case.split([' ', ',']).collect();
    let views = if case.contains('4') { 4 } else { 1 };
    match words[0] {
        "prepare" => {
            let (gpu, mut map, views) = map(words[1], views);
            counted(|| map.prepare(&gpu.queue, &views));
        }
        "encode" => {
            let (gpu, mut map, views) = map(words[1], views);
            map.prepare(&gpu.queue, &views).unwrap();
            let encoder = |_| gpu.device.create_command_encoder(&Default::default());
            let mut encoders = [0; 3].map(encoder).into_iter();
            let mut used = Vec::with_capacity(3);
            counted(|| {
                used.extend(encoders.next());
                map.encode(used.last_mut().unwrap(), |_| ())
            });
        }
        "fit" => {
            let (light, fit) = (if case.contains("spot") { spot() } else { sun() }, camera_fit());
            counted(|| light.views(&fit, Cascades::new(views)));
        }
        "compose" => counted(|| shaders(words[1])),
        _ => {
            let geometry = procedural::by_name(words[4]).unwrap().scene(1).flatten();
            counted(|| Tracer::new(&geometry));
        }
    }
}

fn map(name: &str, views: u32) -> (&'static antumbra_testing::Gpu, ShadowMap, Vec<View>) {
    let gpu = antumbra_testing::gpu().expect("an adapter: make setup installs a software driver");
    let technique = technique::parse(name).unwrap();
    let options = Options::from(Size::square(256)).views(views);
    let map = ShadowMap::new(&gpu.device, technique.as_ref(), options).unwrap();
    (gpu, map, sun().views(&camera_fit(), Cascades::new(views)).unwrap())
}

fn spot() -> Light {
    Light::Spot { position: Vec3::new(0.0, 20.0, 0.0), direction: Vec3::NEG_Y, outer_angle: 0.6 }
}

fn sun() -> Light {
    Light::Directional { direction: Vec3::new(0.4, -1.0, 0.3) }
}

/// A camera at eye height on a plain.
fn camera_fit() -> CameraFit {
    let scene = Bounds { min: Vec3::new(-50.0, 0.0, -50.0), max: Vec3::new(50.0, 8.0, 50.0) };
    let camera = rh::proj::directx::perspective(0.9, 1.5, 0.1, 60.0)
        * rh::view::look_at_mat4(Vec3::new(0.0, 1.7, 20.0), Vec3::new(0.0, 1.5, 0.0), Vec3::Y);
    CameraFit { camera, scene, size: Size::square(256), margin_texels: 4.0, lean: false }
}

/// All shaders of a technique, the receiver's too.
fn shaders(name: &str) -> Result<Vec<String>, Unsupported> {
    let technique = technique::parse(name).unwrap();
    let (device, options) = (Capabilities::full(), Options::from(Size::square(256)));
    let shaders = Shader::all(technique.as_ref(), &device, &options, None)?.into_iter().map(|s| s.text);
    let receiver = ShaderText::receiver(technique.as_ref(), &device, &options, 1)?.text();
    Ok(shaders.chain([receiver]).collect())
}

/// What was counted of one case.
struct Count {
    case: &'static str,
    instructions: u64,
    allocations: u64,
    /// Lines of WGSL that were put together.
    lines: Option<usize>,
}

impl Count {
    fn print(&self) {
        let Self { case, instructions, allocations, lines } = self;
        let lines = lines.map(|lines| format!("{lines:6} lines")).unwrap_or_default();
        println!("{case:28} {instructions:12} instructions {allocations:7} allocations{lines}");
    }
}

/// Runs a case under callgrind.
fn count(case: &'static str) -> Result<Count, String> {
    let out = std::env::temp_dir().join(format!("antumbra-cpu-{}", std::process::id()));
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--collect-atstart=no", "--toggle-collect=*cpu*measured*"])
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(program)
        .args(["--case", case])
        // A tree is built by all threads: one alone counts the same whatever the machine.
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .map_err(|error| format!("valgrind: {error}; install it (apt-get install valgrind)"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("{case}: {said}"));
    }
    let profile = std::fs::read_to_string(&out).map_err(|error| format!("{}: {error}", out.display()))?;
    let _ = std::fs::remove_file(&out);
    let totals = profile.lines().find_map(|line| line.strip_prefix("totals: "));
    let instructions: u64 = totals.and_then(|n| n.trim().parse().ok()).unwrap_or(0);
    if instructions == 0 {
        return Err(format!("{case}: valgrind counted nothing: is the program stripped?"));
    }
    let composed =
        case.strip_prefix("compose ").map(shaders).transpose().map_err(|error| error.to_string())?;
    let lines = composed.map(|texts| texts.iter().map(|text| text.lines().count()).sum());
    let allocations = String::from_utf8_lossy(&output.stdout).trim().parse();
    let allocations = allocations.map_err(|error| format!("{case}: allocations: {error}"))?;
    Ok(Count { case, instructions, allocations, lines })
}

fn print_json(counts: &[Count]) {
    let row = |c: &Count| serde_json::json!([c.case, c.instructions, c.allocations, c.lines]);
    let rows: Vec<_> = counts.iter().map(row).collect();
    let table = serde_json::json!({ "schema": "antumbra-table/1", "key": "what",
        "columns": ["instructions", "allocations", "lines of WGSL"], "rows": rows });
    println!("{}", serde_json::to_string_pretty(&table).unwrap());
}
