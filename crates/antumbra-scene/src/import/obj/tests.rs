//! Files as programs write them, and as they should not.

use super::super::options::Blend;
use super::*;
use crate::{AlphaMode, export};
use std::path::PathBuf;

fn parse(text: &str) -> Result<Scene, Problem> {
    import_bytes(text.as_bytes(), &[], "test", Blend::default())
}

/// A folder that is gone with the value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &[u8])]) -> Self {
        let path = std::env::temp_dir().join(format!("antumbra-obj-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        files.iter().for_each(|(name, bytes)| fs::write(path.join(name), bytes).unwrap());
        Self(path)
    }

    fn load(&self, name: &str) -> Scene {
        self.load_with(name, Blend::default())
    }

    fn load_with(&self, name: &str, blend: Blend) -> Scene {
        import(&self.0.join(name), blend).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\nvt 0.25 0.25\nvn 0 0 1\n";

#[test]
fn polygons_objects_and_relative_numbers() {
    let text = format!("{SQUARE}f 1/1/1 2/1/1 3/1/1 4/1/1 # a quad\no other\nf -4 -3 \\\n-2\nl 1 2\n");
    let scene = parse(&text).unwrap();
    assert_eq!(scene.meshes.len(), 2);
    assert_eq!(scene.meshes[0].indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(scene.meshes[0].uvs[0], Vec2::new(0.25, 0.75));
    assert_eq!(scene.meshes[0].colors[1].x, 0.5);
    assert_eq!(scene.meshes[1].normals, [Vec3::Z; 3], "flat, as the file has none");
    assert_eq!(scene.notes, ["1 points and lines are left out, as they have no area (line 11 first)"]);
}

#[test]
fn bad_lines_are_named() {
    let refusal = |line: &str| parse(&format!("{SQUARE}{line}\n")).unwrap_err().to_string();
    assert_eq!(
        refusal("f 1 2 5"),
        "line 7: '5' of corner 5 is no vertex; allowed here are 1 to 4 and -1 to -4"
    );
    assert!(refusal("f 1 2 9223372036854775807").contains("allowed here are 1 to 4"));
    assert!(refusal("f 0 1 2").contains("'0' of corner 0 is no vertex"));
    assert!(refusal("f 1/2 2 3").contains("allowed here are 1 to 1"));
    assert!(refusal("f 1 2 -5").contains("'-5' of corner -5"));
    assert!(refusal("f 1 2 /1").contains("corner is '/1'; it must begin with the number of a position"));
    assert_eq!(refusal("v 0 nan 0"), "line 7: number of 'v' is 'nan'; it must be finite");
    assert!(refusal("v 0 0,5 0").ends_with("replace commas by points"));
    assert_eq!(refusal("v 0 1"), "line 7: 'v' is 2 numbers long; it needs at least 3");
    assert!(refusal("f 1 2").contains("no triangles") && refusal("f 1 2").contains("fewer than three"));
    assert!(refusal("p 1 2 3").contains("1 points and lines are left out"));
}

/// All say the same: a square in one material.
#[test]
fn one_square_in_many_hands() {
    let plain = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let positions = |text: &str| parse(text).unwrap().flatten().positions;
    let expected = positions(plain);
    for text in [
        plain.replace('\n', "\r"),
        plain.replace('\n', "\r\n"),
        format!("\u{feff}{plain}"),
        plain.replace("v 1 1", "\u{feff}v 1 1"),
        plain.to_uppercase(),
        plain.replace(' ', "\t"),
        plain.replace("3 4", "\\\n 3 4"),
        plain.replace("3 4", "\\\r\n 3 4"),
        plain.replace("1 2 3 4", "1// 2// 3// 4//"),
        plain.replace("v 1 0 0", "v 1.0E+00 0d0 0.0e0"),
        plain.replace("v 1 0 0", "v 1 0 0 2.0"),
        format!("f 1 2 3 4\n{}", plain.replace("f 1 2 3 4\n", "")),
        plain.replace("f 1", "usemtl\nf 1"),
        plain.replace("f 1", "# made by \\\nf 1"),
        plain.replace("f 1 2 3 4", "vt nan 0\nvn -nan(ind) nan 1.#QNAN\nf 1/1/1 2/1/1 3/1/1 4/1/1"),
    ] {
        let found = positions(&text);
        assert!(found.iter().all(|p| expected.contains(p)) && found.len() >= 4, "{text:?}: {found:?}");
        let scene = parse(&text).unwrap();
        assert_eq!(scene.flatten().triangle_count(), 2, "{text:?}");
        assert!(scene.meshes[0].normals.iter().all(|n| *n == Vec3::Z), "{text:?}");
    }
}

#[test]
fn what_is_left_out_is_told_once_for_each_kind() {
    let text =
        format!("{SQUARE}f 1 2 3\np 1\nl 1 2\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2\nwhat is this\nwhat\ns off\n");
    let notes = parse(&text).unwrap().notes;
    assert_eq!(
        notes,
        [
            "2 lines begin with unknown words and are left out (line 12 first)",
            "2 points and lines are left out, as they have no area (line 8 first)",
            "2 statements of curved surfaces are left out; export polygons to see them (line 10 first)",
        ]
    );
}

#[test]
fn concave_faces_and_their_holes_stay_open() {
    // A U of 12 square units, and nothing across its opening.
    let text =
        "v -3 2 -2\nv -3 2 2\nv 3 2 2\nv 3 2 -2\nv 2 2 -2\nv 2 2 1\nv -2 2 1\nv -2 2 -2\nf 1 2 3 4 5 6 7 8\n";
    let geometry = parse(text).unwrap().flatten();
    let area = |t: usize| {
        let [a, b, c] = geometry.triangle(t);
        0.5 * (b - a).cross(c - a)
    };
    let sum: Vec3 = (0..geometry.triangle_count()).map(area).sum();
    let covered: f32 = (0..geometry.triangle_count()).map(|t| area(t).length()).sum();
    assert!((covered - 12.0).abs() < 1e-5 && (sum.y - 12.0).abs() < 1e-5, "{sum} {covered}");
    let crossed = parse("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nf 1 2 3 4\n").unwrap();
    assert_eq!(crossed.notes, ["1 faces have no area or an outline that crosses itself"]);
}

#[test]
fn positions_far_away_keep_their_places() {
    let square = |x: f64, y: f64| {
        let v = |dx: f64, dy: f64| format!("v {} {} 0\n", x + dx, y + dy);
        [v(0.0, 0.0), v(0.01, 0.0), v(0.01, 0.01), v(0.0, 0.01), "f 1 2 3 4\n".into()].concat()
    };
    let near = parse(&square(0.0, 0.0)).unwrap();
    let far = parse(&square(500_000.25, 5_400_000.125)).unwrap();
    assert!(far.placement.origin.y > 5e6 && near.placement.origin == DVec3::ZERO);
    let places = |scene: &Scene, x: f64, y: f64| -> Vec<DVec3> {
        let shift = DVec3::new(x, y, 0.0);
        scene.flatten().positions.iter().map(|p| scene.placement.in_file(*p) - shift).collect()
    };
    for (a, b) in places(&near, 0.0, 0.0).into_iter().zip(places(&far, 500_000.25, 5_400_000.125)) {
        assert!(a.distance(b) < 1e-8, "{a} {b}");
    }
}

const RED: &[u8] = b"newmtl red\nKd 0.9 0.1 0.1\n";

fn square_in(material: &str, library: &str) -> Vec<u8> {
    format!("mtllib {library}\n{SQUARE}usemtl {material}\nf 1/1 2/1 3/1\n").into_bytes()
}

#[test]
fn libraries_are_found_and_read_once() {
    let mut bom = b"\xef\xbb\xbf".to_vec();
    bom.extend(RED);
    let utf16: Vec<u8> = [0xff, 0xfe].into_iter().chain(RED.iter().flat_map(|b| [*b, 0])).collect();
    let folder = Folder::new(
        "libraries",
        &[
            ("red.mtl", RED),
            ("my red.mtl", RED),
            ("blue.mtl", b"newmtl blue\nKd 0 0 1\n"),
            ("bom.mtl", &bom),
            ("utf16.mtl", &utf16),
            ("tab.mtl", b"newmtl\tred\r\n\tKD\t0.9\t0.1\t0.1\t\r\n"),
            ("twice.mtl", b"newmtl red\nKd 0.9 0.1 0.1\nnewmtl red\nKd 0 1 0\n"),
        ],
    );
    for (library, count) in [
        ("red.mtl", 1),
        ("blue.mtl red.mtl", 2),
        ("red.mtl red.mtl", 1),
        ("red.mtl\nmtllib red.mtl", 1),
        ("my red.mtl", 1),
        ("\"my red.mtl\"", 1),
        ("blue.mtl my red.mtl", 2),
        ("bom.mtl", 1),
        ("utf16.mtl", 1),
        ("tab.mtl", 1),
        ("RED.MTL", 1),
        (".\\Red.mtl", 1),
        ("C:\\models\\red.mtl", 1),
        ("twice.mtl", 1),
    ] {
        for name in ["red", "Red "] {
            fs::write(folder.0.join("a.obj"), square_in(name, library)).unwrap();
            let scene = folder.load("a.obj");
            assert_eq!(scene.materials.len(), count, "{library}");
            let material = &scene.materials[scene.meshes[0].material];
            assert_eq!((material.name.as_str(), material.base_color.x), ("red", 0.9), "{library}");
        }
    }
    fs::write(folder.0.join("a.obj"), square_in("green", "gone.mtl red.mtl")).unwrap();
    let notes = folder.load("a.obj").notes;
    assert!(notes.iter().any(|n| n.contains("'gone.mtl'") && n.contains("cannot be read")), "{notes:?}");
    assert!(notes.iter().any(|n| n.contains("material 'green'") && n.contains("plain")), "{notes:?}");
}

/// A PNG of that many pixels each way.
fn png(side: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let rgba: Vec<u8> = (0..side * side).flat_map(|i| pixel(i % side, i / side)).collect();
    encoder.write_header().unwrap().write_image_data(&rgba).unwrap();
    bytes
}

/// The left half is there.
fn half(side: u32, there: [u8; 4], gone: [u8; 4]) -> Vec<u8> {
    png(side, |x, _| if 2 * x < side { there } else { gone })
}

/// Whether the surface is there at a quarter and at three quarters of its width.
fn is_there(scene: &Scene) -> [bool; 2] {
    let geometry = scene.flatten();
    [0.25, 0.75].map(|x| !geometry.is_cut(0, x - 0.125, 0.125))
}

const LEAF: &str =
    "mtllib leaf.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl leaf\nf 1/1 2/2 3/3\n";

fn leaf(name: &str, statements: &str) -> (Folder, String) {
    let green = [40, 140, 40, 255];
    let files: [(&str, Vec<u8>); 6] = [
        ("alpha.png", half(8, green, [40, 140, 40, 0])),
        ("color.png", half(8, green, green)),
        ("mask.png", half(4, [255; 4], [0, 0, 0, 255])),
        ("white.png", half(4, [255; 4], [255, 255, 255, 0])),
        ("clear.png", half(4, [9, 9, 9, 0], [9, 9, 9, 0])),
        ("a.obj", LEAF.into()),
    ];
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, bytes)| (*name, bytes.as_slice())).collect();
    let folder = Folder::new(name, &files);
    fs::write(folder.0.join("leaf.mtl"), format!("newmtl leaf\n{statements}")).unwrap();
    (folder, "a.obj".into())
}

#[test]
fn masks_cut_however_they_are_given() {
    for (number, statements) in [
        "map_Kd alpha.png",
        "map_Kd alpha.png\nmap_d alpha.png",
        "map_Kd color.png\nmap_d mask.png",
        "map_Kd color.png\nmap_d white.png",
        "map_d mask.png",
        "map_d -imfchan r mask.png",
        "map_d -imfchan m alpha.png",
        "MAP_KD COLOR.PNG\nmap_d -clamp on mask.png\nd 0.1",
    ]
    .iter()
    .enumerate()
    {
        let (folder, file) = leaf(&format!("masks{number}"), statements);
        let scene = folder.load(&file);
        assert_eq!(is_there(&scene), [true, false], "{statements}");
        assert_eq!(scene.materials[0].alpha, AlphaMode::Mask { cutoff: 0.5 }, "{statements}");
        assert_eq!(scene.images.len(), 1);
    }
}

#[test]
fn maps_that_do_not_cut() {
    for (number, (statements, note)) in [
        ("map_Kd color.png", None),
        ("map_Kd clear.png", None),
        ("map_Kd color.png\nmap_d gone.png", Some("'gone.png': an image that cannot be read")),
        ("map_Kd color.png\ndisp height.png", Some("displacement map")),
        ("d 0.6\nTr 0.9", None),
    ]
    .iter()
    .enumerate()
    {
        let (folder, file) = leaf(&format!("solid{number}"), statements);
        let scene = folder.load(&file);
        assert_eq!(is_there(&scene), [true, true], "{statements}");
        assert_eq!(scene.materials[0].alpha, AlphaMode::Opaque);
        assert_eq!(scene.notes.len(), usize::from(note.is_some()), "{:?}", scene.notes);
        assert!(note.is_none_or(|note| scene.notes[0].contains(note)), "{:?}", scene.notes);
    }
}

#[test]
fn maps_are_scaled_and_shifted() {
    let (folder, file) = leaf("scaled", "map_Kd color.png\nmap_d -s 2 1 1 mask.png");
    let scene = folder.load(&file);
    let geometry = scene.flatten();
    // Twice across: there, gone, there, gone.
    let there = [0.125, 0.375, 0.625, 0.875].map(|x| !geometry.is_cut(0, x - 0.0625, 0.0625));
    assert_eq!(there, [true, false, true, false]);
    assert!(scene.notes[0].contains("lays its colours and its mask out differently"), "{:?}", scene.notes);
    let (folder, file) = leaf("shifted", "map_Kd -o 0.5 alpha.png");
    assert_eq!(is_there(&folder.load(&file)), [false, true]);
}

#[test]
fn glass_lets_light_through_as_it_is_told_to() {
    let floor = format!("{LEAF}usemtl floor\nf 1 2 3\n");
    for (number, statement) in ["d 0.15", "Tr 0.85", "d -halo 0.15"].iter().enumerate() {
        let (folder, _) = leaf(&format!("glass{number}"), statement);
        fs::write(folder.0.join("b.obj"), &floor).unwrap();
        let parts = |blend| folder.load_with("b.obj", blend).instances.len();
        assert_eq!([Blend::Mask, Blend::Cast, Blend::Ignore].map(parts), [1, 2, 1], "{statement}");
        let notes = folder.load("b.obj").notes;
        assert!(notes.iter().any(|n| n.contains("'leaf'") && n.contains("--blend cast")), "{notes:?}");
    }
    let (folder, _) = leaf("pane", "d 0.8");
    fs::write(folder.0.join("b.obj"), &floor).unwrap();
    let parts = |blend| folder.load_with("b.obj", blend).instances.len();
    assert_eq!([Blend::Mask, Blend::Cast, Blend::Ignore].map(parts), [2, 2, 1]);
}

#[test]
fn groups_can_be_left_out_by_name() {
    let text = format!("{SQUARE}o house\ng door\nf 1 2 3\ng roof\nf 1 2 3\no tree\nf 1 2 3\n");
    let left = |name: &str| {
        let mut scene = parse(&text).unwrap();
        scene.leave_out(&[name]).unwrap();
        scene.instances.len()
    };
    assert_eq!(["house", "door", "tree", "roof"].map(left), [1, 2, 2, 2]);
    // Names survive an export.
    let scene = parse(&text).unwrap();
    let mut back = crate::import::gltf_bytes(&export::glb(&scene).unwrap(), "back").unwrap();
    assert_eq!(back.leave_out(&["door"]), Ok(1));
}
