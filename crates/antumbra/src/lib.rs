//! Antialiased, filtered shadow maps for any wgpu renderer.
mod capabilities;
mod cascade;
mod error;
mod filter;
mod kernel;
mod light;
mod map;
mod parameter;
mod pass;
mod shader;
pub mod technique;

pub use capabilities::Capabilities;
pub use cascade::{Cascades, Stage};
pub use error::{LightError, SettingError, Unsupported};
pub use filter::{Filter, Sampling};
pub use kernel::{Kernel, Weights};
pub use light::{Bounds, Fit, Light, Size, View, visible_hull};
pub use map::{
    DEPTH_FORMAT, Lifetime, Memory, MemoryItem, NoProbe, Options, Pipelines, Probe, ShadowMap, TooManyViews,
};
pub use parameter::{Choice, Field, Parameter};
pub use shader::{CASTER_WGSL, ShaderText};
pub use technique::{Technique, csm::Csm, esm::Esm, hard::Hard, pcf::Pcf, vsm::Vsm};
