//! Flicker on small scenes: what is known must come out, and what is broken must be seen.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{Technique, technique, technique::Bias};
use antumbra_lab::{
    flicker::{self, Promise, Request, Results, TechniqueFlicker},
    gpu::{Gpu, Wait},
    motion::{Frame, Path},
    progress::NoProgress,
    readback,
    shot::Shot,
};
use antumbra_render::GpuScene;
use antumbra_scene::{Camera, procedural};
use antumbra_testing::{Trials, broken::Broken};
use std::sync::Arc;

fn main() {
    let mut trials = Trials::default();
    trials.add("sub_pixel_shadow_maps_hardly_flicker_where_polygons_are_large", |gpu| {
        let both = request("contact", Path::Both, &["hard", "spsm"]);
        let shot = Shot { resolution: [240, 180], ..both.shot.clone() };
        let results = run(gpu, &Request { shot, frames: 9, until: 9, ..both });
        let ratio = of(&results, "spsm").ratio_to_hard.unwrap();
        // Measured: 0.093. Centres, which tell where no kept triangle does, round the corners of polygons.
        assert!(ratio < 0.15, "{ratio}");
        assert_eq!(of(&results, "hard").ratio_to_hard, Some(1.0));
    });
    trials.add("a_lookup_that_depends_on_where_the_map_is_flickers_more", |gpu| {
        let [whole, broken] = [hard(), wobbling()].map(|technique| run(gpu, &close_up(technique)));
        let [whole, broken] = [&whole, &broken].map(|results| of(results, "hard"));
        let flicker = |t: &TechniqueFlicker| t.flicker[&Promise::Hard].mean;
        let crawl = |t: &TechniqueFlicker| t.crawl[&Promise::Hard].mean;
        assert!(flicker(broken) > 1.3 * flicker(whole), "{} {}", flicker(broken), flicker(whole));
        assert!(crawl(broken) > 5.0 * crawl(whole), "{} {}", crawl(broken), crawl(whole));
    });
    trials.add("surfaces_rest_while_the_map_moves_by_whole_texels", |gpu| {
        let still = |results: &Results| {
            let frames = &of(results, "hard").crawl[&Promise::Hard].frames;
            (frames.iter().filter(|mean| **mean < 2e-4).count(), frames.len())
        };
        let whole = run(gpu, &close_up(hard()));
        let (resting, of_all) = still(&whole);
        assert!(resting > 0 && resting + whole.texel_changes as usize >= of_all, "{whole:?}");
        let (resting, _) = still(&run(gpu, &close_up(wobbling())));
        assert!(resting < of_all, "the map moves, so that a wobble shows");
    });
    trials.add("picture_and_surfaces_are_one_while_only_the_light_moves", |gpu| {
        let results = run(gpu, &request("contact", Path::Light, &["hard", "pcf"]));
        for technique in &results.techniques {
            for promise in [Promise::Hard, Promise::LightSpace] {
                assert_eq!(technique.flicker[&promise], technique.crawl[&promise], "{}", technique.spec);
            }
            assert!(technique.flicker[&Promise::Hard].mean > 0.0);
        }
    });
    trials.add("filters_keep_their_own_promise_better", |gpu| {
        let results = run(gpu, &request("spheres", Path::Both, &["hard", "pcf"]));
        let pcf = of(&results, "pcf");
        assert_eq!(pcf.promise, Promise::LightSpace);
        assert!(pcf.flicker[&Promise::LightSpace].mean < pcf.flicker[&Promise::Hard].mean);
        assert!(results.ideal_against_hard > 0.0);
    });
    trials.add("what_recedes_is_judged_by_its_mean_over_pixels", |gpu| {
        let results = run(gpu, &request("contact", Path::Recede, &["hard", "csm.terms=4"]));
        assert!(results.techniques.iter().all(|t| t.promise == Promise::ScreenSpace));
    });
    trials.add("a_scene_that_looks_elsewhere_draws_what_a_new_one_draws", elsewhere);
    trials.add("bad_requests_are_refused_by_name", bad_requests);
    trials.add("the_page_is_whole_and_stands_alone", page);
    trials.run();
}

/// A scene that looks elsewhere draws what a new one draws.
fn elsewhere(gpu: &antumbra_testing::Gpu) {
    let (gpu, own) = (adopt(gpu), request("spheres", Path::Both, &[]));
    let frames = Path::Both.frames(&own.shot.camera, &own.shot.light, 2).unwrap();
    let upload = |camera: &Camera, light| {
        GpuScene::new(&gpu, &own.shot.geometry, camera, light, own.shot.resolution).unwrap()
    };
    let draw = |scene: &GpuScene| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        scene.encode_surfaces(&mut encoder, None);
        gpu.finish(encoder).unwrap();
        readback::positions(&gpu, scene.surfaces()).unwrap()
    };
    let mut moved = upload(&frames[0].camera, &frames[0].light);
    let before = draw(&moved);
    let there = upload(&frames[1].camera, &frames[1].light);
    let Frame { camera, light } = frames[1];
    assert_eq!(moved.camera_matrix_of(&own.shot.geometry, &camera, &light), there.camera_matrix());
    moved.look(&gpu, &own.shot.geometry, &camera, &light);
    assert_eq!(moved.camera_matrix(), there.camera_matrix());
    assert!(draw(&moved) == draw(&there) && draw(&moved) != before);
}

/// Requests without frames, pixels or techniques are refused.
fn bad_requests(gpu: &antumbra_testing::Gpu) {
    let good = || request("contact", Path::Both, &["hard"]);
    let refused = |request: Request, words: &str| {
        let error = flicker::measure(&adopt(gpu), &request, &NoProgress).unwrap_err();
        assert!(format!("{error:#}").contains(words), "{error:#}");
    };
    refused(Request { frames: 1, ..good() }, "1 frames show no motion");
    refused(Request { frames: 0, ..good() }, "allowed are 2 to 10000");
    refused(Request { until: 6, ..good() }, "6 measured frames: allowed are 2 to the 5");
    refused(Request { until: 1, ..good() }, "1 measured frames");
    refused(Request { stride: 0, ..good() }, "a stride of 0 pixels");
    refused(Request { stride: 73, ..good() }, "allowed are 1 to 72");
    refused(Request { techniques: Vec::new(), ..good() }, "no technique");
}

/// The page is written whole, and again over itself.
fn page(gpu: &antumbra_testing::Gpu) {
    let outcome = measure(gpu, &request("contact", Path::Both, &["hard", "esm"]));
    let folder = std::env::temp_dir().join(format!("antumbra-flicker-{}", std::process::id()));
    for _ in 0..2 {
        flicker::write(&outcome, &folder).unwrap();
    }
    let page = std::fs::read_to_string(folder.join("index.html")).unwrap();
    let data = std::fs::read_to_string(folder.join("flicker.json")).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let read: Results = serde_json::from_str(&data).unwrap();
    assert_eq!(read.techniques.len(), 2);
    for file in ["index.html", "film.png", "strip.png", "row.png", "hard-heat.png"] {
        assert!(read.files.iter().any(|name| name == file), "{file}: {:?}", read.files);
    }
    assert_eq!(page.matches("data:image/png;base64,").count(), 5);
    assert!(!page.contains("src=\"http") && !page.contains("{{"));
}

fn request(scene: &str, path: Path, techniques: &[&str]) -> Request {
    let scene = procedural::by_name(scene).unwrap().scene(1);
    Request {
        shot: Shot {
            name: scene.name.clone(),
            camera: scene.main_camera(),
            light: scene.main_light(),
            geometry: Arc::new(scene.flatten()),
            tree: Default::default(),
            resolution: [96, 72],
            map_size: 256,
            kernel: 5,
            cascades: 1,
            bias: Bias::Auto,
        },
        path,
        frames: 5,
        until: 5,
        techniques: techniques.iter().map(|spec| technique::parse(spec).unwrap()).collect(),
        stride: 2,
        grid: 3,
        command: Vec::new(),
    }
}

fn hard() -> Box<dyn Technique> {
    technique::parse("hard").unwrap()
}

/// Takes a neighbouring texel here and there, depending on where in the map a point lies.
fn wobbling() -> Box<dyn Technique> {
    let wobble = "floor(uv * size + 0.5 * sign(sin(1e5 * uv.x)))";
    Box::new(Broken::saying("hard", "floor(uv * size)", wobble))
}

/// The camera moves close to things, so that the light's view has to follow it.
fn close_up(technique: Box<dyn Technique>) -> Request {
    let far = request("spheres", Path::Camera, &[]);
    let own = far.shot.camera;
    let camera = Camera { position: own.target.lerp(own.position, 0.5), ..own };
    let shot = Shot { camera, ..far.shot.clone() };
    Request { shot, frames: 9, until: 9, techniques: vec![technique], ..far }
}

fn adopt(gpu: &antumbra_testing::Gpu) -> Gpu {
    Gpu::adopt(gpu.device.clone(), gpu.queue.clone(), gpu.info.clone())
}

fn measure(gpu: &antumbra_testing::Gpu, request: &Request) -> flicker::Outcome {
    flicker::measure(&adopt(gpu), request, &NoProgress).unwrap()
}

fn run(gpu: &antumbra_testing::Gpu, request: &Request) -> Results {
    measure(gpu, request).results
}

fn of<'a>(results: &'a Results, name: &str) -> &'a TechniqueFlicker {
    results.techniques.iter().find(|technique| technique.name == name).unwrap()
}
