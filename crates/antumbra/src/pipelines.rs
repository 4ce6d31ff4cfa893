//! One cache of full-screen pipelines per device.

use std::{
    collections::HashMap,
    sync::{Arc, Mutex, PoisonError},
};
use wgpu::{BindGroupLayout, ComputePipeline, RenderPipeline, TextureFormat};

type Key = (String, Vec<TextureFormat>);

/// The pipelines of the passes between casting and lighting, each compiled once. Clones share.
#[derive(Debug, Clone)]
pub struct Pipelines {
    pub(crate) device: wgpu::Device,
    pub(crate) nearest: wgpu::Sampler,
    pub(crate) made: Arc<Mutex<HashMap<Key, Pipeline>>>,
    casters: Arc<Mutex<HashMap<Key, RenderPipeline>>>,
}

/// A compiled step.
#[derive(Debug, Clone)]
pub(crate) struct Pipeline {
    pub(crate) run: Compiled,
    pub(crate) layout: BindGroupLayout,
}

/// What a step is run by.
#[derive(Debug, Clone)]
pub(crate) enum Compiled {
    /// A triangle over all of the view.
    Draw(RenderPipeline),
    /// A compute shader whose invocations are rows or columns.
    Dispatch(ComputePipeline),
}

impl Pipelines {
    /// An empty cache.
    #[must_use]
    pub fn new(device: &wgpu::Device) -> Self {
        Self {
            device: device.clone(),
            nearest: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow nearest"),
                ..Default::default()
            }),
            made: Arc::default(),
            casters: Arc::default(),
        }
    }

    /// Number of pipelines compiled so far.
    #[must_use]
    pub fn len(&self) -> usize {
        self.made.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// Texts of the shaders of the pipelines compiled so far, casters' included, in no order; see
    /// [`Shader::all`](crate::Shader::all).
    #[must_use]
    pub fn shaders(&self) -> Vec<String> {
        let made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        let casters = self.casters.lock().unwrap_or_else(PoisonError::into_inner);
        made.keys().chain(casters.keys()).map(|(text, _)| text.clone()).collect()
    }

    /// Whether nothing was compiled yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A caster's pipeline, which `compile` makes unless it is there.
    pub(crate) fn caster(
        &self,
        shader: &str,
        formats: &[TextureFormat],
        compile: impl FnOnce(&wgpu::Device) -> RenderPipeline,
    ) -> RenderPipeline {
        let mut made = self.casters.lock().unwrap_or_else(PoisonError::into_inner);
        let key = (shader.to_string(), formats.to_vec());
        made.entry(key).or_insert_with(|| compile(&self.device)).clone()
    }
}
