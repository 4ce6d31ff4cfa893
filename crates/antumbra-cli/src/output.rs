//! What is said on standard error.

use std::io::{self, Write};

/// A line on standard error; one that nobody reads is no reason to stop.
pub(crate) fn note(text: &str) {
    let _ = writeln!(io::stderr(), "note: {text}");
}

/// Whether an error is that of a pipe whose reader has gone.
pub(crate) fn is_closed(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe)
}

/// An error with its causes, each said once: many messages already end in that of their cause, and
/// all of ours say what the system said.
pub(crate) fn message(error: &anyhow::Error) -> String {
    let causes = error.chain().skip(1).filter(|cause| !cause.is::<io::Error>());
    causes.map(ToString::to_string).fold(error.to_string(), |text, cause| {
        if text.contains(&cause) { text } else { format!("{text}: {cause}") }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::anyhow;

    #[test]
    fn causes_are_said_once() {
        let error = anyhow!("no such file").context("x.glb cannot be read: no such file").context("scene");
        assert_eq!(message(&error), "scene: x.glb cannot be read: no such file");
    }
}
