//! Annen, Mertens, Bekaert, Seidel and Kautz 2007, Convolution shadow maps.

use crate::target::{Source, Target};

mod layers;
mod receding;

pub(crate) const SOURCE: Source = Source {
    key: "csm",
    name: "Annen et al. 2007, Convolution shadow maps",
    targets: &[
        Target {
            id: "csm/figure-9",
            title: "Light leaking behind a fence: VSM against CSM",
            paper: "A fence in front of other objects, with a variance shadow map (a) and a convolution shadow map (b). \
                Objects behind the fence add depth complexity: light leaks into the VSM's shadows there, while the CSM \
                renders them without artifacts.",
            ours: "The scenes fence and layers, a 2048² map, a 7×7 Gaussian. Leaks are mean visibilities where rays say \
               full shadow, over all such pixels and over those behind several layers of casters: the first one at \
               least a tenth of the depth range away, which is more than the ramp of the CSM, others as far beyond it.",
            seconds: [30, 6],
            run: layers::figure_9,
        },
        Target {
            id: "csm/figure-10",
            title: "A scene that moves away: PCF against mip-mapped CSM",
            paper: "A scene moves away from the camera. PCF aliases, in space and in time; a CSM with a 5×5 filter and \
                    tri-linear lookups does not, and shadows stay good as the scene fades away.",
            ours: "The scene fence, from which the camera moves away to eight times its distance in 48 frames; a 1024² \
                   map. Every frame is traced with 16 rays per pixel, and what changes otherwise than they do is flicker.",
            seconds: [120, 12],
            run: receding::figure_10,
        },
    ],
};
