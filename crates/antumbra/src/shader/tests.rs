use super::{files::FILES, *};
use crate::{
    Options, Size,
    capabilities::Capabilities,
    capacity::Capacity,
    cast,
    describe::{Binding, Description, Technique},
    error::{DescriptionError, Unsupported},
    technique::{self, parse},
};
use antumbra_testing::{settings, shaders::parse as validate};
use naga::AddressSpace;

fn options() -> Options {
    Options::from(Size::square(32)).views(3).capacity(Capacity { triangles: 1000, triangles_per_texel: 4 })
}

/// What receivers call, and whatever that binds in group 2.
fn receiver(composition: &Composition, device: &Capabilities) -> ShaderText {
    let options = options();
    composition
        .receiver(|group, first| cast::plan(composition, device, &options).lookups(group, first), (2, 0))
}

/// Everything and nothing of what devices may lack.
fn devices() -> [Capabilities; 2] {
    [Capabilities::full(), Capabilities::least()]
}

/// The techniques with each setting changed by itself, and what else they say is worth testing.
fn variants() -> Vec<Box<dyn Technique>> {
    settings::single().iter().chain(&settings::variants()).map(|spec| parse(spec).unwrap()).collect()
}

/// What is composed of a technique.
fn composed(technique: &dyn Technique, device: &Capabilities, asks: bool) -> Composition {
    let description = technique.describe(device).unwrap();
    Composition::new(description, &options().cutouts(asks)).unwrap()
}

/// What a library file may look like: names, kinds of declaration, docs, sampling.
fn check_file(stem: &str, text: &str) -> Result<(), String> {
    let first = stem.split('_').next().unwrap_or(stem);
    let prefix = format!("{first}_");
    let upper = first[..1].to_uppercase() + &first[1..];
    let mut documented = false;
    for (i, line) in text.lines().enumerate() {
        let at = |what: &str| format!("{stem}:{}: {what}: {line}", i + 1);
        let code = line.split("//").next().unwrap_or_default();
        for banned in ["@group", "@binding", "var<", "@fragment", "@vertex", "@compute"] {
            if code.contains(banned) {
                return Err(at(banned));
            }
        }
        let words = code.split(|c: char| !c.is_alphanumeric() && c != '_');
        for word in words {
            let implicit = ["textureSample", "textureSampleBias", "textureSampleCompare"].contains(&word);
            if implicit || ["dpdx", "dpdy", "fwidth"].iter().any(|d| word.starts_with(d)) {
                return Err(at("implicit derivative"));
            }
        }
        if line.starts_with("///") {
            documented = true;
            continue;
        }
        let mut tokens = code.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty());
        let top = !code.is_empty() && !code.starts_with([' ', '}', ')', '\t']);
        if top {
            let (kind, name) = (tokens.next().unwrap_or_default(), tokens.next().unwrap_or_default());
            match kind {
                "alias" | "struct" if !name.starts_with(&upper) => {
                    return Err(at(&format!("must begin with {upper}")));
                }
                "fn" | "const" | "override" if !name.starts_with(&prefix) => {
                    return Err(at(&format!("must begin with {prefix}")));
                }
                "fn" | "const" | "override" | "struct" | "alias" if !documented => {
                    return Err(at("no /// before it"));
                }
                "fn" | "const" | "override" | "struct" | "alias" => {}
                _ => return Err(at("neither fn nor const nor override nor struct nor alias")),
            }
        }
        documented = false;
    }
    Ok(())
}

/// All library files: shared ones by stem, techniques by name.
fn files() -> Vec<(String, String)> {
    let shared = FILES.iter().map(|(stem, text)| ((*stem).to_string(), (*text).to_string()));
    let own = variants().into_iter().map(|technique| {
        let Description { about, wgsl, .. } = technique.describe(&Capabilities::full()).unwrap();
        (about.name.to_string(), wgsl.into_owned())
    });
    shared.chain(own).collect()
}

#[test]
fn library_files_keep_the_rules() {
    for (stem, text) in files() {
        check_file(&stem, &text).unwrap();
    }
}

#[test]
fn files_that_break_a_rule_are_found() {
    let good = "/// Doc.\nfn x_one(a: f32) -> f32 {\n    return a;\n}\n";
    check_file("x", good).unwrap();
    for (bad, why) in [
        ("/// Doc.\n@group(0) @binding(0) var x_map: texture_2d<f32>;\n", "@group"),
        ("/// Doc.\nvar<private> x_state: f32;\n", "var<"),
        ("/// Doc.\nfn y_one(a: f32) -> f32 {\n    return a;\n}\n", "must begin with x_"),
        ("/// Doc.\nstruct Y { a: f32 }\n", "must begin with X"),
        ("fn x_one(a: f32) -> f32 {\n    return a;\n}\n", "no ///"),
        ("/// Doc.\nalias x_a = f32;\n", "must begin with X"),
        ("/// Doc.\ndiagnostic(off, x_y);\n", "neither"),
        ("/// Doc.\nfn x_one(a: f32) -> f32 {\n    return dpdx(a);\n}\n", "derivative"),
        (
            "/// Doc.\nfn x_one(t: texture_2d<f32>, s: sampler) -> vec4f {\n    return textureSample(t, s, vec2f(0.0));\n}\n",
            "derivative",
        ),
    ] {
        let found = check_file("x", bad).unwrap_err();
        assert!(found.contains(why), "{found}");
        assert!(found.starts_with("x:"), "{found}");
    }
}

#[test]
fn every_shared_file_validates_with_its_needs_and_nothing_else() {
    for (stem, _) in FILES {
        for parts in [
            ["blur_fixed", "level_hardware", "words_1", "reference_exact", "points_map", "tile_whole"],
            ["blur_adaptive", "level_manual", "words_2", "reference_stepped", "points_texel", "tile_placed"],
            ["blur_fixed", "level_logarithmic", "words_4", "reference_exact", "points_map", "tile_whole"],
        ] {
            let mut text = ShaderText::of(stem, &parts).unwrap().text();
            for function in [
                "shadow_blur(view: u32) -> f32",
                "shadow_size() -> vec2f",
                "shadow_place(view: u32) -> vec4f",
                "shadow_layer(view: u32) -> u32",
            ] {
                let (name, result) = (function.split('(').next(), function.split("-> ").nth(1));
                if name.is_some_and(|name| text.contains(&format!("{name}("))) {
                    text += &format!("fn {function} {{ return {}(); }}\n", result.unwrap_or_default());
                }
            }
            if text.contains("uphill_lean(") {
                text += "fn uphill_lean(view: u32) -> vec2f { return vec2f(0.0); }\n";
            }
            let module = validate(&text).unwrap_or_else(|e| panic!("{stem}: {e}"));
            assert!(module.global_variables.is_empty(), "{stem} binds something");
        }
    }
}

#[test]
fn every_technique_validates_with_its_needs() {
    for device in devices() {
        for technique in variants() {
            let composition = composed(technique.as_ref(), &device, false);
            let mut text = composition.alone().text();
            // What casters leave is read through functions that come with it.
            let options = options();
            for line in cast::plan(&composition, &device, &options).lookups(2, 1).lines() {
                let Some((head, result)) = line.split_once(" {").and_then(|(head, _)| head.split_once("-> "))
                else {
                    continue;
                };
                text += &format!("{head}-> {result} {{ return {result}(); }}\n");
            }
            let spec = technique::spec(technique.as_ref());
            let module = validate(&text).unwrap_or_else(|e| panic!("{spec}: {e}"));
            assert!(module.global_variables.is_empty(), "{spec} binds something");
        }
    }
}

/// Each buffer of an array that is larger than a binding has a binding of its own.
#[test]
fn split_arrays_validate() {
    for mut device in devices() {
        device.limits.max_storage_buffer_binding_size = 4096;
        for name in settings::keeping_ids() {
            let composition = composed(parse(name).unwrap().as_ref(), &device, false);
            let module = validate(&receiver(&composition, &device).text()).unwrap();
            let bound = module.global_variables.iter().filter_map(|(_, v)| Some(v.binding.as_ref()?.binding));
            let mut bound: Vec<u32> = bound.collect();
            bound.sort_unstable();
            assert!(bound.len() > 10 && bound.iter().zip(0..).all(|(a, b)| *a == b), "{bound:?}");
            let options = options();
            for shader in cast::plan(&composition, &device, &options).shaders() {
                validate(&shader.text).unwrap_or_else(|e| panic!("{name}, {}: {e}", shader.pass));
            }
        }
    }
}

#[test]
fn every_receiver_binds_what_the_technique_names() {
    for device in devices() {
        for technique in variants() {
            let spec = technique::spec(technique.as_ref());
            let composition = composed(technique.as_ref(), &device, false);
            let module =
                validate(&receiver(&composition, &device).text()).unwrap_or_else(|e| panic!("{spec}: {e}"));
            let covers = "fn shadow_covers(tag: u32, triangle: u32, weights: vec3f) -> bool { return tag > triangle; }\n";
            let asking = receiver(&composed(technique.as_ref(), &device, true), &device).text();
            validate(&format!("{covers}{asking}")).unwrap_or_else(|e| panic!("{spec}: {e}"));
            let bound: Vec<_> = module.global_variables.iter().filter_map(|(_, v)| v.binding).collect();
            let options = options();
            let kept = cast::plan(&composition, &device, &options).lookups(2, 1).matches("@binding").count();
            assert_eq!(bound.len(), 1 + composition.description.bindings.len() + kept, "{spec}");
            assert!(bound.iter().all(|b| b.group == 2), "{spec}: {bound:?}");
            let uniforms =
                module.global_variables.iter().filter(|(_, v)| v.space == AddressSpace::Uniform).count();
            assert_eq!(uniforms, 1, "{spec}");
        }
    }
}

/// Lines of a library that declare `name`.
fn declarations(text: &str, name: &str) -> usize {
    let starts = [format!("const {name} "), format!("const {name}:")];
    text.lines().filter(|line| starts.iter().any(|s| line.starts_with(s))).count()
}

#[test]
fn every_constant_replaces_its_declaration() {
    for device in devices() {
        for technique in variants() {
            let composition = composed(technique.as_ref(), &device, false);
            let text = composition.alone().text();
            for constant in &composition.description.constants {
                let declared = constant.declaration();
                assert_eq!(text.lines().filter(|line| *line == declared).count(), 1, "{declared}");
                assert_eq!(declarations(&text, constant.name()), 1, "{declared}");
            }
        }
    }
    assert_eq!(declarations("const x: u32 = 1u;\nconst x_y: u32 = 1u;\n", "x"), 1);
    assert_eq!(declarations("    const x: u32 = 1u;\n", "x"), 0, "indented ones are out of reach");
}

#[test]
fn an_error_is_found_at_its_file_and_line() {
    let [device, _] = devices();
    for user in ["", "fn mine() {}", "fn mine() {}\n", "enable f16;\n\nfn mine() {}\n\n"] {
        let csm = technique::csm::Csm::default();
        let mut shader = receiver(&composed(&csm, &device, false), &device);
        for piece in 0..shader.pieces.len() {
            let good = shader.pieces[piece].1.clone();
            let wrong = "fn wrong() -> u32 { return nonsense; }\n";
            shader.pieces[piece].1.push_str(wrong);
            let user_without_enable = user.replace("enable f16;", "");
            let text = format!("{user_without_enable}\n{}", shader.text());
            let error = naga::front::wgsl::parse_str(&text).unwrap_err();
            let line = error.location(&text).unwrap().line_number as usize;
            let expected = (shader.pieces[piece].0.as_str(), good.matches('\n').count() + 1);
            assert_eq!(shader.locate(&user_without_enable, line), Some(expected));
            // Negative control: one line further is another place.
            assert_ne!(shader.locate(&user_without_enable, line + 1), Some(expected));
            shader.pieces[piece].1 = good;
        }
        for line in 1..=user.split('\n').count() {
            assert_eq!(shader.locate(user, line), None, "the caller's own line {line}");
        }
        assert_eq!(shader.locate(user, 100_000), None);
    }
}

/// Why a description of hard that was edited cannot be composed.
fn refusal(edit: impl Fn(&mut Description)) -> DescriptionError {
    let mut described = technique::hard::Hard::default().describe(&Capabilities::full()).unwrap();
    edit(&mut described);
    match Composition::new(described, &options()) {
        Err(Unsupported::Description { technique, error }) if technique == "hard" => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_cannot_be_composed_is_named() {
    use DescriptionError as E;
    let said = |error: &E, words: &[&str]| {
        let message = error.to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    let file = refusal(|d| d.wgsl = "//! needs nothing_there\n".into());
    said(&file, &["'nothing_there'", "lookup_fitted"]);
    let wrong = refusal(|d| d.slots = vec!["reference_wrong"]);
    said(&wrong, &["'reference_wrong'", "reference_exact"]);
    let slot = refusal(|d| d.slots.clear());
    said(&slot, &["'reference'", "reference_exact, reference_stepped"]);
    assert!(matches!(slot, E::Slot { .. }), "{slot}");
    let twice = "//! needs reference\nconst hard_a: u32 = 1;\nconst hard_a: u32 = 1;\n";
    for (wgsl, found) in [(twice, 2), ("//! needs reference\n", 0)] {
        let constant = refusal(|d| {
            d.wgsl = wgsl.into();
            d.constants.push(crate::describe::Constant::Count("hard_a", 2));
        });
        assert_eq!(constant, E::Constant { name: "hard_a".into(), found });
    }
    let endless = "for (var i = 0u; i < many; i += 1u) { // unrolled";
    said(&refusal(|d| d.wgsl = format!("{endless}\n}}\n").into()), &[endless]);
}

#[test]
fn what_contradicts_itself_is_named() {
    use DescriptionError as E;
    assert_eq!(refusal(|d| d.sample_offsets.clear()), E::SampleOffsets);
    let passes = |d: &mut Description| d.sample_offsets = vec![glam::Vec2::ZERO; 5];
    assert_eq!(refusal(passes), E::Layers { passes: 5, layers: 0 });
    assert_eq!(refusal(|d| d.bindings.push(Binding::Map(2))), E::Map { index: 2, maps: 0 });
}

/// Number of parameters of each function of a text.
fn parameters(text: &str) -> Vec<(String, usize)> {
    let functions = text.split("fn ").skip(1).filter_map(|rest| rest.split_once('('));
    let counted = functions.map(|(name, rest)| {
        let (mut depth, mut count) = (1, 1);
        for c in rest.chars() {
            match c {
                '(' | '<' => depth += 1,
                ')' | '>' => depth -= 1,
                ',' if depth == 1 => count += 1,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        (name.to_string(), count)
    });
    counted.collect()
}

/// More would be confused with one another.
#[test]
fn no_function_has_more_than_nine_parameters() {
    const MAX: usize = 9;
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![root];
    let mut functions = 0;
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.to_string_lossy().ends_with(".wgsl")
                || path.to_string_lossy().ends_with(".wgsl.in")
            {
                for (name, count) in parameters(&std::fs::read_to_string(&path).unwrap()) {
                    assert!(count <= MAX, "{}: {name} has {count} parameters", path.display());
                    functions += 1;
                }
            }
        }
    }
    assert!(functions > 150, "{functions}");
    assert_eq!(parameters("fn f(a: array<f32, 4>, b: vec2f) -> f32 {}"), [("f".to_string(), 2)]);
}

/// Users may name their own things as files do, and put several maps into one module.
#[test]
fn names_of_users_and_of_other_maps_are_free() {
    for technique in technique::all() {
        let description = technique.describe(&Capabilities::full()).unwrap();
        let name = description.about.name;
        let text = receiver(&Composition::new(description, &options()).unwrap(), &Capabilities::full());
        let raw = ShaderText { prefix: None, ..text.clone() }.text();
        let own = names::globals(&raw).filter(|name| !name.to_lowercase().starts_with(names::PREFIX));
        let user: String = own.map(|name| format!("const {name} = 1;\n")).collect();
        // The same map twice, bound in other groups.
        let lamp = text.named("lamp").unwrap().text().replace("@group(2)", "@group(1)");
        validate(&format!("{user}{}{lamp}", text.text())).unwrap_or_else(|e| panic!("{name}: {e}"));
        // Negative controls: names as files have them, the same word twice.
        validate(&format!("{user}{raw}")).unwrap_err();
        validate(&(text.text() + &text.text())).unwrap_err();
    }
}
