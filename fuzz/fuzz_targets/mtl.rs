#![no_main]

mod scene;

const FILE: &[u8] = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nusemtl a\nf 1/1 2/2 3/3\n\
usemtl b\nf 1/1 2/2 3/3\n";
const IMAGE: &[u8] = include_bytes!("../seeds/half.png");

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let others = [("a.mtl", bytes), ("a.png", IMAGE), ("b.png", IMAGE)];
    scene::check(antumbra_scene::import::obj_bytes(FILE, &others, "fuzz"));
});
