//! What receivers call: `shadow_visibility`, and the uniforms and bindings behind it.

use super::{
    ShaderText,
    compose::Composition,
    settings::{self, Reader},
};
use crate::describe::{Binding, DepthSpace, Description, Family, Map};
use std::fmt::Write;

/// What projecting, interpolating and storing as a float do to a projected depth: eight units in the
/// last place from ½ to 1.
const ROUNDING: &str = "4.8e-7";

impl Composition {
    /// `shadow_visibility` and everything it needs, bound in a group from a binding on, with `lookups` of what is kept of casters behind; it may call the user's
    /// `shadow_covers` about cut-outs.
    pub(crate) fn receiver(&self, lookups: impl FnOnce(u32, u32) -> String, at: (u32, u32)) -> ShaderText {
        let (group, first) = at;
        let description = &self.description;
        let mut glue = uniforms(description, self.most, at);
        glue += &settings::accessors(self, Reader::Receiver);
        let arguments = bindings(&mut glue, description, at);
        glue += &lookups(group, first + description.bindings.len() as u32 + 1);
        glue += &self.function(&arguments, "visibility", ["f32", "1.0"]);
        if !description.classes.is_empty() {
            glue += &self.function(&arguments, "class", ["u32", "0u"]);
        }
        let mut shader = self.looked_up.clone();
        shader.push("shadow_visibility", &glue);
        shader.prefix = Some(super::names::PREFIX.into());
        shader
    }

    /// `shadow_visibility` or `shadow_class`, with its type and what it is where there is no view.
    fn function(&self, arguments: &str, kind: &str, [result, outside]: [&str; 2]) -> String {
        let Self { description, most: [_, lights], .. } = self;
        let name = description.about.name;
        let (depth, slopes, scale, rounding) = match description.depth_space {
            DepthSpace::Raster => (
                "ndc.z",
                "vec2f(s.z, t.z)",
                "raster_slope(ndc.xyz, linear, (*seen).linear_over, (*seen).linear_under)",
                ROUNDING.to_string(),
            ),
            DepthSpace::Linear => (
                "linear",
                "vec2f(dot((*seen).depth_plane.xyz, tangent), dot((*seen).depth_plane.xyz, bitangent))",
                "1.0",
                format!(
                    "{ROUNDING} / raster_slope(ndc.xyz, linear, (*seen).linear_over, (*seen).linear_under)"
                ),
            ),
        };
        // Other families do not compare texels one by one: what they do with the plane is no bias.
        let followed = match description.about.family {
            Family::Comparison => "receiver_followed(own, shadow.receiver_plane, diagonal)",
            Family::Basis | Family::Geometry => "own",
        };
        let call =
            format!("{name}_{kind}({arguments}uv, view, depth, {followed} + lean, gradient_x, gradient_y)");
        include_str!("visibility.wgsl.in")
            .replace("{which}", if *lights > 1 { "light: u32, " } else { "" })
            .replace("{range}", &range(*lights))
            .replace("{kind}", kind)
            .replace("{result}", result)
            .replace("{outside}", outside)
            .replace("{depth}", depth)
            .replace("{slopes}", slopes)
            .replace("{scale}", scale)
            .replace("{rounding}", &rounding)
            .replace("{call}", &call)
    }
}

/// The views among which a receiver's is found: all, or those of a light. No light has numbers beyond the most.
fn range(lights: u32) -> String {
    match lights {
        1 => "vec2u(0u, shadow.view_count)".into(),
        _ => format!("select(vec2u(0u), shadow.lights[min(light, {}u)].xy, light < {lights}u)", lights - 1),
    }
}

/// The structs of uniforms, which `map/uniforms.rs` fills.
fn uniforms(description: &Description, [views, lights]: [u32; 2], (group, first): (u32, u32)) -> String {
    let per_view: String = settings::per_view(description).map(|name| format!(", {name}: f32")).collect();
    let once: String = settings::once(description).map(|name| format!("    {name}: f32,\n")).collect();
    let ranges = if lights > 1 { format!(" lights: array<vec4u, {lights}>,") } else { String::new() };
    format!(
        "struct ShadowView {{ clip_from_world: mat4x4f, depth_plane: vec4f, to_light: vec4f, linear_over: vec4f, linear_under: vec4f, tile: vec4f, texel_world: f32, reach_x: f32, reach_y: f32, layer: u32, depth_per_world: f32, lean_x: f32, lean_y: f32{per_view} }}\n\
         struct ShadowUniforms {{\n    views: array<ShadowView, {views}>,{ranges}\n    view_count: u32, width: f32, height: f32,\n    constant_texels: f32, slope_texels: f32, normal_offset_texels: f32, grazing_offset_texels: f32,\n    receiver_plane: f32, constant_depth: f32, float_steps: f32,\n{once}}}\n\
         @group({group}) @binding({first}) var<uniform> shadow: ShadowUniforms;\n"
    )
}

/// Declares the technique's bindings; the arguments that they are.
fn bindings(glue: &mut String, description: &Description, (group, first): (u32, u32)) -> String {
    let mut arguments = String::new();
    for (i, binding) in description.bindings.iter().enumerate() {
        let (name, ty) = (format!("shadow_binding_{i}"), wgsl_type(*binding, &description.maps));
        let _ = writeln!(glue, "@group({group}) @binding({}) var {name}: {ty};", first + i as u32 + 1);
        let _ = write!(arguments, "{name}, ");
    }
    arguments
}

/// WGSL type of a binding.
fn wgsl_type(binding: Binding, maps: &[Map]) -> &'static str {
    match binding {
        Binding::Depth => "texture_depth_2d_array",
        Binding::Compare(_) => "sampler_comparison",
        Binding::Map(i) if maps.get(i).is_some_and(Map::holds_integers) => "texture_2d_array<u32>",
        Binding::Map(_) => "texture_2d_array<f32>",
        Binding::Sampler => "sampler",
    }
}
