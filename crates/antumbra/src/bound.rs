//! The settings that techniques with a bound on the lit share of a kernel have in common.

use crate::parameter::{Field, Parameter};

/// The row of a least variance, a share of the depth range squared.
pub(crate) fn least_variance(value: &mut f32) -> Parameter<'_> {
    let meaning = "variance is kept at or above this";
    Parameter::new("least_variance", "depth range²", Field::Number(value, 0.0..=0.01), meaning)
}

/// The row of the share of a plane's own variance within a texel.
pub(crate) fn slope(value: &mut f32) -> Parameter<'_> {
    let meaning =
        "times ¼(z_x² + z_y²), the variance of a plane within a texel: keeps slopes lit without bias";
    Parameter::new("slope", "", Field::Number(value, 0.0..=4.0), meaning)
}

/// The row of the light-bleeding reduction.
pub(crate) fn reduction(value: &mut f32) -> Parameter<'_> {
    let meaning = "light-bleeding reduction: this much of the bound is cut off";
    Parameter::new("reduction", "", Field::Number(value, 0.0..=0.99), meaning)
}
