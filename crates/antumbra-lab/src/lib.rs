//! The lab: renders a scene with every technique, scores each against ray-traced truth, times it,
//! and writes a report.
//!
//! Everything starts from a [`setting`] and the light's [`views`]. [`compare::compare`] does it all: [`stage`] draws what casters leave and what the camera sees,
//! [`lighting`] turns that into visibility and pictures, `antumbra-truth` says what is right,
//! [`metrics`] how far off a technique is, [`timing`] what it costs; [`results`] is the outcome as
//! data and [`report`] as a page. [`motion`] moves camera and light, [`flicker`] measures what then
//! changes by itself. [`curve`] and [`maps`] look at a technique alone, [`bias`] at what keeps it from
//! shadowing itself; [`chart`] draws curves.

pub mod animation;
mod axis;
pub mod bench;
pub mod bias;
pub mod cascades;
pub mod chart;
pub mod classes;
pub mod compare;
pub mod curve;
pub mod default_view;
pub mod files;
pub mod flicker;
pub mod gpu;
pub mod lighting;
pub mod maps;
pub mod metrics;
pub mod motion;
pub mod occupancy;
mod paint;
pub mod plane;
pub mod regions;
pub mod report;
pub mod results;
pub mod setting;
mod shaders;
pub mod stage;
mod texels;
pub mod timing;
pub mod views;
