use super::*;
use glam::Vec4;

const BOX: Bounds = Bounds { min: Vec3::new(-10.0, 0.0, -10.0), max: Vec3::new(10.0, 5.0, 10.0) };

fn fit(receivers: Vec<Vec3>) -> Fit {
    Fit { casters: BOX, receivers, size: Size::square(512), margin_texels: 4.0, lean: true }
}

fn project(view: &View, p: Vec3) -> Vec3 {
    view.clip_from_world.project_point3(p)
}

fn sun(x: f32, y: f32, z: f32) -> Light {
    Light::Directional { direction: Vec3::new(x, y, z) }
}

#[test]
fn everything_that_receives_is_inside_with_its_margin() {
    for light in [sun(0.3, -1.0, 0.2), sun(0.0, -1.0, 0.0), sun(1.0, 0.0, 0.0), sun(-0.9, -0.1, 0.4)] {
        let view = light.view(&fit(BOX.corners().collect())).unwrap();
        let limit = 1.0 - 2.0 * 4.0 / 512.0;
        for p in BOX.corners() {
            let c = project(&view, p);
            assert!(c.x.abs() <= limit + 1e-4 && c.y.abs() <= limit + 1e-4, "{light:?}: {c}");
            assert!((0.0..=1.0).contains(&c.z));
            assert!((view.depth_plane.dot(p.extend(1.0)) - c.z).abs() < 1e-5);
        }
    }
}

#[test]
fn depth_grows_the_way_the_light_travels() {
    let view = sun(0.0, -1.0, 0.1).view(&fit(BOX.corners().collect())).unwrap();
    assert!(project(&view, Vec3::ZERO).z > project(&view, Vec3::new(0.0, 4.0, 0.0)).z);
    assert!(view.to_light.y > 0.9);
}

#[test]
fn a_moving_camera_moves_the_map_by_whole_texels() {
    let light = sun(0.4, -1.0, 0.3);
    let hull = |x: f32| -> Vec<Vec3> {
        Bounds { min: Vec3::new(x, 0.0, 0.0), max: Vec3::new(x + 3.0, 1.0, 3.0) }.corners().collect()
    };
    let texel = |view: &View| (project(view, Vec3::new(1.0, 0.5, 1.0)).truncate() * 0.5 + 0.5) * 512.0;
    let start = light.view(&fit(hull(0.0))).unwrap();
    for step in 1..50 {
        let moved = light.view(&fit(hull(step as f32 * 0.0137))).unwrap();
        assert_eq!(moved.texel_world, start.texel_world);
        let shift = texel(&moved) - texel(&start);
        assert!((shift - shift.round()).length() < 2e-3, "step {step}: {shift}");
    }
    // Negative control: without snapping the shift is not whole.
    let view = light.view(&fit(hull(0.3))).unwrap();
    let unsnapped = view.clip_from_world.transform_vector3(Vec3::new(0.0137, 0.0, 0.0)) * 256.0;
    assert!((unsnapped - unsnapped.round()).truncate().length() > 2e-3);
}

#[test]
fn texels_are_as_small_as_the_visible_part_allows() {
    let light = sun(0.0, -1.0, 0.0);
    let all = light.view(&fit(BOX.corners().collect())).unwrap();
    let part = Bounds { min: Vec3::ZERO, max: Vec3::splat(2.0) };
    let some = light.view(&fit(part.corners().collect())).unwrap();
    assert!((20.0 / 503.0..=20.0 / 503.0 * 1.05).contains(&all.texel_world), "{}", all.texel_world);
    assert!((2.0 / 503.0..=2.0 / 503.0 * 1.05).contains(&some.texel_world));
}

#[test]
fn casters_beyond_the_near_plane_stay_apart_from_receivers() {
    let light = sun(0.0, -1.0, 0.0);
    let floor = Bounds { min: Vec3::new(-9.0, 0.0, -9.0), max: Vec3::new(9.0, 1.0, 9.0) };
    let fine = Fit { size: Size::square(4096), ..fit(floor.corners().collect()) };
    let view = light.view(&fine).unwrap();
    let depth = |y: f32| project(&view, Vec3::new(0.0, y, 0.0)).z;
    assert!(depth(5.0) < 0.0, "the roof is clamped");
    assert!((0.09..0.1).contains(&depth(1.0)), "{}", depth(1.0));
    // A tenth of the range is fewer texels of a coarse map than biases may take.
    let coarse = light.view(&fit(floor.corners().collect())).unwrap();
    let apart = project(&coarse, Vec3::Y).z * coarse.depth_world / coarse.texel_world;
    assert!((10.0..10.1).contains(&apart), "{apart}");
    // Without such casters the range is the receivers' own.
    let low = Fit { casters: floor, ..fit(floor.corners().collect()) };
    let view = light.view(&low).unwrap();
    assert!(project(&view, Vec3::Y).z < 2e-3);
}

#[test]
fn a_spot_sees_its_cone_and_linear_depth_is_linear() {
    let spot = Light::Spot { position: Vec3::new(0.0, 10.0, 0.0), direction: -Vec3::Y, outer_angle: 0.5 };
    let view = spot.view(&fit(BOX.corners().collect())).unwrap();
    let edge = project(&view, Vec3::new(10.0 * 0.5f32.tan(), 0.0, 0.0));
    assert!((edge.truncate().abs().max_element() - (1.0 - 8.0 / 512.0)).abs() < 1e-3, "{edge}");
    let depth = |y: f32| view.depth_plane.dot(Vec4::new(1.0, y, 0.3, 1.0));
    assert!((depth(2.0) - 0.5 * (depth(1.0) + depth(3.0))).abs() < 1e-6);
    // raster_linear in shader/raster.wgsl, in Rust.
    let (z, r) = (project(&view, Vec3::new(1.0, 2.0, 0.3)).z, view.near_over_far());
    assert!((r * z / (1.0 - (1.0 - r) * z) - depth(2.0)).abs() < 1e-5);
    // A texel one unit from the apex.
    let world = 2.0 * 0.5f32.tan() / 504.0;
    assert!((view.texel_world - world).abs() < 1e-6);
}

#[test]
fn a_light_parallel_to_flat_ground_has_a_view() {
    let flat = Bounds { min: Vec3::new(-1.0, 0.0, -1.0), max: Vec3::new(1.0, 0.0, 1.0) };
    let fit = Fit { casters: flat, receivers: flat.corners().collect(), ..fit(vec![]) };
    for light in [sun(1.0, 0.0, 0.0), sun(0.0, -1.0, 0.0), sun(0.0, 0.0, 1.0)] {
        let view = light.view(&fit).unwrap();
        assert!(view.clip_from_world.is_finite() && view.texel_world > 0.0);
        assert!(project(&view, Vec3::ZERO).is_finite());
    }
}

#[test]
fn unusable_input_is_refused_by_name() {
    let good = fit(BOX.corners().collect());
    assert!(matches!(sun(0.0, 0.0, 0.0).view(&good), Err(LightError::Direction { .. })));
    assert!(matches!(sun(f32::NAN, 0.0, 0.0).view(&good), Err(LightError::Direction { .. })));
    let spot =
        |angle, y| Light::Spot { position: Vec3::new(0.0, y, 0.0), direction: -Vec3::Y, outer_angle: angle };
    assert!(matches!(spot(1.6, 1.0).view(&good), Err(LightError::Angle { .. })));
    assert!(matches!(spot(0.0, 1.0).view(&good), Err(LightError::Angle { .. })));
    assert!(matches!(spot(0.5, f32::INFINITY).view(&good), Err(LightError::Position { .. })));
    assert!(matches!(
        sun(0.0, -1.0, 0.0).view(&fit(vec![])),
        Err(LightError::Bounds { what: "receivers", .. })
    ));
    assert!(matches!(
        sun(0.0, -1.0, 0.0).view(&fit(vec![Vec3::NAN])),
        Err(LightError::Bounds { what: "receivers", .. })
    ));
    // One bad point among good ones, wherever it stands.
    for (at, bad) in [Vec3::new(0.0, f32::NAN, 0.0), Vec3::INFINITY].into_iter().enumerate() {
        let mut receivers = good.receivers.clone();
        receivers.insert(3 * at, bad);
        let error = sun(0.0, -1.0, 0.0).view(&fit(receivers)).unwrap_err();
        assert!(matches!(error, LightError::Bounds { what: "receivers", .. }), "{error}");
    }
    let narrow = Fit { margin_texels: 256.0, ..good.clone() };
    assert!(matches!(sun(0.0, -1.0, 0.0).view(&narrow), Err(LightError::Margin { .. })));
    let empty = Bounds { min: Vec3::ONE, max: Vec3::ZERO };
    let message = sun(0.0, -1.0, 0.0).view(&Fit { casters: empty, ..good }).unwrap_err().to_string();
    assert!(message.contains("[1, 1, 1]") && message.contains("casters"), "{message}");
}

#[test]
fn penumbrae_beyond_the_casters_are_inside_too() {
    // Casters in the middle of a wide floor: a kernel carries their shadow past their bounds.
    let casters = Bounds { min: Vec3::new(-1.0, 0.0, -1.0), max: Vec3::new(1.0, 1.0, 1.0) };
    let fit = Fit { casters, margin_texels: 17.0, ..fit(BOX.corners().collect()) };
    let view = sun(0.0, -1.0, 0.0).view(&fit).unwrap();
    let reach = 16.0 * view.texel_world;
    for side in [-1.0, 1.0] {
        let p = project(&view, Vec3::new(side * (1.0 + reach), 0.0, 0.0));
        // The kernel around it must still fit.
        assert!(p.x.abs() <= 1.0 - 2.0 * 16.0 / 512.0, "{p}");
    }
    let alone = Fit { receivers: casters.corners().collect(), ..fit };
    let tight = sun(0.0, -1.0, 0.0).view(&alone).unwrap();
    assert!(tight.texel_world < view.texel_world, "receivers that end with the casters need no more room");
}

#[test]
fn depth_leans_until_its_range_is_as_long_as_a_ray_in_the_scene() {
    for light in [sun(1.0, -1.0, 0.0), sun(0.3, -1.0, 0.2), sun(-2.0, -1.0, 1.0)] {
        let fit = Fit { size: Size::square(4096), ..fit(BOX.corners().collect()) };
        let view = light.view(&fit).unwrap();
        let along = -view.to_light.truncate();
        // From the ceiling to the floor, 5 below.
        let longest = 5.0 / -along.y;
        assert!((view.depth_world / longest - 1.0).abs() < 5e-3, "{} for {longest}", view.depth_world);
        // Along the light depth grows by one in a range, whatever it does across.
        let step = along * view.depth_world;
        assert!((view.depth_plane.truncate().dot(step) - 1.0).abs() < 1e-5);
        let across = view.clip_from_world.transform_vector3(step);
        assert!(across.truncate().length() < 1e-5 && (across.z - 1.0).abs() < 1e-5, "{across}");
        // What it does across is said per unit of texture coordinate.
        let world = |x, y| view.clip_from_world.inverse().project_point3(Vec3::new(x, y, 0.3));
        let level = |p: Vec3| p - along * along.dot(p - world(0.0, 0.0));
        let gain = |x, y| view.depth_plane.dot(level(world(x, y)).extend(1.0)) - 0.3;
        assert!(
            (gain(2.0, 0.0) - view.lean().x).abs() < 1e-4 && (gain(0.0, -2.0) - view.lean().y).abs() < 1e-4
        );
        assert!(view.lean().length() > 0.1 && !view.is_warped());
    }
}
