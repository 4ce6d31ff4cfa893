use super::*;
use crate::capabilities::Capabilities;

#[test]
fn comparisons_alone_are_biased_by_rounding() {
    for technique in all() {
        let terms = technique.describe(&Capabilities::full()).unwrap().bias;
        let compares = technique.about().family == Family::Comparison;
        assert_eq!(terms.depth_steps > 0.0 && terms.receiver_plane >= 1.0, compares, "{technique:?}");
    }
}

#[test]
fn variants_are_settings_that_change_something() {
    for technique in all() {
        let name = technique.about().name;
        let mut known = vec![name.to_string()];
        for settings in technique.variants() {
            let variant = spec(parse(&format!("{name}.{settings}")).unwrap().as_ref());
            assert!(!known.contains(&variant), "{name}.{settings} is among the others");
            known.push(variant);
        }
    }
}

#[test]
fn descriptions_are_of_their_technique() {
    for technique in all() {
        let described = technique.describe(&Capabilities::full()).unwrap();
        assert_eq!(described.about, technique.about());
        described.check().unwrap();
    }
}
