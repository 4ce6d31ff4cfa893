//! One progress bar on standard error for a whole command.
//!
//! A command is a row of phases, each with the share of the work that it is expected to be. The bar moves
//! through all of them and never back, and says how much time is left once enough has passed to tell.

use antumbra_lab::{gpu::Gpu, progress::Progress};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::{
    io::{self, Write},
    sync::{Mutex, PoisonError},
    time::{Duration, Instant},
};

/// Positions of the bar.
const POSITIONS: f64 = 1000.0;
/// Work that has to be done, as a share of all, before the time left is told.
const KNOWN_SHARE: f64 = 0.08;
/// Time that has to pass before the time left is told.
const KNOWN_AFTER: Duration = Duration::from_secs(3);

/// A part of a command's work. Steps whose names begin with the phase's name belong to it.
pub(crate) type Phase = (&'static str, f64);

/// The bar. Draws nothing where standard error is no terminal, and fits the terminal where it is one.
#[derive(Debug)]
pub(crate) struct Bar {
    bar: ProgressBar,
    phases: Vec<Phase>,
    start: Instant,
    now: Mutex<Now>,
}

/// How far the work is.
#[derive(Debug)]
struct Now {
    /// Index of the current part, and how many there are.
    part: (usize, usize),
    /// Index of the current phase, and the share of it that is done.
    phase: usize,
    within: f64,
    /// Share of all work that is done; never falls.
    share: f64,
    step: String,
    prefix: String,
    /// Seconds left as somebody else knows them better.
    seconds_left: Option<f64>,
}

impl Now {
    const START: Self = Self {
        part: (0, 1),
        phase: 0,
        within: 0.0,
        share: 0.0,
        step: String::new(),
        prefix: String::new(),
        seconds_left: None,
    };
}

impl Bar {
    /// A bar over the phases, in the order in which they come.
    pub(crate) fn new(phases: impl Into<Vec<Phase>>) -> Self {
        Self::drawn(phases.into(), ProgressDrawTarget::stderr())
    }

    fn drawn(phases: Vec<Phase>, target: ProgressDrawTarget) -> Self {
        let bar = ProgressBar::with_draw_target(Some(POSITIONS as u64), target);
        // The message is cut where the terminal ends.
        if let Ok(style) = ProgressStyle::with_template("{spinner} {bar:20} {percent:>3} % {wide_msg}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(120));
        Self { bar, phases, start: Instant::now(), now: Mutex::new(Now::START) }
    }

    /// Share of all work that is done and seconds that are left, where the caller counts the work itself.
    pub(crate) fn total(&self, share: f64, seconds_left: f64) {
        self.change(|now| {
            now.share = now.share.max(share);
            now.seconds_left = Some(seconds_left);
        });
    }

    /// What the steps belong to, said before them.
    pub(crate) fn prefix(&self, text: &str) {
        self.change(|now| now.prefix = format!("{text}, "));
    }

    /// Begins part `index`, from 0, of `count` equal parts, each with all the phases.
    pub(crate) fn part(&self, index: usize, count: usize) {
        self.change(|now| (now.part, now.phase, now.within) = ((index, count), 0, 0.0));
    }

    /// Prints a line to standard output, above the bar.
    pub(crate) fn line(&self, text: &str) {
        // A standard output that nobody reads is no reason to stop.
        self.bar.suspend(|| {
            let _ = writeln!(io::stdout(), "{text}");
        });
    }

    fn change(&self, change: impl FnOnce(&mut Now)) {
        let mut now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut now);
        let (part, parts) = (now.part.0 as f64, now.part.1.max(1) as f64);
        now.share = now.share.max((part + share(&self.phases, now.phase, now.within)) / parts);
        let elapsed = self.start.elapsed();
        let left = now.seconds_left.or_else(|| seconds_left(elapsed, now.share));
        let left = left.map(|left| format!(", {} left", rough(left))).unwrap_or_default();
        self.bar.set_position((POSITIONS * now.share) as u64);
        self.bar.set_message(format!("{}s{left}: {}{}", elapsed.as_secs(), now.prefix, now.step));
    }
}

/// Phases of a comparison of so many techniques, weighed by the seconds that they take on two cores: rays
/// cost the same everywhere, frames next to nothing on a graphics card.
pub(crate) fn comparison(
    gpu: &Gpu,
    [width, height]: [u32; 2],
    (kernel, grid): (u32, u32),
    (techniques, rounds): (usize, u32),
) -> Vec<Phase> {
    let millions = f64::from(width) * f64::from(height) / 1e6;
    let square = |side: u32| f64::from(side).powi(2);
    let frame = if gpu.is_software() { 0.7 } else { 0.05 } * techniques as f64;
    vec![
        ("upload", 1.0 + 0.4 * techniques as f64),
        ("truth: build", 0.5),
        ("truth: hard", 1.0 * millions),
        ("truth: coverage", 1.0 * millions),
        ("truth: light-space", (1.0 + 1.5 * square(kernel)) * millions),
        ("truth: screen-space", 0.7 * square(grid) * millions),
        ("render", 1.5 * frame),
        ("time", frame * f64::from(rounds + 1)),
    ]
}

/// Share of all work that is done, when a share of a phase is.
fn share(phases: &[Phase], phase: usize, within: f64) -> f64 {
    let total: f64 = phases.iter().map(|phase| phase.1).sum();
    let before: f64 = phases[..phase.min(phases.len())].iter().map(|phase| phase.1).sum();
    let current = phases.get(phase).map_or(0.0, |phase| phase.1);
    if total > 0.0 { (before + current * within) / total } else { 0.0 }
}

/// Seconds left at the pace so far; `None` while that is a guess.
fn seconds_left(elapsed: Duration, share: f64) -> Option<f64> {
    let known = share >= KNOWN_SHARE && elapsed >= KNOWN_AFTER;
    known.then(|| elapsed.as_secs_f64() * (1.0 - share) / share)
}

/// A time as exactly as it can be meant.
fn rough(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "less than 1 s".into(),
        s if s < 90.0 => format!("about {s:.0} s"),
        s => format!("about {:.0} min", (s / 60.0).ceil()),
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar {
    fn step(&self, name: &str) {
        self.change(|now| {
            let found = self.phases.iter().position(|phase| name.starts_with(phase.0));
            if let Some(phase) = found.filter(|phase| *phase != now.phase) {
                (now.phase, now.within) = (phase, 0.0);
            }
            now.step = name.to_string();
        });
    }
    fn share(&self, share: f32) {
        self.change(|now| now.within = now.within.max(f64::from(share.clamp(0.0, 1.0))));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar() -> Bar {
        Bar::drawn(vec![("upload", 1.0), ("truth", 7.0), ("render", 2.0)], ProgressDrawTarget::hidden())
    }

    #[test]
    fn the_bar_runs_through_all_phases_and_never_back() {
        let bar = bar();
        let mut last = 0;
        let mut at = |expected: u64| {
            let now = bar.bar.position();
            assert!(now >= last && now.abs_diff(expected) <= 1, "{now}, not {expected}");
            last = now;
        };
        bar.step("upload");
        at(0);
        bar.step("truth");
        at(100);
        bar.share(0.5);
        at(450);
        bar.share(0.2);
        at(450);
        bar.step("render hard");
        at(800);
        bar.share(0.5);
        bar.step("render pcf");
        at(900);
        bar.step("something else");
        at(900);
        bar.step("truth");
        at(900);
    }

    #[test]
    fn parts_share_the_bar() {
        let bar = bar();
        bar.part(0, 2);
        bar.step("render");
        assert_eq!(bar.bar.position(), 400);
        bar.part(1, 2);
        assert_eq!(bar.bar.position(), 500);
        bar.step("truth");
        assert_eq!(bar.bar.position(), 550);
    }

    #[test]
    fn the_time_left_is_told_when_it_is_known() {
        assert_eq!(seconds_left(Duration::from_secs(2), 0.5), None);
        assert_eq!(seconds_left(Duration::from_secs(100), 0.01), None);
        assert_eq!(seconds_left(Duration::from_secs(10), 0.25), Some(30.0));
        assert_eq!([0.2, 30.0, 100.0].map(rough), ["less than 1 s", "about 30 s", "about 2 min"]);
        let bar = bar();
        bar.step("upload");
        assert!(!bar.bar.message().contains("left"), "{}", bar.bar.message());
        bar.total(0.3, 240.0);
        assert!(bar.bar.message().contains("about 4 min left"), "{}", bar.bar.message());
    }
}
