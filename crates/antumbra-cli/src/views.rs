//! Cameras, lights and axes from what the command line says of them.

use crate::output::note;
use antumbra_scene::{Camera, Light, Numbered, Projection, Scene, Up};
use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use glam::{DVec3, Quat, Vec3};

/// An axis of a file, either way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Axis {
    X,
    Y,
    Z,
    #[value(name = "-x")]
    NegativeX,
    #[value(name = "-y")]
    NegativeY,
    #[value(name = "-z")]
    NegativeZ,
}

impl From<Axis> for Up {
    fn from(axis: Axis) -> Self {
        match axis {
            Axis::X => Self::X,
            Axis::Y => Self::Y,
            Axis::Z => Self::Z,
            Axis::NegativeX => Self::NegativeX,
            Axis::NegativeY => Self::NegativeY,
            Axis::NegativeZ => Self::NegativeZ,
        }
    }
}

/// The way `--camera` is written, for errors.
const CAMERA: &str = "write eye:target, eye:target:degrees or eye:target:degrees:roll, for example 3,2,5:0,1,0:50, \
                      or ortho:eye:target:height or ortho:eye:target:height:roll, for example \
                      ortho:3,2,5:0,1,0:4";

/// The camera that `--camera` names or describes.
pub(crate) fn camera(text: &str, scene: &Scene) -> Result<Camera> {
    if let Some((number, copy)) = numbered(text) {
        say_copies("camera", number, copy, &scene.camera_numbers);
        return scene.camera_of_file(number, copy.unwrap_or(0)).map_err(anyhow::Error::msg);
    }
    let (is_parallel, text) = text.strip_prefix("ortho:").map_or((false, text), |rest| (true, rest));
    let parts: Vec<&str> = text.split(':').collect();
    let (eye, target, lens, roll) = match parts[..] {
        [eye, target] if !is_parallel => (eye, target, "50", "0"),
        [eye, target, lens] => (eye, target, lens, "0"),
        [eye, target, lens, roll] => (eye, target, lens, roll),
        _ => bail!(CAMERA),
    };
    let [eye, target] = [point(eye, scene)?, point(target, scene)?];
    let projection = if is_parallel {
        Projection::Orthographic { height: length(lens)? }
    } else {
        Projection::Perspective { fov_y: degrees(lens, 170.0)? }
    };
    if eye == target {
        bail!("eye and target are the same point {eye}");
    }
    let forward = (target - eye)
        .try_normalize()
        .with_context(|| format!("eye {eye} and target {target} are too near or too far from each other"))?;
    let upright = if forward.y.abs() > 0.999 { Vec3::Z } else { Vec3::Y };
    Ok(Camera { position: eye, target, up: rolled(upright, forward, roll)?, projection })
}

/// The upward direction of a camera that is turned clockwise by so many degrees.
fn rolled(up: Vec3, forward: Vec3, degrees: &str) -> Result<Vec3> {
    match degrees.parse::<f32>() {
        Ok(0.0) => Ok(up),
        Ok(roll) if roll.abs() <= 360.0 => {
            // About the line of sight, which must not carry what is along it.
            let across = (up - forward * up.dot(forward)).normalize();
            Ok(Quat::from_axis_angle(forward, roll.to_radians()) * across)
        }
        _ => bail!("roll '{degrees}' is not an angle from -360 to 360 degrees"),
    }
}

/// The light that `--light` names or describes.
pub(crate) fn light(text: &str, scene: &Scene) -> Result<Light> {
    if let Some((number, copy)) = numbered(text) {
        say_copies("light", number, copy, &scene.light_numbers);
        return scene.light_of_file(number, copy.unwrap_or(0)).map_err(anyhow::Error::msg);
    }
    let direction = |text: &str| -> Result<Vec3> {
        let direction = scene.placement.direction(vector(text)?).as_vec3();
        direction
            .try_normalize()
            .with_context(|| format!("direction {text} has no length, or one beyond what an f32 holds"))
    };
    let Some(spot) = text.strip_prefix("spot:") else {
        return Ok(Light::Directional { direction: direction(text)? });
    };
    let parts: Vec<&str> = spot.split(':').collect();
    let [position, axis, angle] = parts[..] else {
        bail!("write spot:position:direction:degrees, for example spot:0,4,0:0,-1,0:35");
    };
    let asked = degrees(angle, 90.0)?;
    let outer_angle = asked.min(Light::MAX_OUTER_ANGLE);
    if outer_angle < asked {
        note(&format!("--light {text}: {}", Light::narrowed(asked)));
    }
    Ok(Light::Spot { position: point(position, scene)?, direction: direction(axis)?, outer_angle })
}

/// `N` or `N.K`: the number of a camera or light, and which of its places.
fn numbered(text: &str) -> Option<(usize, Option<usize>)> {
    match text.split_once('.') {
        None => Some((text.parse().ok()?, None)),
        Some((number, copy)) => Some((number.parse().ok()?, Some(copy.parse().ok()?))),
    }
}

/// Says where else a camera or light stands that was asked for by its number alone.
fn say_copies(kind: &str, number: usize, copy: Option<usize>, numbers: &[Numbered]) {
    if let (None, Some(entry)) = (copy, numbers.get(number))
        && entry.places.len() > 1
    {
        let last = entry.places.len() - 1;
        note(&format!(
            "{kind} {number} stands in several places, {number}.0 to {number}.{last}; the first is taken"
        ));
    }
}

/// A point in the file's coordinates, in the scene's.
fn point(text: &str, scene: &Scene) -> Result<Vec3> {
    let point = scene.placement.point(vector(text)?);
    if !point.is_finite() {
        bail!("'{text}' is beyond what an f32 holds");
    }
    Ok(point)
}

fn vector(text: &str) -> Result<DVec3> {
    let parts: Vec<f64> = text.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    match parts[..] {
        [x, y, z] if text.split(',').count() == 3 && DVec3::new(x, y, z).is_finite() => {
            Ok(DVec3::new(x, y, z))
        }
        _ => bail!("'{text}' is not three finite numbers x,y,z"),
    }
}

fn degrees(text: &str, max: f32) -> Result<f32> {
    match text.parse::<f32>() {
        Ok(degrees) if degrees > 0.0 && degrees <= max => Ok(degrees.to_radians()),
        _ => bail!("'{text}' is not an angle of more than 0 and at most {max} degrees"),
    }
}

fn length(text: &str) -> Result<f32> {
    match text.parse::<f32>() {
        Ok(length) if length > 0.0 && length.is_finite() => Ok(length),
        _ => bail!("height '{text}' is not a finite number above 0"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_scene::procedural;

    fn contact() -> Scene {
        procedural::by_name("contact").unwrap().scene(1)
    }

    #[test]
    fn cameras_and_lights_are_read() {
        let scene = contact();
        let read = camera("3,2,5:0,1,0:50", &scene).unwrap();
        assert_eq!((read.position, read.target, read.up), (Vec3::new(3.0, 2.0, 5.0), Vec3::Y, Vec3::Y));
        assert_eq!(read.projection, Projection::Perspective { fov_y: 50f32.to_radians() });
        assert_eq!(camera("3,2,5:0,1,0", &scene).unwrap(), read);
        assert_eq!(camera("3,2,5:0,1,0:50:0", &scene).unwrap(), read);
        let parallel = camera("ortho:3,2,5:0,1,0:4", &scene).unwrap();
        assert_eq!(parallel, Camera { projection: Projection::Orthographic { height: 4.0 }, ..read });
        assert!(camera("-1,2,3:0,0,0", &scene).is_ok() && camera("0", &scene).is_ok());
        assert!(matches!(light("0.3,-1,0", &scene).unwrap(), Light::Directional { .. }));
        assert!(matches!(light("spot:0,4,0:0,-1,0:35", &scene).unwrap(), Light::Spot { .. }));
    }

    #[test]
    fn coordinates_are_those_of_the_file() {
        let mut scene = contact();
        scene.placement.origin = DVec3::new(5e6, 0.0, -3e6);
        let read = camera("5000003.25,2,-2999995:5000000,1,-3000000", &scene).unwrap();
        assert_eq!((read.position, read.target), (Vec3::new(3.25, 2.0, 5.0), Vec3::Y));
        let spot = light("spot:5000000.125,4,-3000000:0,-1,0:35", &scene).unwrap();
        assert!(matches!(spot, Light::Spot { position, .. } if position == Vec3::new(0.125, 4.0, 0.0)));
        scene.stand(Up::Z);
        let read = camera("5000003.25,2,-2999995:5000000,1,-3000000", &scene).unwrap();
        assert_eq!(read.position, Vec3::new(3.25, 5.0, -2.0));
        assert_eq!(light("0,0,-1", &scene).unwrap(), Light::Directional { direction: Vec3::NEG_Y });
    }

    #[test]
    fn a_camera_rolls_clockwise() {
        for text in ["0,0,5:0,0,0:50:90", "ortho:0,0,5:0,0,0:4:90", "ortho:0,0,5:0,0,0:4:-270"] {
            let up = camera(text, &contact()).unwrap().up;
            assert!(up.distance(Vec3::X) < 1e-6, "{text}: {up}; its head leans to the right");
        }
    }

    #[test]
    fn unreadable_ones_are_refused_with_an_example() {
        let scene = contact();
        for text in [
            "",
            "1,2",
            "1,2,3",
            "1,2,3:1,2,3",
            "1,2,nan:0,0,0",
            "3e38,0,0:-3e38,0,0",
            "1,2,3:0,0,0:0",
            "1,2,3:0,0,0:inf",
            "1,2,3:0,0,0:50:x",
            "1,2,3:0,0,0:50:400",
            "1,2,3:0,0,0:50:0:0",
            "ortho:1,2,3:0,0,0",
            "ortho:1,2,3:0,0,0:0",
            "ortho:1,2,3:0,0,0:inf",
            "99",
        ] {
            assert!(camera(text, &scene).is_err(), "{text}");
        }
        for text in ["", "0,0,0", "spot:1,2,3", "spot:0,0,0:0,-1,0:95", "1,2,x", "77"] {
            assert!(light(text, &scene).is_err(), "{text}");
        }
    }
}
