//! antumbra-lab

pub mod files;
pub mod metrics;
pub mod plane;
pub mod report;
pub mod results;
