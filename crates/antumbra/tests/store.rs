//! A store from outside of the library, with the technique that looks it up, written against the public
//! interface alone: of each texel the first triangle, whose plane stands for all of the texel.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

#[allow(dead_code, reason = "some laws are of filters")]
#[path = "laws/answers.rs"]
mod answers;
#[allow(dead_code, reason = "as laws")]
#[path = "laws/cases.rs"]
mod cases;
mod common;
#[allow(dead_code, reason = "some laws are of filters")]
#[path = "laws/filters.rs"]
mod filters;

use antumbra::{
    Capabilities, Capacity, Description, Options, Parameter, ShadowMap, Size, Technique, Unsupported,
    store::{Array, Element, OwnStore, Site, Step, Store},
    technique::{About, CasterStorage, Family},
};
use antumbra_testing::{Gpu, Trials};

/// A k-buffer of one; shared files that its WGSL needs.
#[derive(Debug)]
struct First(&'static [&'static str]);

static FIRST: First = First(&["key"]);
static NEEDY: First = First(&["key", "keyhole"]);

const FILL: &str = "
fn store_keeps_vertices() -> bool { return true; }

fn store_triangle(shaped: CasterTriangle, triangle: u32, seen: mat3x3f, id: u32) -> CasterTriangle {
    var out = shaped;
    out.id = id;
    out.slope = caster_slope(triangle, caster_places(out));
    return out;
}

fn store_depth(in: CasterTriangle, at: vec2f) -> f32 {
    return 0.5;
}

@fragment fn fragment(in: CasterTriangle) {
    let touch = caster_touch(in);
    if in.id >= caster_step.triangles {
        return;
    }
    let at = vec2u(in.position.xy);
    let size = vec2u(caster_view.size);
    let depth = in.depths.x + dot(in.slope, touch.centre);
    let i = (caster_step.view * size.y + at.y) * size.x + at.x;
    first_keys_max(i, key_of(false, depth, in.id, caster_step.words.x));
    vertices_keep_all(in);
}
";

const LOOKUPS: &str = "
fn shadow_first(i: u32) -> u32 { return first_keys_load(i); }
fn shadow_first_bits() -> u32 { return BITSu; }
fn shadow_first_size() -> vec2u { return vec2u(u32(shadow.width), u32(shadow.height)); }
";

impl Store for First {
    fn name(&self) -> &'static str {
        "first"
    }
    fn arrays(&self, site: &Site<'_>) -> Vec<Array> {
        vec![Array {
            name: "first_keys",
            title: "keys",
            element: Element::Word,
            length: site.texels(),
            per_view: true,
            cleared: true,
            looked_up: true,
        }]
    }
    fn steps(&self, site: &Site<'_>) -> Vec<Step> {
        vec![Step::Draw { words: [site.capacity.id_bits(), 0] }]
    }
    fn needs(&self) -> &'static [&'static str] {
        self.0
    }
    fn varyings(&self) -> &'static [(&'static str, &'static str)] {
        &[("slope", "vec2f")]
    }
    fn wgsl(&self) -> &'static str {
        FILL
    }
    fn lookups(&self, site: &Site<'_>) -> String {
        LOOKUPS.replace("BITS", &site.capacity.id_bits().to_string())
    }
    fn explain(&self, _: &Site<'_>) -> String {
        "the first triangle of each texel".into()
    }
}

/// Answers by that triangle's plane; `view` is whose corners are taken.
#[derive(Debug, Clone)]
struct Plane {
    view: &'static str,
    store: &'static First,
}

const WGSL: &str = "//! needs key coverage

fn plane_visibility(uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = shadow_first_size();
    let point = uv * vec2f(size);
    let texel = min(vec2u(max(point, vec2f(0.0))), size - 1u);
    let key = shadow_first((view * size.y + texel.y) * size.x + texel.x);
    if key == 0u {
        return 1.0;
    }
    let id = key_number(key, shadow_first_bits());
    let ray = vec3f(point, 0.0);
    let a = shadow_corner(VIEW, id, 0u) - ray;
    let b = shadow_corner(VIEW, id, 1u) - ray;
    let c = shadow_corner(VIEW, id, 2u) - ray;
    let met = a.z - dot(coverage_slope(mat3x3f(a, b, c)), a.xy);
    return select(1.0, 0.0, met < depth && shadow_stops(view, id, a, b, c));
}
";

impl Technique for Plane {
    fn about(&self) -> About {
        About { name: "plane", title: "First planes", family: Family::Geometry, paper: "none" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        Vec::new()
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let storage = CasterStorage::Own(OwnStore(self.store));
        Ok(Description::triangles(self.about(), WGSL.replace("VIEW", self.view), storage))
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(self.clone())
    }
}

static WHOLE: Plane = Plane { view: "view", store: &FIRST };

/// Memory and counts are told as of the library's own.
fn tells_what_it_keeps(gpu: &Gpu) {
    let capacity = Capacity { triangles: 100, ..Capacity::default() };
    let options = Options::from(Size::square(16)).views(2).capacity(capacity);
    let shadows = ShadowMap::new(&gpu.device, &WHOLE, options).unwrap();
    let memory = shadows.memory();
    let bytes = |name: &str| memory.items.iter().find(|i| i.name == name).map_or(0, |i| i.bytes);
    assert_eq!([bytes("first keys"), bytes("first vertices")], [2 * 4 * 16 * 16, 2 * 48 * 100]);
    assert!(shadows.explain().iter().any(|line| line == "the first triangle of each texel"));
    assert!(shadows.description().storage.keeps_ids());
}

/// A file that does not exist is named, with those that do.
fn missing_files_are_named(gpu: &Gpu) {
    let needy = Plane { store: &NEEDY, ..WHOLE.clone() };
    let error = ShadowMap::new(&gpu.device, &needy, Size::square(16)).unwrap_err().to_string();
    assert!(error.contains("plane") && error.contains("keyhole") && error.contains("coverage"), "{error}");
}

fn main() {
    type Law = fn(&Gpu, &dyn Technique) -> Result<(), String>;
    let laws: [(&str, Law); 7] = [
        ("visibility within [0,1]", answers::stays_within_zero_and_one),
        ("lit without casters", answers::is_lit_without_casters),
        ("dark behind a blocker", answers::is_dark_behind_a_blocker),
        ("darker with depth", answers::darkens_with_depth),
        ("hard when the kernel shrinks", answers::shrinks_to_the_hard_shadow),
        ("the same in any view", answers::views_do_not_matter),
        ("fallbacks agree", filters::fallbacks_agree),
    ];
    let mut trials = Trials::default();
    for (name, law) in laws {
        trials.add(format!("a store of one's own: {name}"), move |gpu| law(gpu, &WHOLE).unwrap());
    }
    trials.add("rejected: corners of the first view", |gpu| {
        answers::views_do_not_matter(gpu, &Plane { view: "0u", ..WHOLE.clone() })
            .expect_err("a law must tell");
    });
    trials.add("a store tells what it keeps", tells_what_it_keeps);
    trials.add("files that a store needs and nobody has", missing_files_are_named);
    trials.run();
}
