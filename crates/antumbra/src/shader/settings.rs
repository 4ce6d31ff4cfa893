//! The settings of a technique in WGSL: members of uniform structs, and the functions that read them.

use super::Composition;
use crate::describe::{Description, Family};

/// Where a text finds the settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reader {
    /// In the receiver's uniforms, those of all views.
    Receiver,
    /// In the uniforms of the passes between casting and lighting, those of one view.
    Convert,
    /// Nowhere: as numbers in the text, kernels at their widest. For texts that look nothing up.
    Alone,
}

/// Names of the members that all views share.
pub(crate) fn once(description: &Description) -> impl Iterator<Item = String> {
    description.uniforms.iter().map(|(name, _)| format!("setting_{name}"))
}

/// Names of the members that each view has: widths of kernels in texels, the variance of the blur.
pub(crate) fn per_view(description: &Description) -> impl Iterator<Item = String> {
    let widths = description.widths.iter().map(|(name, _)| format!("width_{name}"));
    widths.chain(description.blur.map(|_| "blur".into()))
}

/// The functions through which the WGSL of a technique named `x` reads them: `x_setting() -> f32`,
/// `x_width(view: u32) -> f32` and `shadow_blur(view: u32) -> f32`. And those that `uphill` and the
/// files of the slot `tile` call.
pub(crate) fn accessors(composition: &Composition, reader: Reader) -> String {
    let Composition { description, .. } = composition;
    let technique = description.about.name;
    let once = description.uniforms.iter().zip(once(description)).map(|((name, value), member)| {
        let read = match reader {
            Reader::Receiver => format!("shadow.{member}"),
            Reader::Convert => format!("convert.{member}"),
            Reader::Alone => format!("{value:?}"),
        };
        format!("fn {technique}_{name}() -> f32 {{ return {read}; }}\n")
    });
    let names = description.widths.iter().map(|(name, _)| format!("{technique}_{name}"));
    let widest = description.widths.iter().map(|(_, width)| width.texels);
    let blur = description.blur.map(|blur| ("shadow_blur".to_string(), blur.variance(0.0)));
    let per_view =
        names.zip(widest).chain(blur).zip(per_view(description)).map(|((name, widest), member)| {
            let read = match reader {
                Reader::Receiver => format!("shadow.views[view].{member}"),
                Reader::Convert => format!("convert.{member}"),
                Reader::Alone => format!("{widest:?}"),
            };
            format!("fn {name}(view: u32) -> f32 {{ return {read}; }}\n")
        });
    once.chain(per_view).chain([places(reader, composition.tiled)]).chain(lean(description, reader)).collect()
}

/// How depth leans in a view, which comparisons ask for.
fn lean(description: &Description, reader: Reader) -> Option<String> {
    let read = match reader {
        Reader::Receiver => "vec2f(shadow.views[view].lean_x, shadow.views[view].lean_y)",
        Reader::Convert | Reader::Alone => "vec2f(0.0)",
    };
    let lean = format!("fn uphill_lean(view: u32) -> vec2f {{ return {read}; }}\n");
    (description.about.family == Family::Comparison).then_some(lean)
}

/// `shadow_size() -> vec2f`, texels of a layer; where views may be parts of one `shadow_place(view: u32) -> vec4f`, origin
/// and size, and `shadow_layer(view: u32) -> u32`. Numbers where nothing is looked up.
fn places(reader: Reader, tiled: bool) -> String {
    let [size, tile, layer] = match reader {
        Reader::Receiver => {
            ["vec2f(shadow.width, shadow.height)", "shadow.views[view].tile", "shadow.views[view].layer"]
        }
        Reader::Convert | Reader::Alone => ["vec2f(1.0)", "vec4f(0.0, 0.0, 1.0, 1.0)", "view"],
    };
    let size = format!("fn shadow_size() -> vec2f {{ return {size}; }}\n");
    let placed = format!(
        "fn shadow_place(view: u32) -> vec4f {{ return {tile}; }}\n\
         fn shadow_layer(view: u32) -> u32 {{ return {layer}; }}\n"
    );
    if tiled { size + &placed } else { size }
}
