#![no_main]

mod scene;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| scene::check(antumbra_scene::import::gltf_bytes(bytes, "fuzz")));
