//! Annen, Mertens, Bekaert, Seidel and Kautz 2007, Convolution shadow maps.

use crate::target::{Source, Target};

mod bases;
mod curves;
mod filters;
mod layers;
mod receding;
mod series;
mod speed;
mod terms;

pub(crate) const SOURCE: Source = Source {
    key: "csm",
    name: "Annen et al. 2007, Convolution shadow maps",
    targets: &[
        Target {
            id: "csm/figure-1",
            title: "Minification: PCF against mip-mapped CSM",
            paper: "Percentage-closer filtering does not support trilinear filtering and aliases severely when many texels \
                    fall on a pixel. A CSM is mip-mapped like any texture; with a 7×7 blur it hides the texels as well.",
            ours: "The scene fence from four times its distance, a 2048² map. The truth is sharp, with 64 rays per pixel. \
                   A CSM without mips (bilinear) shows what the mip levels add.",
            seconds: [15, 3],
            run: filters::figure_1,
        },
        Target {
            id: "csm/table-1",
            title: "Frame times over map size, kernel and number of terms",
            paper: "Frames per second for maps of 256² to 2048², M of 4, 8 and 16 terms, without blur and with 3×3 and 7×7, \
                    beside hardware PCF; 1024×768 pixels, 365,000 triangles, 16× anisotropic filtering.",
            ours: "The same grid on the scene fence with 365,000 triangles at 1024×768 pixels. Each cell is the frame \
                   time over that of PCF (one bilinear lookup) with a map of the same size.",
            seconds: [115, 16],
            run: speed::table_1,
        },
        Target {
            id: "csm/figure-3",
            title: "The step of the shadow test and how it is mended",
            paper: "Plots of the reconstructed step over d − z: more terms are steeper but ring (a); attenuation suppresses \
                    ringing and widens the step (b); an offset (c) or a scale (d) lights surfaces that would be half dark.",
            ours: "What receivers get from a map whose every texel holds one depth, without bias and clamped to 0..1, so \
                   that ringing beyond shows as a flat.",
            seconds: [3, 2],
            run: curves::figure_3,
        },
        Target {
            id: "csm/series",
            title: "What the text says of the series",
            paper: "The error is the same wherever the step is (section 3.2); the series converges to the exact solution \
                    (section 2); 16 terms take four times the memory of a VSM, 4 terms the same (section 5).",
            ours: "Receivers behind maps whose every texel holds one depth, at five depths, and with 1 to 32 terms; the \
                   memory of maps of 1024².",
            seconds: [8, 3],
            run: series::series,
        },
        Target {
            id: "csm/bases",
            title: "Other bases for the shadow test",
            paper: "Section 3.2.3: a Taylor series diverges where d − z is large; block and hat functions err by a variable \
                    amount, since they are not shift-invariant, and pop.",
            ours: "32 coefficients of each, as 16 Fourier terms have, in double precision; the Taylor series is of a sigmoid as \
                   steep as they are.",
            seconds: [1, 1],
            run: bases::bases,
        },
        Target {
            id: "csm/figure-4",
            title: "Scaling against offsetting",
            paper: "Scaling the series by two (a) lights surfaces but sharpens shadows; an offset (b) keeps the blur but has \
                    less shadow near contact points. 5×5 Gauss, M = 16.",
            ours: "The scene blocks, a 1024² map, the same two settings.",
            seconds: [10, 2],
            run: terms::figure_4,
        },
        Target {
            id: "csm/figure-5",
            title: "Basis textures, and whether 8 bits suffice",
            paper: "A shadow map and its basis textures for M = 16. 32-bit floats did not produce noticeable differences, so \
                    that 8 bits per basis function are used.",
            ours: "The maps of the scene blocks; pictures of the scenes fence and blocks with 8-bit, 16-bit and 32-bit \
                   coefficients, 2048² maps, 5×5 Gauss.",
            seconds: [62, 7],
            run: terms::figure_5,
        },
        Target {
            id: "csm/figure-6",
            title: "How many terms a shadow needs",
            paper: "Few terms brighten shadows where occluder and receiver are close: a low square, a slanted polygon that \
                    touches the ground. M = 4 is satisfactory, without noticeable intensity artifacts; M = 16 is sharper.",
            ours: "The scenes blocks, with four floating squares and a slanted polygon, and spheres; 1024² maps, 3×3 Gauss, \
                   8-bit coefficients, M from 1 to 32, lit by the offset as all results of the paper; M = 4 is shown with the \
                   scale too. Contact is where the caster is nearer than a twentieth of the depth range.",
            seconds: [22, 3],
            run: terms::figure_6,
        },
        Target {
            id: "csm/figure-7",
            title: "Thin branches under seven filters",
            paper: "Two trees lit from the side: PCF (a) and a CSM with bilinear lookups (b) lose thin branches; trilinear \
                    anisotropic lookups (c) recover them; blurs of 3×3, 5×5 and 7×7 (d to f) hide the texels.",
            ours: "The scene trees, a 2048² map, 16× anisotropic lookups. The truth is sharp, with 16 rays per pixel.",
            seconds: [21, 3],
            run: filters::figure_7,
        },
        Target {
            id: "csm/figure-8",
            title: "Small maps hidden by large kernels",
            paper: "Maps of 128² to 1024² with kernels of 3×3 and 7×7: with a kernel that is large enough even small maps give \
                    soft shadows without visible texels.",
            ours: "The scene spheres with the same grid. Texels show as error to the light-space ideal of the same kernel; a \
                   standard map of the same size is judged by the same ideal.",
            seconds: [36, 4],
            run: filters::figure_8,
        },
        Target {
            id: "csm/figure-9",
            title: "Light leaking behind a fence: VSM against CSM",
            paper: "A fence in front of other objects, with a variance shadow map (a) and a convolution shadow map (b). \
                    Objects behind the fence add depth complexity: light leaks into the VSM's shadows there, while the \
                    CSM renders them without artifacts.",
            ours: "The scene fence in low sun, in which objects stand behind the fence as light sees them, and the scene layers; a \
                   2048² map, a 7×7 Gaussian. Judged where rays say full shadow behind two casters or more that are at least a \
                   twentieth of the depth range apart and from the receiver.",
            seconds: [63, 6],
            run: layers::figure_9,
        },
        Target {
            id: "csm/figure-10",
            title: "A scene that moves away: PCF against mip-mapped CSM",
            paper: "A scene moves away from the camera. PCF aliases, in space and in time; a CSM with a 5×5 filter and \
                    tri-linear lookups does not, and shadows stay good as the scene fades away.",
            ours: "The scene fence, from which the camera moves away to eight times its distance in 48 frames; a 1024² \
                   map. Sun, map and scene keep their places to one another when a scene is moved away from a camera, so it \
                   is the same whether scene or camera moves. Every frame is traced with 16 rays per pixel, and what changes otherwise than they do is flicker.",
            seconds: [120, 12],
            run: receding::figure_10,
        },
    ],
};
