//! What GPU tests share: one device, error scopes, a test runner that can say "ignored"; and the laws of all
//! techniques.

pub mod ask;
pub mod broken;
pub mod image;
pub mod laws;
pub mod settings;
pub mod shaders;

use std::sync::OnceLock;

/// A device with everything that it offers of what antumbra can use.
#[derive(Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// What it is.
    pub info: wgpu::AdapterInfo,
}

/// Optional features that antumbra and its lab make use of.
pub const FEATURES: wgpu::Features =
    antumbra::Capabilities::OPTIONAL_FEATURES.union(wgpu::Features::TIMESTAMP_QUERY);

/// The device that all tests of a program share; `None` if the machine has no adapter.
#[must_use]
pub fn gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    GPU.get_or_init(|| gpu_without(wgpu::Features::empty())).as_ref()
}

/// A device of its own without some features, to take the paths for lesser devices.
#[must_use]
pub fn gpu_without(missing: wgpu::Features) -> Option<Gpu> {
    open(|adapter| (FEATURES.difference(missing), adapter.limits()))
}

/// A device of its own with some features, as far as the adapter has them, and these limits.
#[must_use]
pub fn gpu_with(features: wgpu::Features, limits: wgpu::Limits) -> Option<Gpu> {
    open(|_| (features, limits))
}

fn open(choose: impl FnOnce(&wgpu::Adapter) -> (wgpu::Features, wgpu::Limits)) -> Option<Gpu> {
    let backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    pollster::block_on(async {
        let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await.ok()?;
        let (features, required_limits) = choose(&adapter);
        let descriptor = wgpu::DeviceDescriptor {
            required_features: adapter.features() & features,
            required_limits,
            ..Default::default()
        };
        let (device, queue) = adapter.request_device(&descriptor).await.ok()?;
        Some(Gpu { device, queue, info: adapter.get_info() })
    })
}

impl Gpu {
    /// Whether the device is a processor with a driver that is as precise as floats. Graphics cards weigh
    /// the texels of a sampler with 8 bits, and round corners of triangles and small numbers in ways of
    /// their own. SwiftShader promises no more than they do (4 bits for texels and for corners), so it is
    /// granted what they are.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu && !self.info.name.contains("SwiftShader")
    }

    /// Runs `f` and panics with every validation or memory error that it causes.
    ///
    /// # Panics
    /// If the device reports an error.
    pub fn checked<T>(&self, f: impl FnOnce(&Self) -> T) -> T {
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        // An assertion that fails because of a GPU error must not hide it.
        let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| f(self)));
        for scope in [memory, validation] {
            if let Some(error) = pollster::block_on(scope.pop()) {
                panic!("GPU error: {error}");
            }
        }
        result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }

    /// Waits and reads a buffer that has `COPY_SRC`.
    ///
    /// # Panics
    /// If the device is lost.
    #[must_use]
    pub fn read_buffer(&self, buffer: &wgpu::Buffer) -> Vec<u8> {
        let staging = self.staging(buffer.size());
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        self.map(&staging)
    }

    /// Waits and reads one layer and level of a texture that has `COPY_SRC`: rows without padding.
    ///
    /// # Panics
    /// If the device is lost.
    #[must_use]
    pub fn read_texture(&self, texture: &wgpu::Texture, layer: u32, mip: u32) -> Vec<u8> {
        let (width, height) = ((texture.width() >> mip).max(1), (texture.height() >> mip).max(1));
        let row = width * texture.format().block_copy_size(None).unwrap_or(4);
        let padded = row.next_multiple_of(256);
        let staging = self.staging(u64::from(padded) * u64::from(height));
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: mip,
                origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
                aspect: wgpu::TextureAspect::All,
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: Some(height),
                },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        self.queue.submit([encoder.finish()]);
        let bytes = self.map(&staging);
        bytes.chunks(padded as usize).flat_map(|line| &line[..row as usize]).copied().collect()
    }

    fn staging(&self, size: u64) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        })
    }

    #[allow(clippy::expect_used, reason = "tests fail by panicking")]
    fn map(&self, staging: &wgpu::Buffer) -> Vec<u8> {
        let slice = staging.slice(..);
        slice.map_async(wgpu::MapMode::Read, |result| result.expect("buffer can be mapped"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("device answers");
        let bytes = slice.get_mapped_range().expect("buffer is mapped").to_vec();
        staging.unmap();
        bytes
    }
}

/// Collects trials that need the GPU. Without an adapter they are reported as ignored: a test that
/// did not run must not count as passed.
#[derive(Debug, Default)]
pub struct Trials {
    trials: Vec<libtest_mimic::Trial>,
}

impl Trials {
    /// Adds a test; it fails by panicking. Runs inside an error scope.
    pub fn add(&mut self, name: impl Into<String>, test: impl FnOnce(&Gpu) + Send + 'static) {
        let trial = libtest_mimic::Trial::test(name, move || {
            if let Some(gpu) = gpu() {
                gpu.checked(test);
            }
            Ok(())
        });
        self.trials.push(trial.with_ignored_flag(gpu().is_none()));
    }

    /// Adds a test that needs no GPU and runs everywhere.
    pub fn add_plain(&mut self, name: impl Into<String>, test: impl FnOnce() + Send + 'static) {
        self.trials.push(libtest_mimic::Trial::test(name, move || {
            test();
            Ok(())
        }));
    }

    /// Runs everything as `cargo test` expects and ends the process. If the environment variable
    /// `ANTUMBRA_ADAPTER` holds part of a name, no adapter but one of that name will do.
    pub fn run(self) -> ! {
        let found = gpu().map_or("none", |gpu| &gpu.info.name);
        match std::env::var("ANTUMBRA_ADAPTER") {
            Ok(wanted) if found.contains(&wanted) => eprintln!("adapter: {found}"),
            Ok(wanted) => {
                eprintln!("ANTUMBRA_ADAPTER is {wanted}, but the adapter is: {found}");
                std::process::exit(1);
            }
            Err(_) => {}
        }
        if gpu().is_none() {
            eprintln!(
                "no GPU adapter: these tests are ignored (Debian, Ubuntu: apt-get install mesa-vulkan-drivers)"
            );
        }
        let mut arguments = libtest_mimic::Arguments::from_args();
        // One device, and error scopes belong to threads: one test at a time.
        arguments.test_threads = Some(1);
        libtest_mimic::run(&arguments, self.trials).exit()
    }
}
