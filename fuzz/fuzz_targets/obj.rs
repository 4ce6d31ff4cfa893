#![no_main]

mod scene;

const LIBRARY: &[u8] = b"newmtl a\nKd 1 0 0\nmap_Kd a.png\nnewmtl b\nd 0.2\n";

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    scene::check(antumbra_scene::import::obj_bytes(bytes, &[("a.mtl", LIBRARY)], "fuzz"));
});
