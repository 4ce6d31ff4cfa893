//! From the casters' depth to what a technique keeps, alone or fused with the rows of a blur.

use super::{FilterStep, Holder, Place, Span, blur, combine, targets};
use crate::{
    describe::{Combine, Encode, Map},
    kernel::Kernel,
    shader::{Composition, settings},
};

/// Linear depth of `depth` where it does not depend on the place in the picture.
const STRAIGHT: &str = "(convert.linear_over.z * depth + convert.linear_over.w) / (convert.linear_under.z * depth + convert.linear_under.w)";
/// Linear depth of `depth` at `uv` in any picture.
const WARPED: &str = "raster_linear(vec3f(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, depth), convert.linear_over, convert.linear_under)";

/// `place` of a position in a texture that is the view's, and its `uv` in the picture.
const WHOLE: &str = "    let uv = position / vec2f(textureDimensions(casters));\n    let place = uv;\n";
/// The same where the view is a part of a texture; beyond the view's edge the nearest that is in it.
const PLACED: &str = "    let at = clamp(position - convert.tile.xy, vec2f(0.5), convert.tile.zw - 0.5);\n    let uv = at / convert.tile.zw;\n    let place = (convert.tile.xy + at) / vec2f(textureDimensions(casters));\n";

/// WGSL that gives encoded texels: `convert_source(p, which)` and `convert_layer(source, layer)`.
#[derive(Debug)]
pub(super) struct Source {
    wgsl: String,
    encode: Encode,
}

impl Source {
    pub(super) fn new(composition: &Composition, map: &Map) -> Self {
        let description = &composition.description;
        let names = settings::once(description).chain(settings::per_view(description));
        let members: String = names.map(|name| format!(", {name}: f32")).collect();
        let (kind, function, depth) = match map.encode {
            Encode::Texel(function) => ("f32", function, include_str!("convert/texel.wgsl")),
            Encode::Neighbours(function) => ("mat3x3f", function, include_str!("convert/neighbours.wgsl")),
        };
        let glue = include_str!("convert/depth.wgsl.in")
            .replace("{members}", &members)
            .replace("{place}", if composition.tiled { PLACED } else { WHOLE })
            .replace("{linear}", if composition.warped { WARPED } else { STRAIGHT })
            .replace("{kind}", kind)
            .replace("{call}", &format!("{function}(source, layer)"));
        Self { wgsl: composition.for_convert() + &glue + depth, encode: map.encode }
    }

    /// Whether texels may be encoded once per tap.
    pub(super) fn is_cheap(&self) -> bool {
        matches!(self.encode, Encode::Texel(_))
    }

    /// The WGSL, for other ways to run it.
    pub(super) fn wgsl(&self) -> &str {
        &self.wgsl
    }

    /// Encodes layers of a map.
    pub(super) fn plain(&self, span: Span) -> FilterStep {
        let stores: String = layers(span)
            .map(|(i, layer)| format!("    targets.layer_{i} = convert_layer(source, {layer}u);\n"))
            .collect();
        let body = format!("    let source = convert_source(position.xy, 0u);\n{stores}");
        span.step("convert", self.fragment(span, &body), CASTERS, span.kept(0))
    }

    /// Encodes the depths of caster passes from `first` on, at most four, as the channels of a layer.
    pub(super) fn channels(&self, first: u32, casts: u32, span: Span) -> FilterStep {
        let count = (casts - first).min(4);
        let body: String = (0..count)
            .map(|cast| {
                let source = format!("convert_source(position.xy, {cast}u)");
                format!("    targets.layer_0[{cast}] = convert_layer({source}, {}u)[{cast}];\n", span.first)
            })
            .collect();
        let from = Place { holder: Holder::Casts { first, count, of: casts }, layer: 0, mip: 0 };
        let step = span.step("convert", self.fragment(span, &body), from, span.kept(0));
        FilterStep { source_layers: count, ..step }
    }

    /// Encodes layers of a map and blurs them along x, into scratch.
    pub(super) fn rows(&self, kernel: &Kernel, how: Combine, span: Span) -> FilterStep {
        let mut body: String =
            layers(span).map(|(i, _)| format!("    var sum_{i} = combine_none();\n")).collect();
        body += &blur::taps(kernel, "convert", |offset, weight| {
            let sums = layers(span).map(|(i, layer)| {
                format!("    sum_{i} = combine_add(sum_{i}, {weight}, convert_layer(source, {layer}u));\n")
            });
            format!(
                "    {{\n    let source = convert_source(position.xy + vec2f({offset}, 0.0), 0u);\n{}    }}\n",
                sums.collect::<String>()
            )
        });
        for (i, _) in layers(span) {
            body += &format!("    targets.layer_{i} = combine_result(sum_{i});\n");
        }
        let shader = combine(how) + &self.fragment(span, &body);
        span.step("convert", shader, CASTERS, span.scratch())
    }

    fn fragment(&self, span: Span, body: &str) -> String {
        let end = include_str!("convert/fragment.wgsl.in")
            .replace("{targets}", &targets(span.count))
            .replace("{body}", body);
        self.wgsl.clone() + &end
    }
}

const CASTERS: Place = Place { holder: Holder::Casters, layer: 0, mip: 0 };

/// Number within the run, and layer of the map.
fn layers(span: Span) -> impl Iterator<Item = (u32, u32)> {
    (0..span.count).map(move |i| (i, span.first + i))
}
