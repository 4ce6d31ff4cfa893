//! Antialiased, filtered shadow maps for any [wgpu](https://docs.rs/wgpu) renderer.
//!
//! You keep your device, your passes and your shaders. antumbra allocates a shadow map of the
//! technique that you choose, filters it between your caster pass and your lighting pass, and gives
//! you one WGSL function, `shadow_visibility`, and one bind group. It never submits, polls, blocks,
//! logs or allocates on the GPU after a map is made.
//!
//! ```no_run
//! use antumbra::{Bounds, Csm, Fit, Light, ShadowMap, Size};
//! use glam::Vec3;
//!
//! const MY_SHADER: &str = "
//!     @fragment fn fragment(@location(0) world: vec3f, @location(1) normal: vec3f) -> @location(0) vec4f {
//!         let lit = shadow_visibility(world, normal, dpdx(world), dpdy(world));
//!         return vec4f(vec3f(lit), 1.0);
//!     }";
//!
//! fn example(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(), Box<dyn std::error::Error>> {
//!     // Once: a map, and your shader with what it calls behind it, bound in group 2.
//!     let mut shadows = ShadowMap::new(device, &Csm::default(), Size::square(1024))?;
//!     let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
//!         label: None,
//!         source: shadows.wgsl(2).after(MY_SHADER),
//!     });
//!     // … your pipeline from `module`, with `shadows.layout()` as the layout of group 2.
//!     // Each frame: where the light looks from, what it sees.
//!     let scene = Bounds { min: Vec3::splat(-10.0), max: Vec3::splat(10.0) };
//!     let sun = Light::Directional { direction: Vec3::new(0.3, -1.0, 0.2) };
//!     let view = sun.view(&Fit {
//!         casters: scene,
//!         receivers: scene.corners().collect(),
//!         size: shadows.size(),
//!         margin_texels: shadows.margin_texels(),
//!         lean: shadows.leans(),
//!     })?;
//!     let mut encoder = device.create_command_encoder(&Default::default());
//!     shadows.prepare(queue, &[view])?;
//!     shadows.encode(&mut encoder, |pass| {
//!         // … draw your casters' depth with `pass.view().clip_from_world`.
//!     })?;
//!     // … in your pass: pass.set_bind_group(2, shadows.bind_group(), &[]);
//!     Ok(())
//! }
//! ```
//!
//! The examples are whole programs: `quick_start` and `hello`, `own_shader` (cascades, a larger shader, two
//! techniques side by side), `own_depth` (a depth pass that the renderer already has), `reversed_depth`, `two_lights`, `two_tiles`, `triangles`, `cutouts`, `skinning`,
//! `compute` (fog) and `browser` (a page).
//!
//! # Versions
//!
//! | antumbra | wgpu | glam | Rust |
//! | --- | --- | --- | --- |
//! | 0.1 | 30 | 0.34 | 1.87 |
//!
//! Types of [`wgpu`] and [`glam`] are part of the interface, so versions must agree; both are exported
//! again. antumbra switches on none of wgpu's backends: your own dependency on it says which you ship.
//!
//! # Casters and receivers
//!
//! - What casters draw depends on what a technique keeps ([`Description::storage`]). Most keep depth, which your
//!   own pipelines draw once per view; `stratified` asks for it n² times per view, each time from a view
//!   that is shifted by a fraction of a texel, so place casters by [`CasterPass::view`]. `rgsm`, `spsm`,
//!   `dpm` and `exact` keep triangles: [`CasterPass::draw_mesh`] draws a [`CasterMesh`] by pipelines of the
//!   library. The other kind is a [`CasterError`].
//! - Casters in front of a view's near plane must still cast: set `unclipped_depth` in your caster
//!   pipelines where the device [can](Capabilities::clamps_depth), elsewhere call `caster_pancaked` of
//!   [`CASTER_WGSL`] in their vertex shader.
//! - `shadow_visibility(position, normal, ddx, ddy)` takes world space. `normal` is that of the facet, of unit
//!   length, either side: the cross product of the triangle's edges, or of `dpdx(position)` and
//!   `dpdy(position)`; not the interpolated or bumped one. What has no surface, such as fog, passes the
//!   direction towards the light, and zero for `ddx` and `ddy`, which are the change of position from
//!   this pixel to the next.
//! - It is 1, lit, outside every view: beyond the last cascade, beside the square around a spot's cone,
//!   where there is no view.
//! - Cascades reach as far as [`CameraFit::camera`] sees of [`CameraFit::scene`]: a finite far plane there is the
//!   distance up to which there are shadows.
//! - A point light is six spots with an outer angle of 45° along ±x, ±y and ±z, until there is one: six
//!   views of one map.
//! - [`ShadowMap::prepare`] writes buffers through the queue: all passes of a submission see what was written
//!   last. Two cameras are two maps; [`Pipelines`] lets them share what was compiled, and names keep them apart in
//!   one shader ([`ShaderText::named`]).
//! - Several lights are as many maps, or one ([`Options::lights`]): [`ShadowMap::prepare_lights`] takes the views of each, and
//!   `shadow_visibility(light, …)` looks among those of one.
//! - Each view has a layer of its own, or lies in a [`Tile`] of one ([`Options::tiled`], [`View::at`]): many in few layers,
//!   each as large as its light deserves, elsewhere in the next frame. Nothing of one is seen in another.
//!
//! # Techniques
//!
//! | name | type | texel of the map | lookups | at its best, and its price |
//! | --- | --- | --- | --- | --- |
//! | `hard` | [`Hard`] | 4 bytes | 1 | the yardstick: aliased edges, needs bias |
//! | `pcf` | [`Pcf`] | 4 bytes | ⌈(n+1)/2⌉² | the quality that others approximate; the cost grows with the kernel |
//! | `poisson` | [`Poisson`] | 4 bytes | 4 to 64 | any width for the price of its points; noise or bands instead of smooth penumbrae |
//! | `bicubic` | [`Bicubic`] | 4 bytes | 4 | the smoothest edge of four lookups; its width is fixed |
//! | `footprint` | [`Footprint`] | 4 bytes | 1 to 16 | as wide as the pixel: antialiases distant receivers; hard where magnified |
//! | `packed` | [`Packed`] | 16 bytes (4 or 8 as options) | 1 or 4 | four depths per fetch; 5 or 17 levels of grey |
//! | `stratified` | [`Stratified`] | 16·⌈n²/4⌉ bytes (less as options) | ⌈n²/4⌉ | n times the resolution; the casters are drawn n² times |
//! | `vsm` | [`Vsm`] | 8 bytes, 1⅓ times with mips | 1 | any blur for the price of its passes; light bleeds where casters overlap |
//! | `csm` | [`Csm`] | 4·⌈M/2⌉ bytes, 1⅓ times with mips | ⌈M/2⌉ | does not bleed between layers; bright near contact, rings |
//! | `esm` | [`Esm`] | 4 bytes, 1⅓ times with mips | 1 | cheapest filtered map, no bias; too bright where casters lie close behind one another |
//! | `evsm` | [`Evsm`] | 16 bytes (4 to 8 as options), 1⅓ times with mips | 1 | bleeds next to nothing with 32 bits; bright where a caster nearly touches its receiver |
//! | `msm` | [`Msm`] | 8 bytes, 1⅓ times with mips | 1 | bleeds only where three casters overlap, at half the memory of `evsm`; more arithmetic at lookup |
//! | `lvsm` | [`Lvsm`] | 16·⌈L/2⌉ bytes, 1⅓ times with mips | ⌈L/2⌉ | bleeds only within an interval of depth; memory grows with the intervals |
//! | `rgsm` | [`Rgsm`] | 16 bytes | 9, or n² | edges finer than texels where triangles are larger than those; elsewhere no better than `hard` |
//! | `spsm` | [`Spsm`] | 16 bytes, 32 with 2 layers | 1 to 5, at edges up to 9 more for each layer and 9 for centres | edges finer than texels, hard; draws casters twice from storage buffers ([`CasterMesh`]), slow without a GPU |
//! | `dpm` | [`Dpm`] | 4 bytes and 4 per triangle kept, 48 per triangle of the scene | 4 per triangle kept, 10 more where some are missing | what rays see where texels have room; hard; frays where more small triangles share a texel than are kept |
//! | `exact` | [`Exact`] | 16 bytes and 4 per triangle in it, 48 per triangle of the scene | 2 and 4 per triangle in a list | what rays see, whatever the size of the map; memory follows from the scene ([`Capacity`]) |
//!
//! A technique is a value whose public fields are its settings; [`technique::parse`] reads them from
//! text (`esm.c=60,kernel=7`) and [`technique::all`] lists them. Data goes through four rooms, and nothing
//! flows back:
//!
//! 1. **cast**: you draw the casters' depth, or already have it ([`ShadowMap::from_depth`]), or let
//!    [`CasterPass::draw_mesh`] draw triangles;
//! 2. **convert**: each texel of depth becomes what the technique keeps, such as moments;
//! 3. **pre-filter**: blur and mip chain ([`Filter`]);
//! 4. **look up**: `shadow_visibility` reads the map and bounds the share of light.
//!
//! Where the casters' own depth is compared, and where triangles are kept, there is neither 2 nor 3.
//!
//! To add a technique of your own, implement [`Technique`], whose page shows how; nothing in the crate knows the list.
//!
//! # Units
//!
//! World positions and directions have your unit. Kernels, margins and [biases](technique::Bias)
//! are in texels of the map, whatever its size and distance; settings in depth are shares of the
//! view's range ([`View::depth_world`] long). Visibility is 0 (in shadow) to 1 (lit). Matrices take
//! column vectors, clip space has z in `[0,1]`, texture coordinates have y down.
//!
//! # Devices
//!
//! Vulkan, Metal, DX12 and WebGPU (also in the browser: there is no blocking call). GL and WebGL2
//! are refused with [`Unsupported::Backend`]: a depth texture can only be compared there. No feature
//! is required and WebGPU's default limits are enough; a few features are used where the *device*
//! was created with them ([`Capabilities::OPTIONAL_FEATURES`] is what to ask for), and
//! [`ShadowMap::explain`] tells which path was taken:
//!
//! | without | instead |
//! | --- | --- |
//! | `FLOAT32_FILTERABLE` | 32-bit maps are interpolated in the shader, with the same result |
//! | `DEPTH_CLIP_CONTROL` | casters in front of a view are moved onto its near plane by [`CASTER_WGSL`] in your vertex shader, instead of `unclipped_depth` in your pipeline |
//! | `TEXTURE_FORMAT_16BIT_NORM` and `TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES` | moments of `msm` take 32 bits instead of 16 |
//! | `PRIMITIVE_INDEX` | triangles that casters are drawn as do not share vertices (`rgsm`, `spsm`; software drivers never share) |
//! | `CONSERVATIVE_RASTERIZATION` | vertex shaders enlarge the triangles of `spsm`, and fragments leave out what they do not touch |
//! | `VERTEX_WRITABLE_STORAGE` | fragments, not vertices, keep the corners of triangles (`dpm`) |
//! | eight colour attachments of the format | layers are converted in several passes |
//!
//! Browsers have the first four as `float32-filterable`, `depth-clip-control`, `texture-formats-tier1` and
//! `primitive-index`. They have neither `CONSERVATIVE_RASTERIZATION` nor `VERTEX_WRITABLE_STORAGE`: only
//! where a device has the latter do vertices write to buffers, which browsers refuse. Tint, Chromium's
//! compiler, takes all other shaders, of every technique with every setting. [`Shader::all`] and
//! [`ShaderText::receiver`] compose them without a device, to be checked or compiled beforehand.
//!
//! # Features
//!
//! - `serde`: settings of techniques, [`Filter`], [`technique::Bias`] and what a map takes ([`MemoryItem`]) can be
//!   saved and loaded.
//! - `store`: techniques may keep triangles by id in a way of their own (`antumbra::store`). Not settled.

/// The code of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod aabb;
mod bias;
mod bound;
mod camera;
mod capabilities;
mod capacity;
mod cast;
mod describe;
mod error;
mod filter;
mod kernel;
mod light;
mod listing;
mod map;
mod memory;
mod options;
mod parameter;
mod pass;
mod pipelines;
mod precision;
mod shader;
mod table;
pub mod technique;
mod tile;

/// How triangles are kept by id, for stores of one's own, which a technique names in
/// [`CasterStorage::Own`](technique::CasterStorage::Own). Not settled: minor versions may change it.
#[cfg(feature = "store")]
pub mod store {
    pub use crate::describe::store::{Array, Element, Image, OwnStore, Owner, Site, Step, Store};
}

pub use glam;
pub use wgpu;

pub use camera::visible_hull;
pub use capabilities::Capabilities;
pub use capacity::Capacity;
pub use cast::{CasterMesh, CasterPass, CutoutCaster, MeshPart};
pub use error::{CasterError, DescriptionError, LightError, MeshError, NameError, SettingError, Unsupported};
pub use filter::{Filter, Sampling, Values};
pub use kernel::{Kernel, Weights};
pub use light::{Bounds, CameraFit, Cascades, Fit, Light, Size, View};
pub use map::{Depth, PrepareError, ShadowMap};
pub use memory::{Lifetime, Memory, MemoryItem};
pub use options::{DEPTH_FORMAT, NoProbe, Options, Probe};
pub use parameter::{Choice, Field, Parameter};
pub use pipelines::Pipelines;
pub use precision::Precision;
pub use shader::{CASTER_WGSL, Shader, ShaderText};
pub use table::Table;
pub use technique::{Description, Technique, types::*};
pub use tile::{Placed, Tile};
