//! Arrays and images that stores keep triangles in, and the WGSL through which shaders reach them.

use super::split::Split;
use crate::describe::store::{Array, Element, Image, Owner, Site};
use std::fmt::Write;

impl Element {
    /// Bytes of an element.
    pub(super) fn bytes(self) -> u64 {
        match self {
            Self::Word => 4,
            Self::Corners => 48,
        }
    }

    /// Type of an element's name in WGSL, `atomic` if other invocations write it at the same time.
    fn wgsl(self, atomic: bool) -> &'static str {
        match (self, atomic) {
            (Self::Word, false) => "u32",
            (Self::Word, true) => "atomic<u32>",
            (Self::Corners, _) => "array<vec4f, 3>",
        }
    }
}

/// Everything that a store keeps in one map.
#[derive(Debug)]
pub(super) struct Storage {
    pub(super) arrays: Vec<(Array, Split)>,
    pub(super) images: Vec<Image>,
}

/// Whether a text calls functions of an array or image.
pub(super) fn called(name: &str, text: &str) -> bool {
    text.contains(&format!("{name}_"))
}

impl Storage {
    pub(super) fn new(arrays: Vec<Array>, images: Vec<Image>, site: &Site<'_>) -> Self {
        let limits = &site.device.limits;
        let max = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let split = |array: Array| {
            let parts = match array.owner {
                Owner::View => u64::from(site.views),
                Owner::Layer => u64::from(site.layers),
                Owner::Shared => 1,
            };
            let split = Split::new(array.length * parts, array.element.bytes(), max);
            (array, split)
        };
        Self { arrays: arrays.into_iter().map(split).collect(), images }
    }

    /// What a text of a pass calls: bindings of group 0, from `binding` on, and functions.
    pub(super) fn written(&self, text: &str, mut binding: u32) -> String {
        let mut wgsl = String::new();
        for (array, split) in self.arrays.iter().filter(|(array, _)| called(array.name, text)) {
            wgsl += &array.written(*split, text, binding);
            binding += split.count();
        }
        for Image { name, .. } in self.images.iter().filter(|image| called(image.name, text)) {
            let _ = write!(
                wgsl,
                "@group(0) @binding({binding}) var {name}: texture_storage_2d_array<r32uint, write>;\n\
                 fn {name}_store(at: vec2u, layer: u32, value: u32) {{ textureStore({name}, at, layer, vec4u(value)); }}\n\
                 fn {name}_size() -> vec2u {{ return textureDimensions({name}); }}\n"
            );
            binding += 1;
        }
        wgsl
    }

    /// What lookups call: bindings of `group`, from `binding` on, and functions.
    pub(super) fn looked_up(&self, group: u32, mut binding: u32) -> String {
        let mut wgsl = String::new();
        for (Array { name, element, .. }, split) in self.arrays.iter().filter(|(array, _)| array.looked_up) {
            wgsl += &split.declared(name, "read", element.wgsl(false), group, |k| binding + k);
            wgsl += &match element {
                Element::Word => loads(name, *split),
                Element::Corners => corner_loads(name, *split),
            };
            binding += split.count();
        }
        for Image { name, layers, .. } in &self.images {
            let _ = write!(
                wgsl,
                "@group({group}) @binding({binding}) var {name}: texture_2d_array<u32>;\n\
                 fn {name}_load(view: u32, at: vec2u, layer: u32) -> u32 {{ return textureLoad({name}, at, tile_layer(view) * {layers}u + layer, 0).x; }}\n\
                 fn {name}_size() -> vec2u {{ return textureDimensions({name}); }}\n"
            );
            binding += 1;
        }
        wgsl
    }
}

impl Array {
    /// Its buffers in group 0 and those of its functions that a text calls.
    fn written(&self, split: Split, text: &str, binding: u32) -> String {
        let Self { name, element, .. } = self;
        let calls = |function: &str| text.contains(&format!("{name}_{function}("));
        let atomic = ["add", "max", "or"].into_iter().any(calls);
        let mut wgsl = split.declared(name, "read_write", element.wgsl(atomic), 0, |k| binding + k);
        if *element == Element::Corners {
            if calls("load") {
                wgsl += &corner_loads(name, split);
            }
            let store = split.chosen(name, |buffer, i| format!("{buffer}[{i}][k] = value; return;"));
            let _ = writeln!(wgsl, "fn {name}_store(i: u32, k: u32, value: vec4f) {{ {store} }}");
            return wgsl;
        }
        if calls("load") && !atomic {
            wgsl += &loads(name, split);
        }
        if calls("load") && atomic {
            let load = split.chosen(name, |buffer, i| format!("return atomicLoad(&{buffer}[{i}]);"));
            let _ = writeln!(wgsl, "fn {name}_load(i: u32) -> u32 {{ {load} }}");
        }
        if calls("store") {
            let store = split.chosen(name, |buffer, i| match atomic {
                true => format!("atomicStore(&{buffer}[{i}], value); return;"),
                false => format!("{buffer}[{i}] = value; return;"),
            });
            let _ = writeln!(wgsl, "fn {name}_store(i: u32, value: u32) {{ {store} }}");
        }
        for (function, builtin) in [("add", "atomicAdd"), ("max", "atomicMax"), ("or", "atomicOr")] {
            if calls(function) {
                let body =
                    split.chosen(name, |buffer, i| format!("return {builtin}(&{buffer}[{i}], value);"));
                let _ = writeln!(wgsl, "fn {name}_{function}(i: u32, value: u32) -> u32 {{ {body} }}");
            }
        }
        wgsl
    }
}

fn loads(name: &str, split: Split) -> String {
    let load = split.chosen(name, |buffer, i| format!("return {buffer}[{i}];"));
    format!("fn {name}_load(i: u32) -> u32 {{ {load} }}\n")
}

fn corner_loads(name: &str, split: Split) -> String {
    let load = split.chosen(name, |buffer, i| format!("return {buffer}[{i}][k];"));
    format!("fn {name}_load(i: u32, k: u32) -> vec4f {{ {load} }}\n")
}
