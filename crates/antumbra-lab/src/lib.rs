//! antumbra-lab
