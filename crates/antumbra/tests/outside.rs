//! A technique from outside of the library, written against its public interface alone.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{
    Capabilities, Description, Field, Filter, Options, Parameter, Shader, ShaderText, ShadowMap, Size,
    Technique, Unsupported, Values, technique,
    technique::{About, Constant, Encode, Family},
};
use antumbra_testing::{Gpu, Trials};
use common::{Random, Receiver, depth_texture, shadow_map, visibility};

const SIZE: Size = Size::square(32);

type Edit = fn(&mut Description);

/// An exponential shadow map; `edit` is what its description gets wrong.
#[derive(Debug, Clone)]
struct Own {
    c: f32,
    filter: Filter,
    edit: Edit,
}

const WGSL: &str = "//! needs lookup tile

fn own_encode(depth: f32, layer: u32) -> vec4f {
    return vec4f(exp(own_c() * depth), 0.0, 0.0, 0.0);
}

fn own_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    return min(exp(-own_c() * depth) * lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy).x, 1.0);
}
";

impl Technique for Own {
    fn about(&self) -> About {
        About { name: "own", title: "Exponential", family: Family::Basis, paper: "none" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let steepness = Parameter::new("c", "", Field::Number(&mut self.c, 1.0..=80.0), "steepness");
        [steepness].into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let encode = Encode::Texel("own_encode");
        let values = Values::new("exponentials", wgpu::TextureFormat::R32Float, encode);
        let mut described = Description::filtered(self.about(), WGSL, &self.filter, values, device);
        described.uniforms = vec![("c", self.c)];
        (self.edit)(&mut described);
        Ok(described)
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(self.clone())
    }
}

fn own(c: f32, edit: Edit) -> Own {
    Own { c, filter: Filter::default(), edit }
}

/// It answers as the library's own does, to the bit.
fn answers(gpu: &Gpu) {
    let mut random = Random::new(1);
    let depths: Vec<f32> = (0..SIZE.width * SIZE.height).map(|_| random.unit()).collect();
    let depth = depth_texture(gpu, SIZE, |x, y| depths[(y * SIZE.width + x) as usize]);
    let receivers: Vec<Receiver> =
        (0..1024).map(|_| Receiver::point(random.unit(), random.unit(), random.unit())).collect();
    let ask = |technique: &dyn Technique| {
        visibility(gpu, &shadow_map(gpu, technique, &depth, SIZE.into()), &receivers)
    };
    let esm = technique::parse("esm.c=60,classifier=none").unwrap();
    let expected = ask(esm.as_ref());
    assert_eq!(ask(&own(60.0, |_| ())), expected);
    assert_ne!(ask(&own(59.0, |_| ())), expected);
}

/// What is wrong with its description is said wherever it is composed, in release too.
fn refusals(gpu: &Gpu) {
    let wrong: [(Edit, &[&str]); 5] = [
        (|d| d.wgsl = "//! needs nothing_there".into(), &["'nothing_there'", "lookup_fitted"]),
        (|d| d.slots.clear(), &["slot 'lookup'", "lookup_bilinear", "Description::slots"]),
        (|d| d.constants.push(Constant::Count("own_terms", 2)), &["'own_terms' 0 times", "const own_terms"]),
        (|d| d.maps.clear(), &["binds map 0", "has 0", "Description::maps"]),
        (|d| d.sample_offsets.clear(), &["no sample offsets"]),
    ];
    for (edit, words) in wrong {
        let technique = own(60.0, edit);
        let (device, options) = (Capabilities::of(&gpu.device), Options::from(SIZE));
        let error = ShadowMap::new(&gpu.device, &technique, SIZE).unwrap_err();
        let message = error.to_string();
        let said = words.iter().all(|word| message.contains(word));
        assert!(said && message.starts_with("the description of own is wrong: "), "{message}");
        assert_eq!(ShaderText::receiver(&technique, &device, &options, 0).unwrap_err(), error);
        assert_eq!(Shader::all(&technique, &device, &options, None).unwrap_err(), error);
    }
}

fn main() {
    let mut trials = Trials::default();
    trials.add("it answers as the library's own", answers);
    trials.add("what is wrong with it is named", refusals);
    trials.run();
}
