//! Many small things under a lamp [Brabec and Seidel 2001, "Hardware-accelerated rendering of
//! antialiased shadows with shadow maps", figures 7 and 8, which show about 7,000 polygons]: a garden
//! chess set in the middle of a game, in the cone of a spot light. Every piece casts a short shadow
//! with much detail in it, and a texel covers less and less of the pieces the further they stand.

use super::{
    Procedural,
    model::Model,
    random::Random,
    shapes::{self, Builder},
};
use crate::{Camera, Light, Mesh, Projection, Scene};
use glam::{Mat4, Vec3};
use std::f32::consts::{FRAC_PI_2, PI, TAU};

pub(super) const BRABEC: Procedural = Procedural {
    name: "brabec",
    description: "a garden chess set in the light of a lamp",
    stresses: "many small casters under a spot light: steps at shadow edges of all directions",
    source: "Brabec and Seidel 2001, Hardware-accelerated antialiased shadows, figures 7 and 8",
    triangles: 7_082,
    build,
};

/// Width of a square of the board.
const SQUARE: f32 = 0.5;
/// Height of its surface.
const TOP: f32 = 0.06;
/// Sides of what is turned.
const SIDES: u32 = 12;

/// The kinds of pieces, in the order of their meshes.
#[derive(Debug, Clone, Copy)]
enum Piece {
    Pawn,
    Rook,
    Knight,
    Bishop,
    Queen,
    King,
}
use Piece::{Bishop, King, Knight, Pawn, Queen, Rook};

const WHITE: [(Piece, &str); 13] = [
    (King, "g1"),
    (Queen, "e2"),
    (Rook, "a1"),
    (Rook, "f1"),
    (Bishop, "c4"),
    (Knight, "f3"),
    (Pawn, "a2"),
    (Pawn, "b2"),
    (Pawn, "d4"),
    (Pawn, "e5"),
    (Pawn, "f2"),
    (Pawn, "g2"),
    (Pawn, "h3"),
];
const BLACK: [(Piece, &str); 13] = [
    (King, "g8"),
    (Queen, "c7"),
    (Rook, "a8"),
    (Rook, "d8"),
    (Bishop, "e7"),
    (Knight, "d5"),
    (Knight, "c6"),
    (Pawn, "a7"),
    (Pawn, "b6"),
    (Pawn, "e6"),
    (Pawn, "f7"),
    (Pawn, "g7"),
    (Pawn, "h6"),
];

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("brabec");
    let paving = scene.material("paving", [0.40, 0.38, 0.34], 0.9);
    let ground = scene.mesh("ground", shapes::ground(18.0), paving);
    scene.place(ground, Mat4::IDENTITY);
    board(&mut scene);
    let maple = scene.material("maple", [0.64, 0.50, 0.31], 0.5);
    let rosewood = scene.material("rosewood", [0.27, 0.10, 0.06], 0.5);
    let white = pieces(&mut scene, maple);
    let black = pieces(&mut scene, rosewood);
    for (set, meshes, facing) in [(WHITE, &white, PI + 1.0), (BLACK, &black, 0.8)] {
        for (piece, square) in set {
            let mut places = square.bytes().zip([b'a', b'1']).map(|(c, first)| f32::from(c - first) - 3.5);
            let (file, rank) = (places.next().unwrap_or(0.0), places.next().unwrap_or(0.0));
            let (x, z) = (file * SQUARE + random.around(0.03), -rank * SQUARE + random.around(0.03));
            let turn = Mat4::from_rotation_y(facing + random.around(0.3));
            scene.place_all(
                &meshes[piece as usize],
                Mat4::from_translation(Vec3::new(x, TOP - 0.003, z)) * turn,
            );
        }
    }
    // Taken pieces lie beside the board, on their widest rings.
    for (meshes, piece, x, z, radius) in [
        (&black, Pawn, 2.75, 0.9, 0.16),
        (&black, Bishop, 2.85, -0.3, 0.18),
        (&white, Knight, -2.85, 0.6, 0.18),
        (&white, Pawn, -2.7, -0.9, 0.16),
        (&black, Pawn, 3.3, 0.4, 0.16),
    ] {
        let place = Mat4::from_translation(Vec3::new(x, radius - 0.004, z));
        let roll = Mat4::from_rotation_y(random.between(0.0, TAU)) * Mat4::from_rotation_x(FRAC_PI_2);
        scene.place_all(&meshes[piece as usize], place * roll);
    }
    let lamp = Vec3::new(-3.7, 4.6, -1.9);
    scene.finish(
        Camera {
            position: Vec3::new(2.5, 3.8, 6.2),
            target: Vec3::new(0.12, 0.05, 0.2),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.62 },
        },
        Light::Spot {
            position: lamp,
            direction: (Vec3::new(0.3, 0.0, 0.2) - lamp).normalize(),
            outer_angle: 0.6,
        },
    )
}

/// Sixty-four squares in a frame.
fn board(scene: &mut Builder) {
    let cream = scene.material("light squares", [0.55, 0.50, 0.40], 0.7);
    let slate = scene.material("dark squares", [0.17, 0.22, 0.22], 0.7);
    let oak = scene.material("oak", [0.38, 0.24, 0.12], 0.7);
    let mut board = Model::default();
    let square = shapes::ground(SQUARE);
    for i in 0..64 {
        let (file, rank) = (i % 8, i / 8);
        let at = Vec3::new((file as f32 - 3.5) * SQUARE, TOP, (rank as f32 - 3.5) * SQUARE);
        let material = if (file + rank) % 2 == 0 { cream } else { slate };
        board.add(material, &square, Mat4::from_translation(at));
    }
    let half = 4.0 * SQUARE;
    for side in [-1.0, 1.0] {
        let (edge, long) = (side * (half + 0.1), 2.0 * half);
        board.block(oak, Vec3::new(edge, 0.03, 0.0), Vec3::new(0.2, 0.1, long + 0.4));
        board.block(oak, Vec3::new(0.0, 0.03, edge), Vec3::new(long, 0.1, 0.2));
    }
    let board = board.finish(scene, "board");
    scene.place_all(&board, Mat4::IDENTITY);
}

/// The six kinds in the order of [`Piece`], each standing on y = 0 and facing +z.
fn pieces(scene: &mut Builder, material: usize) -> [Vec<usize>; 6] {
    let turned = |rest: &[[f32; 2]]| {
        let foot = [[0.18, 0.0], [0.18, 0.05], [0.12, 0.11]];
        shapes::turned(&[&foot[..], rest].concat(), SIDES)
    };
    let mut pawn = vec![[0.07, 0.36], [0.12, 0.38]];
    pawn.extend([-45.0_f32, -15.0, 15.0, 45.0, 70.0].map(|latitude| {
        let (sin, cos) = latitude.to_radians().sin_cos();
        [0.11 * cos, 0.48 + 0.11 * sin]
    }));
    let pawn = turned(&[&pawn[..], &[[0.0, 0.59]]].concat());
    let rook = turned(&[[0.10, 0.48], [0.16, 0.52], [0.16, 0.68], [0.11, 0.68], [0.11, 0.61], [0.0, 0.61]]);
    let bishop = turned(&[
        [0.075, 0.52],
        [0.13, 0.55],
        [0.08, 0.58],
        [0.12, 0.68],
        [0.03, 0.85],
        [0.035, 0.89],
        [0.0, 0.92],
    ]);
    let queen = turned(&[
        [0.08, 0.66],
        [0.15, 0.70],
        [0.09, 0.74],
        [0.16, 0.98],
        [0.11, 0.97],
        [0.04, 1.03],
        [0.0, 1.07],
    ]);
    let mut king = turned(&[
        [0.085, 0.70],
        [0.16, 0.74],
        [0.10, 0.78],
        [0.15, 0.98],
        [0.09, 1.03],
        [0.035, 1.06],
        [0.0, 1.07],
    ]);
    for size in [[0.045, 0.2, 0.04], [0.14, 0.045, 0.038]] {
        let cross = Mat4::from_translation(Vec3::Y * 1.15);
        shapes::append(&mut king, &shapes::cuboid(Vec3::from(size)), cross);
    }
    let names = ["pawn", "rook", "knight", "bishop", "queen", "king"];
    let meshes =
        [pawn, rook, knight(turned(&[[0.10, 0.18], [0.13, 0.22], [0.0, 0.24]])), bishop, queen, king];
    let mut meshes = meshes.into_iter().zip(names);
    std::array::from_fn(|_| {
        meshes.next().map(|(mesh, name)| scene.mesh(name, mesh, material)).into_iter().collect()
    })
}

/// A horse's head, cut from a board in convex pieces, on a foot. It looks along +z.
fn knight(mut foot: Mesh) -> Mesh {
    let outlines: [&[[f32; 2]]; 5] = [
        &[[-0.11, 0.2], [0.11, 0.2], [0.06, 0.42], [-0.13, 0.46]],
        &[[-0.13, 0.46], [0.06, 0.42], [0.04, 0.62], [-0.04, 0.70], [-0.12, 0.62]],
        &[[0.04, 0.46], [0.19, 0.40], [0.22, 0.47], [0.19, 0.53], [0.03, 0.64]],
        &[[-0.04, 0.69], [0.0, 0.655], [0.0, 0.78]],
        &[[-0.165, 0.42], [-0.115, 0.44], [-0.105, 0.62], [-0.145, 0.60]],
    ];
    for (i, outline) in outlines.into_iter().enumerate() {
        // Parts that overlap differ in width, so that no two faces coincide.
        let board = shapes::extruded(outline, [0.15, 0.14, 0.12, 0.09, 0.05][i]);
        shapes::append(&mut foot, &board, Mat4::from_rotation_y(-FRAC_PI_2));
    }
    foot
}
