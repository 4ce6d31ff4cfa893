//! Settings of techniques that between them take every way through the library's WGSL, found in the list
//! of techniques and their parameter tables, so that new ones are among them.

use antumbra::{
    Capabilities, Field, Parameter, Technique,
    technique::{self, CasterStorage, set},
};
use std::collections::BTreeSet;

/// A technique, and what was set, in this order.
type Set = (Box<dyn Technique>, Vec<String>);

/// Each technique in its defaults and in the [variants](Technique::variants) that it says are worth testing.
#[must_use]
pub fn variants() -> Vec<String> {
    let of = |technique: Box<dyn Technique>| {
        let name = technique.about().name;
        let variants = technique.variants().into_iter().map(move |settings| format!("{name}.{settings}"));
        [name.to_string()].into_iter().chain(variants)
    };
    technique::all().into_iter().flat_map(of).collect()
}

/// Names of the techniques that keep triangles.
#[must_use]
pub fn keeping_triangles() -> Vec<&'static str> {
    names(|storage| storage != CasterStorage::Depth)
}

/// Names of the techniques that keep triangles by id.
#[must_use]
pub fn keeping_ids() -> Vec<&'static str> {
    names(CasterStorage::keeps_ids)
}

fn names(good: impl Fn(CasterStorage) -> bool) -> Vec<&'static str> {
    let device = Capabilities::full();
    let described = technique::all().into_iter().filter_map(|technique| technique.describe(&device).ok());
    described.filter(|described| good(described.storage)).map(|described| described.about.name).collect()
}

/// Each technique in its defaults and with each of its settings changed by itself, as
/// [`technique::parse`] reads them. Numbers are tried at both ends of their range and next to the lower
/// one, all values where there are few.
#[must_use]
pub fn single() -> Vec<String> {
    specs(|technique| singles(&(technique.clone_box(), Vec::new())))
}

/// Beside those of [`single`] each choice with every other choice, and each number with each other
/// setting. What a technique refuses together is left out.
#[must_use]
pub fn many() -> Vec<String> {
    specs(|technique| {
        let alone = (technique.clone_box(), Vec::new());
        let mut sets = singles(&alone);
        // A setting may widen the range of those that come before it, too.
        sets.extend(sets.clone().iter().flat_map(singles));
        sets.extend(products(alone));
        sets
    })
}

fn specs(sets: impl Fn(&dyn Technique) -> Vec<Set>) -> Vec<String> {
    let mut known = BTreeSet::new();
    let mut specs = Vec::new();
    for technique in technique::all() {
        let name = technique.about().name;
        let plain = (technique.clone_box(), Vec::new());
        for (technique, settings) in [plain].into_iter().chain(sets(technique.as_ref())) {
            if known.insert(technique::spec(technique.as_ref())) {
                let dot = if settings.is_empty() { "" } else { "." };
                specs.push(format!("{name}{dot}{}", settings.join(",")));
            }
        }
    }
    specs
}

/// A set with each of its settings changed.
fn singles((technique, settings): &Set) -> Vec<Set> {
    let mut sets = Vec::new();
    for (name, values) in technique.clone_box().parameters().iter().map(|p| (p.name, values(p))) {
        for value in values {
            let mut technique = technique.clone_box();
            if set(technique.as_mut(), name, &value).is_ok() {
                let mut settings = settings.clone();
                settings.push(format!("{name}={value}"));
                sets.push((technique, settings));
            }
        }
    }
    sets
}

/// Every combination of choices.
fn products(alone: Set) -> Vec<Set> {
    let is_choice = |p: &Parameter<'_>| matches!(p.field, Field::Choice(_));
    let mut plain = alone.0.clone_box();
    let choices: Vec<_> =
        plain.parameters().iter().filter(|p| is_choice(p)).map(|p| (p.name, values(p))).collect();
    choices.into_iter().fold(vec![alone], |sets, (name, values)| {
        let with = |(technique, settings): &Set, value: &String| {
            let (mut technique, mut settings) = (technique.clone_box(), settings.clone());
            set(technique.as_mut(), name, value).ok()?;
            settings.push(format!("{name}={value}"));
            Some((technique, settings))
        };
        sets.iter().flat_map(|set| values.iter().filter_map(move |value| with(set, value))).collect()
    })
}

/// Values to try.
fn values(parameter: &Parameter<'_>) -> Vec<String> {
    const FEW: u32 = 8;
    let whole = |low: u32, high: u32, step: u32| -> Vec<u32> {
        if high - low < FEW * step {
            (low..=high).step_by(step as usize).collect()
        } else {
            vec![low, low + step, high]
        }
    };
    let text = |values: Vec<u32>| values.iter().map(u32::to_string).collect();
    match &parameter.field {
        Field::Number(_, range) => vec![range.start().to_string(), range.end().to_string()],
        Field::Count(_, range) => text(whole(*range.start(), *range.end(), 1)),
        Field::Odd(_, range) => text(whole(*range.start(), *range.end(), 2)),
        Field::Choice(choice) => choice.names().iter().map(|name| (*name).to_string()).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_tells_techniques_apart() {
        let ([triangles, ids], all) = ([keeping_triangles(), keeping_ids()], technique::all().len());
        assert!(
            ids.len() < triangles.len() && triangles.len() < all && !ids.is_empty(),
            "{ids:?} of {triangles:?}"
        );
        assert!(ids.iter().all(|name| triangles.contains(name)) && !triangles.contains(&"hard"));
    }

    #[test]
    fn every_value_of_every_choice_is_among_them() {
        let [few, all] = [single(), many()];
        assert!(all.len() > 4 * few.len(), "{} of {}", few.len(), all.len());
        for spec in few.iter().chain(&all) {
            technique::parse(spec).unwrap();
        }
        for mut technique in technique::all() {
            let name = technique.about().name;
            for p in technique.parameters() {
                let Field::Choice(choice) = &p.field else { continue };
                for value in choice.names().iter().filter(|value| **value != p.value()) {
                    assert!(few.contains(&format!("{name}.{}={value}", p.name)), "{name}.{}={value}", p.name);
                }
            }
        }
        // A wide table is one that only summing allows.
        assert!(all.iter().any(|spec| spec.starts_with("esm.sampling=summed,kernel=255")), "{all:?}");
    }
}
