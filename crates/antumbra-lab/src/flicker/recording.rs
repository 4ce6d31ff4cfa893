//! The frames of a path, one after the other: drawn, traced, compared with the frame before.

use super::{
    Request,
    pictures::Pictures,
    score::Series,
    truths::{FrameSample, FrameTruth, Truths},
};
use crate::{gpu::Gpu, motion::Frame, readback, session::Session};
use anyhow::Result;
use std::time::{Duration, Instant};

/// What the frames so far have shown.
pub(super) struct Recording<'a> {
    gpu: &'a Gpu,
    request: &'a Request,
    truths: Truths<'a>,
    /// The techniques, at the last frame.
    pub(super) session: Session<'a>,
    /// Why each technique is worth nothing, if it was so in any frame.
    pub(super) invalid: Vec<Option<String>>,
    pub(super) series: Series,
    /// `None` before the first frame.
    pub(super) pictures: Option<Pictures>,
    before: Option<(Frame, FrameSample)>,
    /// World sizes of the views' texels, frame by frame.
    texels: Vec<Vec<f32>>,
    /// Time spent on truths.
    pub(super) tracing: Duration,
}

impl<'a> Recording<'a> {
    /// Prepares the techniques of a request; no frame yet.
    pub(super) fn new(gpu: &'a Gpu, request: &'a Request, truths: Truths<'a>) -> Result<Self> {
        let session = Session::new(gpu, &request.shot, &request.techniques)?;
        let count = session.prepared().len();
        Ok(Self {
            gpu,
            request,
            truths,
            session,
            invalid: vec![None; count],
            series: Series::new(count, request.shot.resolution),
            pictures: None,
            before: None,
            texels: Vec::new(),
            tracing: Duration::ZERO,
        })
    }

    /// Draws and traces the next frame.
    pub(super) fn add(&mut self, frame: &Frame) -> Result<()> {
        let session = &mut self.session;
        session.draw_maps(&frame.camera, &frame.light)?;
        self.texels.push(session.views().iter().map(|view| view.texel_world).collect());
        for (prepared, invalid) in session.prepared().iter().zip(&mut self.invalid) {
            *invalid = invalid.take().or_else(|| prepared.invalid());
        }
        // The points of the last frame under this frame's light: its surfaces are still there.
        let on_points = match &self.before {
            Some((last, _)) if last.camera != frame.camera => Some(answers(session)?),
            _ => None,
        };
        session.look()?;
        let answers = answers(session)?;
        let drawn = readback::positions(self.gpu, session.scene().surfaces())?;
        let maps = session.shot().map_views(session.views(), session.shot().kernel)?;
        let clock = Instant::now();
        let truth = self.truths.of_frame(frame, &maps, &drawn)?;
        let now = FrameSample { truth, answers };
        let points = self.before.as_ref().map(|(last, was)| match on_points {
            None => now.truth.clone(),
            Some(_) if last.light == frame.light => was.truth.clone(),
            Some(_) => self.truths.at_points(&was.truth, frame, &maps),
        });
        self.tracing += clock.elapsed();
        self.compare(&now, points.as_ref(), on_points.as_deref());
        self.before = Some((*frame, now));
        Ok(())
    }

    /// Adds a frame to the pictures, and to the series what changed since the frame before: `points` is what
    /// is right at its points now, `on_points` what techniques answer there if that is not what they answer
    /// in the picture.
    fn compare(&mut self, now: &FrameSample, points: Option<&FrameTruth>, on_points: Option<&[Vec<f32>]>) {
        let prepared = self.session.prepared();
        let pictures = self.pictures.get_or_insert_with(|| Pictures::new(self.request, now, prepared));
        pictures.add(now);
        if let (Some((_, was)), Some(points)) = (&self.before, points) {
            let answers = on_points.unwrap_or(&now.answers);
            self.series.add(&self.truths, was, now, points, answers);
        }
    }

    /// How often a view's texels had another size than in the frame before; another number of views counts
    /// once.
    pub(super) fn texel_changes(&self) -> u32 {
        let changes = |pair: &[Vec<f32>]| match pair {
            [was, now] if was.len() == now.len() => was.iter().zip(now).filter(|(a, b)| a != b).count(),
            _ => 1,
        };
        self.texels.windows(2).map(changes).sum::<usize>() as u32
    }
}

/// What each map answers for the surfaces that are drawn.
fn answers(session: &Session<'_>) -> Result<Vec<Vec<f32>>> {
    session.prepared().iter().map(|prepared| Ok(session.ask(prepared)?.values)).collect()
}
