use super::*;
use crate::{capabilities::Capabilities, error::DescriptionError};

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

/// What no caster can draw is the description's fault, not the device's.
#[test]
fn triangles_are_drawn_once_and_the_nearest_to_one_map() {
    for technique in all() {
        let described = technique.describe(&Capabilities::full()).unwrap();
        if described.storage == CasterStorage::Depth {
            continue;
        }
        let mut twice = described.clone();
        twice.sample_offsets = vec![glam::Vec2::ZERO; 2];
        assert_eq!(twice.check(), Err(DescriptionError::Passes { passes: 2 }), "{technique:?}");
        let CasterStorage::NearestTriangle(coverages) = described.storage else { continue };
        let mut thicker = described;
        thicker.maps[0].layers += 1;
        let layers = coverages.len();
        assert_eq!(thicker.check(), Err(DescriptionError::Nearest { layers }), "{technique:?}");
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
