use super::{split::Split, *};
use crate::technique::{self, all, parse};
use antumbra_testing::{settings, shaders::parse as validate};
use naga::AddressSpace;

const SIZE: MapSize = MapSize {
    views: 3,
    capacity: Capacity { triangles: 1000, triangles_per_texel: 4 },
    splits: WHOLE,
    asks: false,
};
const ONE: Split = Split { elements: 3000, each: 3000 };
const WHOLE: Splits = Splits { keys: ONE, corners: ONE, counts: ONE };
/// Arrays that are larger than bindings.
const PARTS: Splits = Splits {
    keys: Split { elements: 3000, each: 1024 },
    corners: ONE,
    counts: Split { elements: 3000, each: 2048 },
};

/// Everything and nothing of what devices may lack.
fn devices() -> [Capabilities; 2] {
    let lesser = Capabilities { features: wgpu::Features::empty(), limits: wgpu::Limits::default() };
    let full = Capabilities { features: Capabilities::OPTIONAL_FEATURES, ..lesser.clone() };
    [full, lesser]
}

/// The techniques with each setting changed by itself.
fn variants() -> Vec<Box<dyn Technique>> {
    settings::single().iter().map(|spec| parse(spec).unwrap()).collect()
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
fn files() -> Vec<(String, &'static str)> {
    let shared = FILES.iter().map(|(stem, text)| ((*stem).to_string(), *text));
    let own = all().into_iter().map(|t| (t.page().name.to_string(), t.wgsl()));
    shared.chain(own).collect()
}

#[test]
fn library_files_keep_the_rules() {
    for (stem, text) in files() {
        check_file(&stem, text).unwrap();
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
            ["blur_fixed", "level_hardware", "words_1", "reference_exact", "points_map"],
            ["blur_adaptive", "level_manual", "words_2", "reference_stepped", "points_texel"],
            ["blur_fixed", "level_logarithmic", "words_4", "reference_exact", "points_map"],
        ] {
            let mut text = ShaderText::file(stem, &parts).text();
            if text.contains("shadow_blur(") {
                text += NO_BLUR;
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
            let mut text = ShaderText::library(technique.as_ref(), &device).text();
            // Buffers are read through functions that come with them.
            for binding in technique.bindings() {
                let Binding::Ranked(ranked) = binding else { continue };
                for line in accessors(ranked, "nothing", SIZE).lines() {
                    let (head, _) = line.split_once(" {").unwrap();
                    let (_, result) = head.split_once("-> ").unwrap();
                    text += &format!("{head} {{ return {result}(); }}\n");
                }
            }
            let spec = technique::spec(technique.as_ref());
            let module = validate(&text).unwrap_or_else(|e| panic!("{spec}: {e}"));
            assert!(module.global_variables.is_empty(), "{spec} binds something");
        }
    }
}

/// Each buffer of a split array has a binding of its own.
#[test]
fn split_arrays_validate() {
    for device in devices() {
        let dpm = parse("dpm").unwrap();
        let module =
            validate(&receiver(dpm.as_ref(), &device, MapSize { splits: PARTS, ..SIZE }, 2).text()).unwrap();
        let mut bound: Vec<u32> =
            module.global_variables.iter().filter_map(|(_, v)| Some(v.binding.as_ref()?.binding)).collect();
        bound.sort_unstable();
        assert_eq!(bound, [0, 1, 2, 3, 4, 5]);
        for splits in [WHOLE, PARTS] {
            validate(&scan(&splits)).unwrap();
        }
    }
}

#[test]
fn every_receiver_binds_what_the_technique_names() {
    for device in devices() {
        for technique in variants() {
            let spec = technique::spec(technique.as_ref());
            let module = validate(&receiver(technique.as_ref(), &device, SIZE, 2).text())
                .unwrap_or_else(|e| panic!("{spec}: {e}"));
            let covers = "fn shadow_covers(tag: u32, triangle: u32, weights: vec3f) -> bool { return tag > triangle; }\n";
            let asking = receiver(
                technique.as_ref(),
                &device,
                MapSize { asks: technique.caster().keeps_ids(), ..SIZE },
                2,
            )
            .text();
            validate(&format!("{covers}{asking}")).unwrap_or_else(|e| panic!("{spec}: {e}"));
            let bound: Vec<_> = module.global_variables.iter().filter_map(|(_, v)| v.binding).collect();
            assert_eq!(bound.len(), 1 + technique.bindings().len(), "{spec}");
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
fn every_constant_replaces_exactly_one_declaration() {
    for device in devices() {
        for technique in variants() {
            let text = ShaderText::library(technique.as_ref(), &device).text();
            for constant in technique.constants() {
                let (name, value) = match &constant {
                    Constant::Count(name, n) => (*name, format!("= {n}u;")),
                    Constant::Number(name, x) => (*name, format!("= {x:?};")),
                    Constant::Array(name, values) => (*name, format!("array<f32, {}>", values.len())),
                };
                assert_eq!(declarations(&text, name), 1, "{name}");
                let line = text.lines().find(|l| l.starts_with(&format!("const {name}"))).unwrap();
                assert!(line.contains(&value), "{line}");
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
        let mut shader = receiver(&technique::csm::Csm::default(), &device, SIZE, 0);
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
