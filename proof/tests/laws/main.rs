//! Techniques from outside keep the laws, which notice what is wrong with broken ones.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod broken;

use antumbra::{
    Capabilities, Capacity, Description, Options, Shader, ShaderText, ShadowMap, Size, Technique, technique,
    technique::Constant,
};
use antumbra_proof::{Exponential, Plane};
use antumbra_testing::{
    Gpu, Trials,
    ask::{Random, Receiver, depth_texture, shadow_map, visibility},
    broken::Broken,
    laws,
};

const SIZE: Size = Size::square(32);

/// The exponential shadow map answers as the library's own does, to the bit.
fn answers(gpu: &Gpu) {
    let mut random = Random::new(1);
    let depths: Vec<f32> = (0..SIZE.width * SIZE.height).map(|_| random.unit()).collect();
    let depth = depth_texture(gpu, SIZE, |x, y| depths[(y * SIZE.width + x) as usize]);
    let receivers: Vec<Receiver> =
        (0..1024).map(|_| Receiver::point(random.unit(), random.unit(), random.unit())).collect();
    let ask = |technique: &dyn Technique| {
        visibility(gpu, &shadow_map(gpu, technique, &depth, SIZE.into()), &receivers)
    };
    let esm = technique::parse("esm.c=60,classifier=none").unwrap();
    let expected = ask(esm.as_ref());
    assert_eq!(ask(&Exponential::new(60.0)), expected);
    assert_ne!(ask(&Exponential::new(59.0)), expected);
}

/// What is wrong with a description is said wherever it is composed, in release too.
fn refusals(gpu: &Gpu) {
    type Edit = fn(&mut Description);
    let wrong: [(Edit, &[&str]); 5] = [
        (|d| d.wgsl = "//! needs nothing_there".into(), &["'nothing_there'", "lookup_fitted"]),
        (|d| d.slots.clear(), &["slot 'lookup'", "lookup_bilinear", "Description::slots"]),
        (|d| d.constants.push(Constant::Count("terms", 2)), &["'terms' 0 times", "const terms"]),
        (|d| d.maps.clear(), &["binds map 0", "has 0", "Description::maps"]),
        (|d| d.sample_offsets.clear(), &["no sample offsets"]),
    ];
    for (edit, words) in wrong {
        let technique = Broken::of(&Exponential::new(60.0)).with(edit);
        let (device, options) = (Capabilities::of(&gpu.device), Options::from(SIZE));
        let error = ShadowMap::new(&gpu.device, &technique, SIZE).unwrap_err();
        let message = error.to_string();
        let said = words.iter().all(|word| message.contains(word));
        assert!(said && message.starts_with("the description of exponential is wrong: "), "{message}");
        assert_eq!(ShaderText::receiver(&technique, &device, &options, 0).unwrap_err(), error);
        assert_eq!(Shader::all(&technique, &device, &options, None).unwrap_err(), error);
    }
}

/// Memory and counts of a store are told as of the library's own.
fn tells_what_it_keeps(gpu: &Gpu) {
    let capacity = Capacity { triangles: 100, ..Capacity::default() };
    let options = Options::from(Size::square(16)).views(2).capacity(capacity);
    let shadows = ShadowMap::new(&gpu.device, &Plane::default(), options).unwrap();
    let memory = shadows.memory();
    let bytes = |name: &str| memory.items.iter().find(|i| i.name == name).map_or(0, |i| i.bytes);
    assert_eq!([bytes("first keys"), bytes("first vertices")], [2 * 4 * 16 * 16, 2 * 48 * 100]);
    assert!(shadows.explain().iter().any(|line| line == "the first triangle of each texel"));
    assert!(shadows.description().storage.keeps_ids());
}

/// A file that does not exist is named, with those that do.
fn missing_files_are_named(gpu: &Gpu) {
    let needy = Plane { store: &broken::NEEDY };
    let error = ShadowMap::new(&gpu.device, &needy, Size::square(16)).unwrap_err().to_string();
    assert!(error.contains("plane") && error.contains("keyhole") && error.contains("coverage"), "{error}");
}

fn main() {
    let mut trials = Trials::default();
    let (exponential, plane) = (Exponential::new(60.0), Plane::default());
    laws::add(&mut trials, "exponential", &exponential);
    laws::add(&mut trials, "plane", &plane);
    for (fault, law, broken) in broken::all(&exponential, &plane) {
        laws::add_rejected(&mut trials, fault, law, broken.as_ref());
    }
    trials.add("it answers as the library's own", answers);
    trials.add("what is wrong with a description is named", refusals);
    trials.add("a store tells what it keeps", tells_what_it_keeps);
    trials.add("files that a store needs and nobody has", missing_files_are_named);
    trials.run();
}
