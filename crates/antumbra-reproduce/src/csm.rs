//! Annen, Mertens, Bekaert, Seidel and Kautz 2007, Convolution shadow maps.

use crate::target::{Source, Target};

mod layers;

pub(crate) const SOURCE: Source = Source {
    key: "csm",
    name: "Annen et al. 2007, Convolution shadow maps",
    targets: &[Target {
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
    }],
};
