//! antumbra
