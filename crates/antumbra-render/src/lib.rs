//! Draws a scene with antumbra's shadow maps.
//!
//! | item | what it is |
//! | --- | --- |
//! | [`Gpu`] | device and queue, and what the device refused |
//! | [`GpuScene`] | geometry and materials on the device: draws [`Casters`] for shadow maps, and the [`Surfaces`] that a camera sees |
//! | [`Lighting`] | the visibility of every surface, which a [`Lookup`] asks a shadow map for |
//! | [`Pictures`] | the lit picture that a visibility makes |
//! | [`views`] | views of a scene's light |
//!
//! ```no_run
//! use antumbra::{Esm, Options, ShadowMap, Size, wgpu};
//! use antumbra_render::{Casters, Gpu, GpuScene, Lighting, Lookup, Pictures, views};
//! use antumbra_scene::procedural;
//!
//! # async fn picture(instance: &wgpu::Instance) -> Result<wgpu::Texture, Box<dyn std::error::Error>> {
//! let gpu = Gpu::open(instance).await?;
//! let fence = procedural::by_name("fence").ok_or("no such scene")?.scene(1);
//! let (geometry, camera, light) = (fence.flatten(), fence.main_camera(), fence.main_light());
//! let scene = GpuScene::new(&gpu, &geometry, &camera, &light, [800, 600])?;
//!
//! let options = Options::from(Size::square(1024)).capacity(scene.capacity()).cutouts(scene.tells_cutouts());
//! let mut shadows = ShadowMap::new(&gpu.device, &Esm::default(), options)?;
//! let bounds = geometry.bounds_around(camera.position).ok_or("no triangles")?;
//! let views = views::fit(scene.camera_matrix(), bounds, &light, 1, &[&shadows], shadows.leans())?;
//! shadows.prepare(&gpu.queue, &views)?;
//!
//! let casters = Casters::new(&gpu, &scene, &shadows)?;
//! let (lighting, lookup) = (Lighting::new(&gpu, &scene), Lookup::new(&gpu, &scene, &shadows));
//! let pictures = Pictures::new(&gpu, &scene, &lighting)?;
//! let mut encoder = gpu.device.create_command_encoder(&Default::default());
//! shadows.encode(&mut encoder, |pass| scene.draw_casters(&casters, pass))?;
//! scene.encode_surfaces(&mut encoder, None);
//! lighting.encode_lookup(&mut encoder, &scene, &lookup, Some(&shadows), None);
//! pictures.encode(&mut encoder);
//! gpu.submit(encoder)?;
//! Ok(pictures.picture().clone())
//! # }
//! ```
//!
//! Nothing here waits for the device or reads back, so that all of it runs in browsers too. Whoever measures
//! adds that (`antumbra-lab`).

mod error;
mod gpu;
mod layout;
mod lighting;
mod scene;
mod shaders;
mod surfaces;
pub mod views;

pub use error::RenderError;
pub use gpu::Gpu;
pub use lighting::{Lighting, Lookup, Pictures};
pub use scene::{Casters, CoarseCutouts, GpuScene, ViewMatrices};
pub use surfaces::Surfaces;
