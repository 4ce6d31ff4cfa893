//! How far the work is.

/// Is told how far the work is; called from any thread.
pub trait Progress: Sync {
    /// A step begins.
    fn step(&self, name: &str);
    /// Share of the step that is done, 0 to 1.
    fn share(&self, share: f32);
}

/// A progress that nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoProgress;

impl Progress for NoProgress {
    fn step(&self, _: &str) {}
    fn share(&self, _: f32) {}
}
