//! The lab: renders a scene with every technique, scores each against ray-traced truth, times it,
//! and writes a report.
//!
//! Everything starts from a [`shot`]: what is looked at. A [`session`] is a shot on the GPU with techniques
//! that are ready: it draws, moves and times them with `antumbra-render`. [`truth`] traces what is right with
//! `antumbra-truth`, [`metrics`] says how far off an answer is, [`timing`] what it costs.
//! [`compare::compare`] does it all; [`results`] is the outcome as data and [`report`] as a page. [`motion`]
//! moves camera and light, [`flicker`] measures what then changes by itself. [`curve`] and [`maps`] look at a
//! technique alone, [`bias`] at what keeps it from shadowing itself; [`chart`] draws curves.

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
pub mod facts;
pub mod files;
pub mod flicker;
pub mod gpu;
pub mod image;
pub mod map_views;
pub mod maps;
pub mod metrics;
pub mod motion;
pub mod occupancy;
mod paint;
pub mod prepared;
pub mod progress;
pub mod readback;
pub mod regions;
pub mod report;
pub mod results;
pub mod session;
mod shaders;
pub mod shot;
pub mod specs;
mod texels;
pub mod timing;
pub mod truth;
