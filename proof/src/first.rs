//! A store: of each texel the first triangle.

use antumbra::store::{Array, Element, Owner, Site, Step, Store};

/// A k-buffer that keeps one triangle.
#[derive(Debug)]
pub struct First;

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
            owner: Owner::Layer,
            cleared: true,
            looked_up: true,
        }]
    }
    fn steps(&self, site: &Site<'_>) -> Vec<Step> {
        vec![Step::Draw { words: [site.capacity.id_bits(), 0] }]
    }
    fn needs(&self) -> &'static [&'static str] {
        &["key"]
    }
    fn varyings(&self) -> &'static [(&'static str, &'static str)] {
        &[("slope", "vec2f")]
    }
    fn wgsl(&self) -> &'static str {
        include_str!("first.wgsl")
    }
    fn lookups(&self, site: &Site<'_>) -> String {
        let bits = site.capacity.id_bits();
        format!(
            "fn shadow_first(i: u32) -> u32 {{ return first_keys_load(i); }}
fn shadow_first_bits() -> u32 {{ return {bits}u; }}
"
        )
    }
    fn explain(&self, _: &Site<'_>) -> String {
        "the first triangle of each texel".into()
    }
}
