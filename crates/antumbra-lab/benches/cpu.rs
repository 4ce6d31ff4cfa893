//! What the processor does: instructions and allocations, counted by valgrind, so that they are the same on every
//! run but for what drivers and maps with random seeds add. `make bench-cpu` prints them, `-- --json` as a
//! result file wants them.
//!
//! Each case runs in a process of its own under callgrind, which counts only inside [`measured`]: all threads' work
//! of one call, wgpu's share included, after a first call that does not count where later ones are cheaper.

#![allow(clippy::unwrap_used, reason = "benchmarks fail by panicking")]

use antumbra::{
    Bounds, CameraFit, Capabilities, Cascades, Light, Options, Shader, ShaderText, ShadowMap, Size, View,
    technique,
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
        println!("{}", run(&arguments[case + 1]));
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

/// The only function that is counted.
#[inline(never)]
fn measured<T>(work: impl FnOnce() -> T) -> T {
    black_box(work())
}

/// Runs a case; lines of WGSL that it put together, if it did.
fn run(case: &str) -> usize {
    let words: Vec<&str> = case.split([' ', ',']).collect();
    let views = if case.contains('4') { 4 } else { 1 };
    match words[0] {
        "prepare" => prepare(words[1], views),
        "encode" => encode(words[1], views),
        "fit" => fit(case, views),
        "compose" => return compose(words[1]),
        _ => {
            let geometry = procedural::by_name(words[4]).unwrap().scene(1).flatten();
            measured(|| Tracer::new(&geometry)).unwrap();
        }
    }
    0
}

fn map(name: &str, views: u32) -> (&'static antumbra_testing::Gpu, ShadowMap, Vec<View>) {
    let gpu = antumbra_testing::gpu().expect("an adapter: make setup installs a software driver");
    let technique = technique::parse(name).unwrap();
    let options = Options::from(Size::square(256)).views(views);
    let map = ShadowMap::new(&gpu.device, technique.as_ref(), options).unwrap();
    (gpu, map, sun().views(&camera_fit(), Cascades::new(views)).unwrap())
}

fn prepare(name: &str, views: u32) {
    let (gpu, mut map, views) = map(name, views);
    map.prepare(&gpu.queue, &views).unwrap();
    measured(|| map.prepare(&gpu.queue, &views)).unwrap();
}

fn encode(name: &str, views: u32) {
    let (gpu, mut map, views) = map(name, views);
    map.prepare(&gpu.queue, &views).unwrap();
    let [mut first, mut second] = [0; 2].map(|_| gpu.device.create_command_encoder(&Default::default()));
    map.encode(&mut first, |_| ()).unwrap();
    measured(|| map.encode(&mut second, |_| ())).unwrap();
}

fn fit(case: &str, views: u32) {
    let cascades = Cascades::new(views);
    if case.contains("spot") {
        let (position, direction) = (Vec3::new(0.0, 20.0, 0.0), Vec3::NEG_Y);
        let spot = Light::Spot { position, direction, outer_angle: 0.6 };
        measured(|| spot.views(&camera_fit(), cascades)).unwrap();
    } else {
        measured(|| sun().views(&camera_fit(), cascades)).unwrap();
    }
}

fn sun() -> Light {
    Light::Directional { direction: Vec3::new(0.4, -1.0, 0.3) }
}

/// A camera at eye height on a plain.
fn camera_fit() -> CameraFit {
    let scene = Bounds { min: Vec3::new(-50.0, 0.0, -50.0), max: Vec3::new(50.0, 8.0, 50.0) };
    let camera = rh::proj::directx::perspective(0.9, 1.5, 0.1, 60.0)
        * rh::view::look_at_mat4(Vec3::new(0.0, 1.7, 20.0), Vec3::new(0.0, 1.5, 0.0), Vec3::Y);
    CameraFit { camera, scene, size: Size::square(256), margin_texels: 4.0 }
}

/// All shaders of a technique, the receiver's too.
fn compose(name: &str) -> usize {
    let technique = technique::parse(name).unwrap();
    let (device, options) = (Capabilities::full(), Options::from(Size::square(256)));
    let (shaders, receiver) = measured(|| {
        let shaders = Shader::all(technique.as_ref(), &device, &options, None).unwrap();
        (shaders, ShaderText::receiver(technique.as_ref(), &device, &options, 1).unwrap())
    });
    let texts = shaders.iter().map(|shader| shader.text.lines().count());
    texts.sum::<usize>() + receiver.text().lines().count()
}

/// What was counted of one case.
struct Count {
    case: &'static str,
    instructions: u64,
    allocations: u64,
    lines: u64,
}

impl Count {
    fn print(&self) {
        let Self { case, instructions, allocations, lines } = self;
        let lines = if *lines > 0 { format!("{lines:6} lines") } else { String::new() };
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
    let lines = String::from_utf8_lossy(&output.stdout).trim().parse().unwrap_or(0);
    Ok(Count { case, instructions, allocations: allocations(&profile), lines })
}

/// Calls of the allocator in a profile: `cfn=` names who is called, by number after the first time, and
/// `calls=` says how often.
fn allocations(profile: &str) -> u64 {
    const ALLOCATORS: [&str; 5] = ["malloc", "calloc", "realloc", "posix_memalign", "aligned_alloc"];
    let mut ids = std::collections::HashSet::new();
    let (mut count, mut allocates) = (0, false);
    for line in profile.lines() {
        if let Some(name) = line.strip_prefix("fn=").or_else(|| line.strip_prefix("cfn=")) {
            let (id, name) = name.split_once(' ').unwrap_or((name, ""));
            if ALLOCATORS.contains(&name) {
                ids.insert(id);
            }
            allocates = line.starts_with("cfn=") && ids.contains(id);
        } else if let Some(calls) = line.strip_prefix("calls=").filter(|_| allocates) {
            count += calls.split(' ').next().and_then(|n| n.parse::<u64>().ok()).unwrap_or(0);
        }
    }
    count
}

fn print_json(counts: &[Count]) {
    let row = |count: &Count| {
        let lines = (count.lines > 0).then_some(count.lines);
        serde_json::json!([count.case, count.instructions, count.allocations, lines])
    };
    let rows: Vec<_> = counts.iter().map(row).collect();
    let table = serde_json::json!({ "schema": "antumbra-table/1", "key": "what",
        "columns": ["instructions", "allocations", "lines of WGSL"], "rows": rows });
    println!("{}", serde_json::to_string_pretty(&table).unwrap());
}
