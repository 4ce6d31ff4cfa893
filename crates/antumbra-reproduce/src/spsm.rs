//! Lecocq, Marvie, Sourimant and Gautron 2014, Sub-pixel shadow mapping.

use crate::target::{Source, Target};

mod beyond;
mod crowds;
mod motion;
mod pixels;
mod quality;
mod speed;

/// The paper's method, of which alone its claims are judged.
const PUBLISHED: &str = "spsm.packing=map,layers=1";
/// What every page shows side by side: before the paper's method what it is compared with, behind it what is beyond.
const COMPARED: [(&str, &str); 5] = [
    ("hard", "standard map"),
    (PUBLISHED, "SPSM as published"),
    ("spsm", "SPSM with two layers"),
    ("dpm", "deep primitive maps"),
    ("exact", "all triangles"),
];

pub(crate) const SOURCE: Source = Source {
    key: "spsm",
    name: "Lecocq et al. 2014, Sub-pixel shadow mapping",
    targets: &[
        Target {
            id: "spsm/table-1",
            title: "Frame times on three scenes",
            paper: "Milliseconds of standard and sub-pixel shadow maps of 1024² and 2048² at 1920×1080 pixels: spheres \
                    (12,000 triangles), YeahRight (155,000), a city (2,300,000). The overhead is 26 to 56 %.",
            ours: "The scenes spheres (12,000 triangles), tangle (150,000) and city (2,300,000) at 1920×1080 pixels. Cells are \
                   frame times over that of the standard map.",
            seconds: [300, 12],
            run: speed::table_1,
        },
        Target {
            id: "spsm/table-2",
            title: "Overhead over the size of the map",
            paper: "YeahRight with maps of 512² to 4096²: the overhead over a standard map falls from 81 to 27 %.",
            ours: "The scene tangle at 1920×1080 pixels with the same maps.",
            seconds: [100, 15],
            run: speed::table_2,
        },
        Target {
            id: "spsm/figure-2",
            title: "Silhouettes at one resolution",
            paper: "A standard map of 1024², SPSM without and with the recovery of silhouettes: the last is smooth.",
            ours: "The scene spheres, 512² so that texels show; SPSM with recovery in other ways beside it.",
            seconds: [5, 2],
            run: quality::figure_2,
        },
        Target {
            id: "spsm/figure-5",
            title: "Levels of slopes",
            paper: "Linear levels of 8 bits are too coarse at grazing angles, where depth changes much with the angle; those \
                    spread by a fifth power are .17° apart around 80°, a fourth of .70°.",
            ours: "Degrees from a level to the next, by Eq. 4 in double precision. Around 80° it is .227°, less than a third of \
                   linear levels; .17° is reached at 86°.",
            seconds: [1, 1],
            run: pixels::figure_5,
        },
        Target {
            id: "spsm/figure-6",
            title: "Projection aliasing with one bias",
            paper: "One bias for all: a standard map is full of acne, SPSM with linear 8-bit slopes has some at grazing \
                    angles, SPSM with slopes spread by a fifth power none.",
            ours: "The scene spheres, a 1024² map, SPSM's own small bias for all.",
            seconds: [14, 5],
            run: pixels::figure_6,
        },
        Target {
            id: "spsm/figure-11",
            title: "Anti-aliasing at silhouettes",
            paper: "Several positions of each uncertain pixel are compared with the silhouette that was recovered once: \
                    smooth edges at minimal cost.",
            ours: "The scene spheres, a 1024² map, 1, 2×2 and 4×4 positions, against 16 rays per pixel. With two layers, and in \
                   deep primitive maps, every position is looked up.",
            seconds: [40, 8],
            run: pixels::figure_11,
        },
        Target {
            id: "spsm/figure-12",
            title: "Pixel match with ray tracing",
            paper: "Against ray-traced shadows, with maps of 1024² and 2048²: at 2048², 99.63 % of the pixels match for SPSM \
                    and 97.93 % for a standard map.",
            ours: "The scene tangle, 800×600 pixels; the share of the pixels facing the light that have the same answer.",
            seconds: [7, 4],
            run: quality::figure_12,
        },
        Target {
            id: "spsm/figure-13",
            title: "Dense meshes: RGSM fails, SPSM does not",
            paper: "A 512² map: RGSM with 5×5 lookups works for low-density models but fails for highly tessellated ones; \
                    SPSM with 3×3 recovers their boundaries.",
            ours: "The scenes contact (17 triangles) and tangle (150,000) with 512² maps.",
            seconds: [5, 3],
            run: quality::figure_13,
        },
        Target {
            id: "spsm/figure-14",
            title: "Where silhouettes are recovered",
            paper: "The larger the map, the fewer pixels need silhouette recovery (red); green pixels are shadowed by one of \
                    3×3 triangles.",
            ours: "The scene tangle, 640×480 pixels, maps of 512², 1024² and 2048².",
            seconds: [6, 5],
            run: crowds::figure_14,
        },
        Target {
            id: "spsm/figure-15",
            title: "Shadow fusion in leaves",
            paper: "Where many triangles fall into a texel, as in foliage, gaps of shadows close; a larger map (1024² for 512²) \
                    reduces it.",
            ours: "The scene trees, 640×480 pixels. Fusion is darkening where rays say light, over all lit pixels.",
            seconds: [8, 5],
            run: crowds::figure_15,
        },
        Target {
            id: "spsm/beyond",
            title: "More triangles per texel",
            paper: "One triangle per texel, since all of them, \"an arbitrary amount of data\", would be intractable (§3.1). 99.63 % \
                    of the pixels of YeahRight match with a map of 2048².",
            ours: "The scene tangle at 1920×1080 pixels: SPSM as published and with a second layer, deep primitive maps that \
                   keep the first four or six triangles of each texel by their numbers, lists of all.",
            seconds: [90, 13],
            run: beyond::beyond,
        },
        Target {
            id: "spsm/flicker",
            title: "Flicker of moving cameras and lights",
            paper: "Moving the light highlights the high temporal consistency of SPSM, shown in a video: there is no number.",
            ours: "The scenes contact, spheres and tangle with 1024² maps, 480×360 pixels, the camera turning 8° while the \
                   light turns 5°. Flicker is the mean |Δv − Δv_truth| of a pixel from frame to frame, every frame being \
                   traced.",
            seconds: [240, 20],
            run: motion::flicker,
        },
    ],
};
