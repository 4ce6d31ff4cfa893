//! Laws that every technique obeys, the library's and those from outside.
//!
//! A law is a function that says what is wrong with a technique. [`add`] has all of them tried, each as a test of its
//! own; [`add_rejected`] tries that one of them notices what is wrong with a technique that is [broken on
//! purpose](crate::broken). What a technique says of itself, its [`ringing`](antumbra::Description::ringing),
//! [`ramp`](antumbra::Description::ramp) and [`rounding`](antumbra::Description::rounding), is how strict they are.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use crate::{Gpu, Trials};
use antumbra::Technique;

mod answers;
mod cases;
mod filters;

pub use answers::{
    darkens_with_depth, is_dark_behind_a_blocker, is_dark_within, is_lit_without_casters,
    shrinks_to_the_hard_shadow, stays_within_zero_and_one, views_do_not_matter,
};
pub use filters::{fallbacks_agree, filtering_keeps_the_mean, widths_in_the_world_are_texels_of_the_view};

/// Says what is wrong with a technique on a device.
pub type Law = fn(&Gpu, &dyn Technique) -> Result<(), String>;

/// All laws with their names.
pub const ALL: [(&str, Law); 9] = [
    ("visibility within [0,1]", stays_within_zero_and_one),
    ("lit without casters", is_lit_without_casters),
    ("dark behind a blocker", is_dark_behind_a_blocker),
    ("darker with depth", darkens_with_depth),
    ("hard when the kernel shrinks", shrinks_to_the_hard_shadow),
    ("filtering keeps the mean", filtering_keeps_the_mean),
    ("the same in any view", views_do_not_matter),
    ("fallbacks agree", fallbacks_agree),
    ("a width in the world is texels of the view", widths_in_the_world_are_texels_of_the_view),
];

/// Tries all laws on a technique, which is called `name`.
pub fn add(trials: &mut Trials, name: &str, technique: &dyn Technique) {
    for (law, check) in ALL {
        let technique = technique.clone_box();
        trials.add(format!("{name}: {law}"), move |gpu| check(gpu, technique.as_ref()).unwrap());
    }
}

/// Tries that a law, one of [`ALL`], rejects a technique with that fault.
///
/// # Panics
/// If it is not one of them.
pub fn add_rejected(trials: &mut Trials, fault: &str, law: Law, technique: &dyn Technique) {
    let (name, _) = ALL.into_iter().find(|(_, l)| std::ptr::fn_addr_eq(*l, law)).unwrap();
    let technique = technique.clone_box();
    trials.add(format!("rejected: {fault} ({}; {name})", technique.about().name), move |gpu| {
        assert!(law(gpu, technique.as_ref()).is_err(), "the law must tell");
    });
}
