//! The pass that casters are drawn in, which notices what leaves nothing there.

use crate::{
    error::CasterError,
    technique::{Caster, Technique},
};
use std::ops::{Deref, DerefMut};
use wgpu::RenderPass;

/// What the closure of [`ShadowMap::encode`](crate::ShadowMap::encode) draws casters in: wgpu's render
/// pass, which it dereferences to. Where the technique keeps depth, the caller's own pipelines draw in it;
/// where it keeps triangles, [`CasterMesh::draw`](crate::CasterMesh::draw) does.
#[derive(Debug)]
pub struct CasterPass<'a> {
    pass: RenderPass<'a>,
    takes_meshes: bool,
    drawn: Drawn,
}

impl<'a> CasterPass<'a> {
    pub(super) fn new(pass: RenderPass<'a>, takes_meshes: bool) -> Self {
        Self { pass, takes_meshes, drawn: Drawn::default() }
    }

    /// wgpu's pass, for a mesh to be drawn in; none where that would not be valid.
    pub(super) fn for_mesh(&mut self) -> Option<&mut RenderPass<'a>> {
        self.drawn.meshes = true;
        self.takes_meshes.then_some(&mut self.pass)
    }
}

impl<'a> Deref for CasterPass<'a> {
    type Target = RenderPass<'a>;

    fn deref(&self) -> &Self::Target {
        &self.pass
    }
}

impl DerefMut for CasterPass<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        self.drawn.otherwise = true;
        &mut self.pass
    }
}

/// How passes were drawn in.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Drawn {
    /// As meshes.
    meshes: bool,
    /// By the caller's own commands, which meshes with holes need too.
    otherwise: bool,
}

impl Drawn {
    /// Takes what a pass was used for to mind.
    pub(super) fn add(&mut self, pass: &CasterPass<'_>) {
        self.meshes |= pass.drawn.meshes;
        self.otherwise |= pass.drawn.otherwise;
    }

    /// Whether that is what the technique keeps. Nothing at all is: there may be no casters.
    pub(super) fn check(self, technique: &dyn Technique) -> Result<(), CasterError> {
        let name = || technique.page().name.to_string();
        let depth = technique.caster() == Caster::Depth;
        match self {
            Self { meshes: true, .. } if depth => Err(CasterError::Mesh { technique: name() }),
            Self { meshes: false, otherwise: true } if !depth => {
                Err(CasterError::OwnPipelines { technique: name() })
            }
            _ => Ok(()),
        }
    }
}
