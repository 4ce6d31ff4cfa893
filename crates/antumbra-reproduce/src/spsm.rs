//! Lecocq, Marvie, Sourimant and Gautron 2014, Sub-pixel shadow mapping.

use crate::target::{Source, Target};

mod motion;

pub(crate) const SOURCE: Source = Source {
    key: "spsm",
    name: "Lecocq et al. 2014, Sub-pixel shadow mapping",
    targets: &[Target {
        id: "spsm/flicker",
        title: "Flicker of moving cameras and lights",
        paper: "Moving the light highlights the high temporal consistency of SPSM, shown in a video: there is no number.",
        ours: "The scenes contact, spheres and tangle with 1024² maps, 480×360 pixels, the camera turning 8° while the \
               light turns 5°. Flicker is the mean |Δv − Δv_truth| of a pixel from frame to frame, every frame being \
               traced.",
        seconds: [180, 20],
        run: motion::flicker,
    }],
};
