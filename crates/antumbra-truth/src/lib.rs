//! antumbra-truth
