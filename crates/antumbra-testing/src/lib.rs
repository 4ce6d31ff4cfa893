//! antumbra-testing
