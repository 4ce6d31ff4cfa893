//! Progress bars on standard error.

use antumbra_lab::compare::Progress;
use indicatif::{ProgressBar, ProgressStyle};
use std::{
    io::{self, Write},
    time::Duration,
};

/// One bar that names the current step. Draws nothing where standard error is no terminal.
#[derive(Debug)]
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new() -> Self {
        Self::of("{spinner} {msg:34} {bar:32} {elapsed}, {eta} left")
    }

    /// One that also says how far something larger is.
    pub(crate) fn wide() -> Self {
        Self::of("{spinner} {elapsed} {prefix}: {msg:34} {bar:20}")
    }

    fn of(template: &str) -> Self {
        let bar = ProgressBar::new(1000);
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(120));
        Self(bar)
    }

    /// How far the larger thing is.
    pub(crate) fn prefix(&self, text: &str) {
        self.0.set_prefix(text.to_string());
    }

    /// Prints a line to standard output, above the bar.
    pub(crate) fn line(&self, text: &str) {
        // A standard output that nobody reads is no reason to stop.
        self.0.suspend(|| {
            let _ = writeln!(io::stdout(), "{text}");
        });
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Progress for Bar {
    fn step(&self, name: &str) {
        self.0.set_position(0);
        self.0.set_message(name.to_string());
    }
    fn share(&self, share: f32) {
        let position = (share.clamp(0.0, 1.0) * 1000.0) as u64;
        if position > self.0.position() {
            self.0.set_position(position);
        }
    }
}
