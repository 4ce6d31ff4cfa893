//! Encodes the passes of a frame.

use super::{
    NoProbe, Probe, ShadowMap,
    draw::{Draw, Run},
};
use crate::{
    cast::{CasterPass, Drawn, Seen},
    error::CasterError,
};
use std::sync::atomic::Ordering;

impl ShadowMap {
    /// Draws the casters of every view and filters what they leave. `draw` gets a pass with a depth
    /// attachment of [`DEPTH_FORMAT`](crate::DEPTH_FORMAT), cleared to 1, which knows its
    /// [`view`](CasterPass::view); a technique that draws casters several times asks for each of
    /// [`caster_views`](Self::caster_views).
    ///
    /// Where the technique's [`storage`](crate::Description::storage) is
    /// [`CasterStorage::Depth`](crate::technique::CasterStorage::Depth), pipelines of the caller's own draw;
    /// casters in front of the near plane must be clamped (`unclipped_depth`) or moved
    /// ([`CASTER_WGSL`](crate::CASTER_WGSL)) onto it. Else [`CasterPass::draw_mesh`] does, with pipelines of the
    /// library's, and `draw` is called once per view, once per layer of
    /// [`CasterStorage::NearestTriangle`](crate::technique::CasterStorage::NearestTriangle), twice for
    /// [`CasterStorage::ABuffer`](crate::technique::CasterStorage::ABuffer).
    ///
    /// # Errors
    /// [`CasterError`] if what was drawn is not what the technique keeps. All passes are encoded
    /// nevertheless, and nothing casts a shadow. [`CasterError::Brought`] if the map reads the caller's depth; nothing
    /// is encoded then.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: impl FnMut(&mut CasterPass<'_>),
    ) -> Result<(), CasterError> {
        self.encode_probed(encoder, &mut NoProbe, draw)
    }

    /// [`encode`](Self::encode) with a probe in every pass.
    ///
    /// # Errors
    /// As `encode`.
    pub fn encode_probed(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        probe: &mut dyn Probe,
        mut draw: impl FnMut(&mut CasterPass<'_>),
    ) -> Result<(), CasterError> {
        if self.textures.is_brought() {
            return Err(CasterError::Brought { technique: self.description().about.name.into() });
        }
        let mut drawn = Drawn::default();
        let keeps_ids = self.description().storage.keeps_ids();
        let mut draw = |pass: &mut CasterPass<'_>| {
            draw(pass);
            drawn.add(pass);
            if keeps_ids {
                self.drawn.fetch_max(pass.ids(), Ordering::Relaxed);
            }
        };
        let last = self.description().sample_offsets.len() - 1;
        self.drawn.store(0, Ordering::Relaxed);
        for view in 0..self.views.len() {
            for cast in 0..=last {
                let index = view * (last + 1) + cast;
                let seen = self.seen(view, cast, index);
                self.cast.encode(encoder, seen, &self.textures, probe, &mut draw);
                let follows = |draw: &Draw| draw.cast.map_or(last, |c| c as usize) == cast;
                self.encode_view_filter(encoder, view, follows, probe);
            }
        }
        drawn.check(self.description())
    }

    /// Filters depth that the caller has rendered ([`from_depth`](Self::from_depth)).
    pub fn encode_filter(&self, encoder: &mut wgpu::CommandEncoder, probe: &mut dyn Probe) {
        for view in 0..self.views.len() {
            self.encode_view_filter(encoder, view, |_| true, probe);
        }
    }

    fn seen(&self, view: usize, cast: usize, index: usize) -> Seen<'_> {
        let tile = self.tiles[view];
        Seen {
            view,
            cast,
            index,
            from: &self.caster_views[index],
            tile,
            tiled: self.composition.tiled,
            first: self.tiles[..view].iter().all(|before| before.layer != tile.layer),
        }
    }

    fn encode_view_filter(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: usize,
        now: impl Fn(&Draw) -> bool,
        probe: &mut dyn Probe,
    ) {
        let tile = self.tiles[view];
        let run = Run { tile, uniforms: self.uniforms.offset(view) };
        let draws = self.draws[tile.layer as usize].iter();
        for draw in draws.filter(|draw| now(draw) && draw.makes_any_of(&tile)) {
            draw.encode(encoder, run, probe.pass(draw.label, view));
        }
    }
}
