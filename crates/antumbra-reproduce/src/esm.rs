//! Annen, Mertens, Seidel, Flerackers and Kautz 2008, Exponential shadow maps.

use crate::target::{Source, Target};

mod cases;
mod curve;
mod failures;
mod quality;
mod samples;
mod speed;

pub(crate) const SOURCE: Source = Source {
    key: "esm",
    name: "Annen et al. 2008, Exponential shadow maps",
    targets: &[
        Target {
            id: "esm/figure-1",
            title: "A backyard with CSM, VSM and ESM: quality, memory, speed",
            paper: "A backyard with a 2048² map and a 5×5 Gauss: CSM 22 fps and 170 MB, VSM 84 fps and 42 MB, ESM 94 fps and \
                    21 MB, mip levels included. ESM takes 8× less memory than CSM and leaks less at contact points.",
            ours: "The scene backyard, a 2048² map, 5×5 Gauss, 800×600 pixels. Memory is what lookups need, depth aside.",
            seconds: [140, 10],
            run: quality::figure_1,
        },
        Target {
            id: "esm/table-1",
            title: "Frame times of ESM, VSM and CSM",
            paper: "Frames per second in the backyard with maps of 512² to 2048², without convolution and with 3×3 and 7×7: \
                    ESM with Threshold, ESM with Z-Max, VSM, CSM.",
            ours: "The same grid on the scene backyard at 800×600 pixels. Each cell is the frame time over that of ESM with \
                   Threshold, same map and kernel.",
            seconds: [105, 12],
            run: speed::table_1,
        },
        Target {
            id: "esm/table-2",
            title: "What finding failures costs",
            paper: "Frames per second of Z-Max and Threshold with maps of 128² to 1024², 800×800 pixels: Threshold is always \
                    faster, and the penalty of Z-Max grows with the map.",
            ours: "The same grid on the scene spheres. Each cell is the frame time of Z-Max over that of Threshold.",
            seconds: [16, 3],
            run: speed::table_2,
        },
        Target {
            id: "esm/table-3",
            title: "How many pixels break the assumption",
            paper: "In a backyard of 800×800 pixels, 2.8 % of the pixels (Threshold) or 3.0 % (Z-Max) see casters behind the \
                    receiver in their kernel and are filtered by hand; with kernels of 7×7 it is 7.1 % and 9.3 %.",
            ours: "The scene backyard, and the same without leaves and grass, 800×800 pixels, a 2048² map, both classifiers with their default tolerance, and, \
                   pixel by pixel, what Threshold finds and Z-Max does not.",
            seconds: [10, 2],
            run: failures::table_3,
        },
        Target {
            id: "esm/figure-2",
            title: "The exponential step against 16 Fourier terms",
            paper: "The step is approximated by an exponential decay: the larger c the better (a); with c = 80 it is better \
                    than a CSM of 16 terms with an offset of 0.032 (b).",
            ours: "What receivers get behind a map whose every texel holds one depth, without bias.",
            seconds: [2, 1],
            run: curve::figure_2,
        },
        Target {
            id: "esm/figure-3",
            title: "Where the assumption fails, and where that shows",
            paper: "(a) A point that ought to be half in shadow is too bright, since the kernel reaches casters behind it; (b) \
                    the same where the point is lit anyway; (c) the assumption holds and the filter is correct. In (a) and (b) \
                    custom filtering is used. It cannot mend additional convolutions.",
            ours: "The three cases as maps of two depths, without and with a 5×5 Gauss, beside bilinear PCF.",
            seconds: [2, 1],
            run: cases::figure_3,
        },
        Target {
            id: "esm/figure-4",
            title: "Acne and polygon offset",
            paper: "Without polygon offset a shadow map shadows lit surfaces (a). ESM is less prone to it, since the decay is not \
                    steep enough over such small distances (b): polygon offset is not required.",
            ours: "The scene spheres, a 1024² map: a standard map and ESM, without any bias and with the bias that each \
                   technique asks for.",
            seconds: [6, 2],
            run: cases::figure_4,
        },
        Target {
            id: "esm/figure-5",
            title: "Two ways to find failures",
            paper: "Z-Max finds every pixel that may fail and needs a further texture; Threshold needs nothing but may miss \
                    some. Shown: the pixels that each finds.",
            ours: "The scene backyard with a 2048² map and 5×5 Gauss: pixels found (red), and the error with either and \
                   without any.",
            seconds: [6, 2],
            run: failures::figure_5,
        },
        Target {
            id: "esm/figure-6",
            title: "How the tolerances of both classifiers act",
            paper: "(a) With an offset that is too small, Z-Max flags lit surfaces. (b) The higher the threshold, the fewer \
                    pixels are found.",
            ours: "The scene backyard, a 1024² map, 5×5 Gauss; sweeps of Z-Max's constant offset, in depth ranges, and of Threshold's ε.",
            seconds: [4, 2],
            run: failures::figure_6,
        },
        Target {
            id: "esm/figure-7",
            title: "How many PCF samples match an ESM",
            paper: "PCF of 1, 16, 36 and 64 samples over a pixel's footprint against trilinear ESM, without and with a 5×5 \
                    Gauss: at least 36 samples match the first, 64 the second, at a much lower frame rate.",
            ours: "The scene fence from twice its distance, a 2048² map, where many texels fall on a pixel. footprint is PCF \
                   that spreads a budget of lookups over the pixel's footprint. The truth is sharp, with 64 rays per pixel.",
            seconds: [30, 5],
            run: samples::figure_7,
        },
        Target {
            id: "esm/figure-8",
            title: "A fence with ESM, CSM and VSM",
            paper: "A fence of 365,000 faces with a 2048² map and a 5×5 Gauss: ESM looks like CSM, is better at contact \
                    shadows, and leaks less than VSM.",
            ours: "The scene fence, the same map and kernel. Contact: casters nearer than a twentieth of the depth range.",
            seconds: [31, 5],
            run: quality::figure_8,
        },
        Target {
            id: "esm/figure-9",
            title: "Minification with and without custom filtering",
            paper: "Trilinear lookups without custom filtering light pixels incorrectly (a); custom filtering prevents that (b); \
                    10× anisotropic lookups without custom filtering often handle such cases properly.",
            ours: "The scene fence from three times its distance, a 2048² map; anisotropic lookups of up to 16. The truth is \
                   sharp, with 16 rays per pixel.",
            seconds: [20, 3],
            run: cases::figure_9,
        },
        Target {
            id: "esm/figure-10",
            title: "Failing pixels over growing kernels",
            paper: "The backyard's failing pixels in red, without convolution and with 3×3, 5×5 and 7×7: Z-Max above, \
                    Threshold below.",
            ours: "The same pictures of the scene backyard; the numbers are those of table 3.",
            seconds: [3, 1],
            run: failures::figure_10,
        },
    ],
};
