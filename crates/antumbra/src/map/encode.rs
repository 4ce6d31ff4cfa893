//! Encodes the passes of a frame.

use super::{
    CasterPass, NoProbe, Probe, ShadowMap, cast::Drawn, caster::TriangleCaster, draw::Draw, lists::Lists,
    numbered::Numbered, ranked::RankedTriangles, textures,
};
use crate::error::CasterError;
use std::sync::atomic::Ordering;

impl ShadowMap {
    /// Draws the casters of every view and filters what they leave. `draw` gets a pass with a depth attachment of
    /// [`DEPTH_FORMAT`](crate::DEPTH_FORMAT), cleared to 1, and no colour, which knows its
    /// [`view`](CasterPass::view); a technique that draws casters several times asks for each of
    /// [`caster_views`](Self::caster_views).
    ///
    /// Where the technique's [`caster`](crate::Description::caster) is
    /// [`Caster::Depth`](crate::technique::Caster::Depth), pipelines of the caller's own draw; casters in front of the
    /// near plane must be clamped (`unclipped_depth`) or moved ([`CASTER_WGSL`](crate::CASTER_WGSL)) onto it. Else
    /// [`CasterPass::draw_mesh`] does, and `draw` is called once per layer of
    /// [`Caster::Triangles`](crate::technique::Caster::Triangles), twice for
    /// [`Caster::Lists`](crate::technique::Caster::Lists).
    ///
    /// # Errors
    /// [`CasterError`] if what was drawn is not what the technique keeps. All passes are encoded
    /// nevertheless, and nothing casts a shadow.
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
        let mut drawn = Drawn::default();
        let keeps_ids = self.numbered().is_some();
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
            let (depth, seen) = (self.textures.caster_target(view, 0), (view, &self.views[view]));
            if let Some(lists) = &self.lists {
                lists.encode(encoder, seen, depth, probe, &mut draw);
            }
            if let Some(ranked) = &self.ranked {
                ranked.encode(encoder, seen, depth, probe, &mut draw);
            }
            if keeps_ids {
                continue;
            }
            for cast in 0..=last {
                for layer in 0..self.triangles.as_ref().map_or(1, TriangleCaster::passes) {
                    self.encode_cast(encoder, (view, cast, layer), probe, &mut draw);
                }
                let follows = |draw: &Draw| draw.cast.map_or(last, |c| c as usize) == cast;
                self.encode_view_filter(encoder, view, follows, probe);
            }
        }
        drawn.check(self.description())
    }

    /// What casters that number triangles have in common.
    pub(super) fn numbered(&self) -> Option<&Numbered> {
        let lists = self.lists.as_ref().map(Lists::numbered);
        lists.or_else(|| self.ranked.as_ref().map(RankedTriangles::numbered))
    }

    /// Filters depth that the caller has rendered ([`from_depth`](Self::from_depth)).
    pub fn encode_filter(&self, encoder: &mut wgpu::CommandEncoder, probe: &mut dyn Probe) {
        for view in 0..self.views.len() {
            self.encode_view_filter(encoder, view, |_| true, probe);
        }
    }

    fn encode_cast(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (view, cast, layer): (usize, usize, usize),
        probe: &mut dyn Probe,
        draw: &mut impl FnMut(&mut CasterPass<'_>),
    ) {
        let target = self.triangles.is_some().then(|| self.textures.map_target(view, layer));
        let target = target.map(textures::written);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow cast"),
            color_attachments: if target.is_some() { std::slice::from_ref(&target) } else { &[] },
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: self.textures.caster_target(view, cast),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: probe.pass("cast", view),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        let meshes = self.triangles.as_ref().map(|t| t.meshes((view, &self.views[view]), layer));
        let index = view * self.description().sample_offsets.len() + cast;
        draw(&mut CasterPass::new(pass, (index, &self.caster_views[index]), meshes));
    }

    fn encode_view_filter(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: usize,
        now: impl Fn(&Draw) -> bool,
        probe: &mut dyn Probe,
    ) {
        for draw in self.draws[view].iter().filter(|draw| now(draw)) {
            draw.encode(encoder, probe.pass(draw.label, view));
        }
    }
}
