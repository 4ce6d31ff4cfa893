//! Which pipelines a module makes: each compute entry point, each vertex entry point alone or with each
//! fragment entry point that it feeds.

use naga::{Binding, BuiltIn, EntryPoint, Handle, Module, Scalar, ScalarKind, ShaderStage, Type, TypeInner};
use serde_json::{Map, Value, json};

/// What an entry point takes or gives at numbered places, and whether it gives a depth.
#[derive(Debug, Default)]
struct Interface {
    places: Vec<(u32, Handle<Type>)>,
    depth: bool,
}

impl Interface {
    fn add(&mut self, module: &Module, ty: Handle<Type>, binding: Option<&Binding>) {
        match (binding, &module.types[ty].inner) {
            (Some(Binding::Location { location, .. }), _) => self.places.push((*location, ty)),
            (Some(Binding::BuiltIn(BuiltIn::FragDepth)), _) => self.depth = true,
            (None, TypeInner::Struct { members, .. }) => {
                members.iter().for_each(|m| self.add(module, m.ty, m.binding.as_ref()));
            }
            _ => {}
        }
    }

    fn input(module: &Module, entry: &EntryPoint) -> Self {
        let mut all = Self::default();
        entry.function.arguments.iter().for_each(|a| all.add(module, a.ty, a.binding.as_ref()));
        all
    }

    fn output(module: &Module, entry: &EntryPoint) -> Self {
        let mut all = Self::default();
        entry.function.result.iter().for_each(|r| all.add(module, r.ty, r.binding.as_ref()));
        all.places.sort_by_key(|(location, _)| *location);
        all
    }
}

/// Values for constants of pipelines that have none.
pub(super) fn constants(module: &Module) -> Value {
    let open = module.overrides.iter().filter(|(_, o)| o.init.is_none());
    Value::Object(open.filter_map(|(_, o)| Some((o.name.clone()?, json!(0.5)))).collect::<Map<_, _>>())
}

/// All of a module's; `targets` holds the formats of its colours, if not any will do.
pub(super) fn of(module: &Module, targets: &[String]) -> Vec<Value> {
    let of_stage = |stage| module.entry_points.iter().filter(move |entry| entry.stage == stage);
    let mut all: Vec<Value> =
        of_stage(ShaderStage::Compute).map(|entry| json!({ "compute": entry.name })).collect();
    for vertex in of_stage(ShaderStage::Vertex) {
        let taken = Interface::input(module, vertex).places;
        let attributes: Vec<Value> = taken.iter().map(|(i, ty)| json!([i, attribute(module, *ty)])).collect();
        let given = Interface::output(module, vertex).places;
        let mut any = false;
        for fragment in of_stage(ShaderStage::Fragment) {
            if !Interface::input(module, fragment).places.iter().all(|place| given.contains(place)) {
                continue;
            }
            any = true;
            let out = Interface::output(module, fragment);
            let by_type = || out.places.iter().map(|(_, ty)| colour(module, *ty)).collect();
            let targets: Vec<String> = if targets.is_empty() { by_type() } else { targets.to_vec() };
            all.push(json!({
                "vertex": vertex.name,
                "attributes": attributes,
                "fragment": fragment.name,
                "depth": out.depth || targets.is_empty(),
                "targets": targets,
            }));
        }
        // Depth alone.
        if !any {
            all.push(json!({ "vertex": vertex.name, "attributes": attributes, "depth": true }));
        }
    }
    all
}

/// Scalar and how many of them.
fn numbers(module: &Module, ty: Handle<Type>) -> (Option<Scalar>, usize) {
    match module.types[ty].inner {
        TypeInner::Scalar(scalar) => (Some(scalar), 1),
        TypeInner::Vector { size, scalar } => (Some(scalar), size as usize),
        _ => (None, 0),
    }
}

/// Format of a vertex attribute.
fn attribute(module: &Module, ty: Handle<Type>) -> String {
    let (scalar, count) = numbers(module, ty);
    let kind = match scalar.map(|s| s.kind) {
        Some(ScalarKind::Uint) => "uint32",
        Some(ScalarKind::Sint) => "sint32",
        _ => "float32",
    };
    if count > 1 { format!("{kind}x{count}") } else { kind.into() }
}

/// Format of a colour that takes such values.
fn colour(module: &Module, ty: Handle<Type>) -> String {
    let (scalar, count) = numbers(module, ty);
    let channels = ["r", "r", "rg", "rgba", "rgba"][count.min(4)];
    let kind = match scalar.map(|s| s.kind) {
        Some(ScalarKind::Uint) => "uint",
        Some(ScalarKind::Sint) => "sint",
        _ => "float",
    };
    // Four of them in one pass are what every device has room for.
    format!("{channels}{}{kind}", if count > 2 { 16 } else { 32 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::parse;

    #[test]
    fn entry_points_that_fit_together_are_paired() {
        let module = parse(
            "struct Out { @builtin(position) place: vec4f, @location(1) @interpolate(flat) number: u32 }
            @vertex fn plain(@location(3) at: vec3f) -> @builtin(position) vec4f { return vec4f(at, 1.0); }
            @vertex fn numbers(@location(0) n: u32) -> Out { return Out(vec4f(0.0), n); }
            struct Drawn { @builtin(frag_depth) depth: f32, @location(0) colour: vec4f, @location(1) n: u32 }
            @fragment fn draws(@location(1) @interpolate(flat) number: u32) -> Drawn { return Drawn(0.5, vec4f(1.0), number); }
            @compute @workgroup_size(1) fn adds() {}",
        )
        .unwrap();
        let depth_alone = json!({ "vertex": "plain", "attributes": [[3, "float32x3"]], "depth": true });
        let pair = |targets: &[&str]| {
            json!({
                "vertex": "numbers",
                "attributes": [[0, "uint32"]],
                "fragment": "draws",
                "depth": true,
                "targets": targets,
            })
        };
        let compute = json!({ "compute": "adds" });
        let by_type = [compute.clone(), depth_alone.clone(), pair(&["rgba16float", "r32uint"])];
        assert_eq!(of(&module, &[]), by_type);
        let formats = ["rgba32float", "r8uint"].map(String::from);
        assert_eq!(of(&module, &formats), [compute, depth_alone, pair(&["rgba32float", "r8uint"])]);
    }

    #[test]
    fn constants_without_a_value_are_given_one() {
        let module = parse("override open: f32; override closed: f32 = 2.0;").unwrap();
        assert_eq!(constants(&module), json!({ "open": 0.5 }));
    }
}
