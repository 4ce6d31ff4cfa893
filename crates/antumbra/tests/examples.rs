//! The examples, as a reader would run them, with what their pictures must show.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]
#![allow(clippy::duplicate_mod, reason = "each example is a program of its own and has its `common`")]

use antumbra_testing::{
    Gpu, Trials,
    image::{Image, Tolerance},
    settings,
};
use glam::{Mat4, Vec3};

macro_rules! example {
    ($name:ident, $path:literal) => {
        #[path = $path]
        #[allow(dead_code, unreachable_pub, reason = "its main is not called here")]
        mod $name;
    };
}
example!(quick_start, "../examples/quick_start.rs");
example!(hello, "../examples/hello.rs");
example!(own_shader, "../examples/own_shader.rs");
example!(own_depth, "../examples/own_depth.rs");
example!(reversed_depth, "../examples/reversed_depth.rs");
example!(two_lights, "../examples/two_lights.rs");
example!(two_tiles, "../examples/two_tiles.rs");
example!(triangles, "../examples/triangles.rs");
example!(cutouts, "../examples/cutouts.rs");
example!(compute, "../examples/compute.rs");
example!(skinning, "../examples/skinning.rs");

const WIDTH: u32 = 640;
const HEIGHT: u32 = 480;

/// Brightness of the pixel that sees a world point, 0 to 1.
fn at(picture: &[u8], camera: Mat4, point: Vec3) -> f32 {
    let ndc = camera.project_point3(point);
    assert!(ndc.x.abs() < 1.0 && ndc.y.abs() < 1.0, "{point} is out of the picture");
    let x = ((0.5 + 0.5 * ndc.x) * WIDTH as f32) as usize;
    let y = ((0.5 - 0.5 * ndc.y) * HEIGHT as f32) as usize;
    let pixel = &picture[4 * (y * WIDTH as usize + x)..][..3];
    pixel.iter().map(|c| f32::from(*c)).sum::<f32>() / (3.0 * 255.0)
}

/// Where the ground (y = 0) gets the shadow of a point, from a light in that direction.
fn on_ground(point: Vec3, towards_light: Vec3) -> Vec3 {
    point - towards_light * (point.y / towards_light.y)
}

fn check(picture: &[u8], camera: Mat4, lit: &[Vec3], shadowed: &[Vec3]) {
    assert_eq!(picture.len(), (4 * WIDTH * HEIGHT) as usize);
    for (l, s) in lit.iter().zip(shadowed) {
        let (light, dark) = (at(picture, camera, *l), at(picture, camera, *s));
        assert!(light > 0.35 && dark < 0.6 * light, "{l}: {light}, {s}: {dark}");
    }
}

fn hello(gpu: &Gpu) {
    let picture = hello::run(&gpu.device, &gpu.queue).unwrap();
    let sun = Vec3::new(-0.7, 1.0, 0.25);
    let slab = on_ground(Vec3::new(2.5, 1.2, 2.0), sun);
    let tower = on_ground(Vec3::new(0.5, 1.8, 0.0), sun);
    check(&picture, hello::camera(), &[Vec3::new(-3.0, 0.0, 3.0), Vec3::new(0.0, 0.0, 4.0)], &[slab, tower]);
}

/// What the README shows, near and far: two cascades at least.
fn quick_start(gpu: &Gpu) {
    let picture = quick_start::run(&gpu.device, &gpu.queue).unwrap();
    let shadow = |x, z| on_ground(Vec3::new(x, 1.5, z), Vec3::new(-0.7, 1.0, 0.25));
    check(
        &picture,
        quick_start::camera(),
        &[Vec3::new(-1.5, 0.0, 2.0), Vec3::new(2.0, 0.0, -9.0), Vec3::new(-2.0, 0.0, -22.0)],
        &[shadow(0.0, 0.0), shadow(4.0, -6.0), shadow(-4.0, -18.0)],
    );
}

/// The README's code is the code that runs.
fn readme() {
    let example = include_str!("../examples/quick_start.rs");
    let shown = example.split("// README\n").nth(1).unwrap();
    assert!(include_str!("../README.md").contains(shown), "the README shows other code than quick_start");
}

/// Every technique, in both halves, near and far: two cascades at least.
fn own_shader(gpu: &Gpu) {
    let names: Vec<&str> = antumbra::technique::all().iter().map(|t| t.about().name).collect();
    let last = [names[0], names[names.len() - 1]];
    let sun = Vec3::new(0.64, 0.64, 0.43);
    let shadow = |x, z| on_ground(Vec3::new(x, 2.0, z), sun);
    for pair in names.windows(2).step_by(2).map(|pair| [pair[0], pair[1]]).chain([last]) {
        let picture = own_shader::run(&gpu.device, &gpu.queue, pair).unwrap();
        check(
            &picture,
            own_shader::camera(),
            &[
                Vec3::new(-3.0, 0.0, 5.5),
                Vec3::new(2.0, 0.0, 5.5),
                Vec3::new(-4.0, 0.0, -5.0),
                Vec3::new(1.5, 0.0, -5.0),
            ],
            &[shadow(-1.2, 4.0), shadow(4.0, 4.0), shadow(-1.2, -6.0), shadow(4.0, -6.0)],
        );
    }
    // The techniques differ along the edges, so the halves cannot have been swapped or shared.
    let [picture, other] = [["hard", "csm"], ["csm", "hard"]]
        .map(|pair| own_shader::run(&gpu.device, &gpu.queue, pair).unwrap());
    let image = |bytes| Image { width: WIDTH, height: HEIGHT, channels: 4, bytes };
    image(picture).compare(&image(other), Tolerance { mean: 0.0, max: 0 }).unwrap_err();
}

fn own_depth(gpu: &Gpu) {
    lamp(&own_depth::run(&gpu.device, &gpu.queue).unwrap());
}

/// The same scene through another projection.
fn reversed_depth(gpu: &Gpu) {
    lamp(&reversed_depth::run(&gpu.device, &gpu.queue).unwrap());
}

/// Lit and shadowed ground around a post and a box under a lamp.
fn lamp(picture: &[u8]) {
    let lamp = Vec3::new(3.0, 5.0, 1.0);
    let shadow = |p: Vec3| on_ground(p, lamp - p);
    let lit = [Vec3::new(-2.0, 0.0, 2.0), Vec3::new(0.0, 0.0, 1.5)];
    check(
        picture,
        own_depth::camera(),
        &lit,
        &[shadow(Vec3::new(0.0, 1.2, 0.0)), shadow(Vec3::new(0.9, 0.7, 1.9))],
    );
}

/// Each lamp's shadow lacks its own colour alone, the sun's takes from both.
fn two_lights(gpu: &Gpu) {
    let picture = two_lights::run(&gpu.device, &gpu.queue).unwrap();
    let top = Vec3::new(0.0, 1.2, 0.0);
    let colour = |point: Vec3| -> [f32; 2] {
        let ndc = two_lights::camera().project_point3(point);
        let [x, y] = [(0.5 + 0.5 * ndc.x) * WIDTH as f32, (0.5 - 0.5 * ndc.y) * HEIGHT as f32];
        let pixel = 4 * (y as usize * WIDTH as usize + x as usize);
        [picture[pixel], picture[pixel + 2]].map(f32::from)
    };
    let [red, blue] = two_lights::LAMPS.map(|lamp| colour(on_ground(top, lamp - top)));
    let sun = colour(on_ground(top, -two_lights::SUN));
    let [left, right] = [-0.9, 0.9].map(|x| colour(Vec3::new(x, 0.0, 0.9)));
    assert!(red[0] < 0.7 * left[0] && red[1] > 0.8 * left[1], "{red:?} {left:?}");
    assert!(blue[1] < 0.7 * right[1] && blue[0] > 0.8 * right[0], "{blue:?} {right:?}");
    let lit = colour(Vec3::new(0.0, 0.0, -2.2));
    assert!(sun[0] < 0.9 * lit[0] && sun[1] < 0.9 * lit[1], "{sun:?} {lit:?}");
}

/// Each lamp's shadow lacks its own colour alone, though both lie in one layer.
fn two_tiles(gpu: &Gpu) {
    let picture = two_tiles::run(&gpu.device, &gpu.queue).unwrap();
    let top = Vec3::new(0.0, 1.2, 0.0);
    let colour = |point: Vec3| -> [f32; 2] {
        let ndc = two_tiles::camera().project_point3(point);
        let [x, y] = [(0.5 + 0.5 * ndc.x) * WIDTH as f32, (0.5 - 0.5 * ndc.y) * HEIGHT as f32];
        let pixel = 4 * (y as usize * WIDTH as usize + x as usize);
        [picture[pixel], picture[pixel + 2]].map(f32::from)
    };
    let [red, blue] = two_tiles::LAMPS.map(|lamp| colour(on_ground(top, lamp - top)));
    let [left, right] = [-0.9, 0.9].map(|x| colour(Vec3::new(x, 0.0, 0.9)));
    assert!(red[0] < 0.6 * left[0] && red[1] > 0.8 * left[1], "{red:?} {left:?}");
    assert!(blue[1] < 0.6 * right[1] && blue[0] > 0.8 * right[0], "{blue:?} {right:?}");
}

/// The rail and the box that moved, by every technique that keeps triangles; bars that are finer than texels, by
/// the one that keeps all. What keeps depth is refused.
fn triangles(gpu: &Gpu) {
    let sun = Vec3::new(-0.7, 1.0, 0.25);
    let camera = triangles::camera();
    let lit = Vec3::new(3.5, 0.0, 3.0);
    let shadow = |x, y, z| on_ground(Vec3::new(x, y, z), sun);
    for spec in settings::keeping_triangles() {
        let picture = triangles::run(&gpu.device, &gpu.queue, spec).unwrap();
        check(&picture, camera, &[lit, lit], &[shadow(0.0, 2.0, 1.5), shadow(-2.5, 0.9, 1.0)]);
        if spec == "exact" {
            let between = shadow(0.0, 1.0, 1.0);
            check(&picture, camera, &[between, between], &[shadow(0.0, 1.0, 0.8), shadow(0.0, 1.0, 1.2)]);
        }
    }
    let error = triangles::run(&gpu.device, &gpu.queue, "pcf").unwrap_err().to_string();
    assert!(error.contains("pcf keeps depth"), "{error}");
}

/// Light through the card's holes, and shadows between them, for techniques of all families.
fn cutouts(gpu: &Gpu) {
    let sun = Vec3::new(-0.7, 1.0, 0.25);
    let below = |x, z| on_ground(cutouts::CARD.0 + Vec3::new(x, 0.0, z), sun);
    for spec in ["hard", "pcf", "vsm"].into_iter().chain(settings::keeping_triangles()) {
        let picture = cutouts::run(&gpu.device, &gpu.queue, spec).unwrap();
        let holes = [below(0.5, 0.5), below(1.5, 1.5)];
        check(&picture, cutouts::camera(), &holes, &[below(1.0, 1.0), below(0.0, 1.0)]);
    }
}

/// From above: fog is dark where it is in shadow all the way up, and lit elsewhere.
fn compute(gpu: &Gpu) {
    let picture = compute::run(&gpu.device, &gpu.queue).unwrap();
    let sun = Vec3::new(-0.7, 1.0, 0.25);
    // Under the slab, and half way down the shadow of the tower.
    let slab = on_ground(Vec3::new(1.5, 0.9, -1.0), sun);
    let tower = on_ground(Vec3::new(-2.7, 0.3, 1.0), sun);
    let lit = [Vec3::new(-6.0, 0.0, 3.0), Vec3::new(5.0, 0.0, 4.0)];
    check(&picture, compute::camera(), &lit, &[slab, tower]);
}

/// The column's shadow bends with it, for techniques whose casters leave depth, and triangles.
fn skinning(gpu: &Gpu) {
    for spec in ["vsm", "stratified"].into_iter().chain(settings::keeping_triangles()) {
        let picture = skinning::run(&gpu.device, &gpu.queue, spec).unwrap();
        let sun = Vec3::new(-0.7, 1.0, 0.25);
        // Above the knee at rest, and as far above it along the bent half.
        let upright = on_ground(Vec3::new(0.0, 3.5, 0.0), sun);
        let bent = on_ground(Vec3::new(0.0, 2.0 + 1.5 * 0.9_f32.cos(), 1.5 * 0.9_f32.sin()), sun);
        check(&picture, skinning::camera(), &[upright, Vec3::new(-3.0, 0.0, 3.0)], &[bent, bent]);
    }
}

fn main() {
    let mut trials = Trials::default();
    trials.add("quick_start", quick_start);
    trials.add_plain("the README's code is quick_start's", readme);
    trials.add("hello", hello);
    trials.add("own_shader", own_shader);
    trials.add("own_depth", own_depth);
    trials.add("reversed_depth", reversed_depth);
    trials.add("two_lights", two_lights);
    trials.add("two_tiles", two_tiles);
    trials.add("triangles", triangles);
    trials.add("cutouts", cutouts);
    trials.add("compute", compute);
    trials.add("skinning", skinning);
    trials.run();
}
