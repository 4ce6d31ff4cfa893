//! Paths of cameras and lights: the same frames every time, from any scene's own camera and light.

use antumbra_scene::{Camera, Light, Projection};
use glam::{DQuat, DVec3, Vec3};

/// How camera and light move. Frame 0 is the scene as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Path {
    /// The eye turns about its target, 8° around the camera's upward axis, and comes a tenth of its
    /// distance nearer.
    Camera,
    /// The light turns by 5°, sideways: about the axis that is square to it and as upright as can be. A
    /// spot turns about the camera's target and keeps pointing at what it points at.
    Light,
    /// Both at once.
    Both,
    /// The eye moves away from its target on its line of sight, to eight times its distance; every
    /// frame is smaller than the one before by the same factor [Annen et al. 2007, figure 10].
    Recede,
}

/// Camera and light of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The camera.
    pub camera: Camera,
    /// The light.
    pub light: Light,
}

/// Why a path has no frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{count} frames show no motion that can be measured; allowed are 2 to {}", Path::MAX_FRAMES)]
pub struct BadFrameCount {
    /// What was asked for.
    pub count: u32,
}

const ORBIT: f64 = 8.0;
const NEARER: f64 = 0.1;
const TURN: f64 = 5.0;
const AWAY: f64 = 8.0;

impl Path {
    /// Every path.
    pub const ALL: [Self; 4] = [Self::Camera, Self::Light, Self::Both, Self::Recede];
    /// Longest path.
    pub const MAX_FRAMES: u32 = 10_000;

    /// `camera`, `light`, `both` or `recede`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Light => "light",
            Self::Both => "both",
            Self::Recede => "recede",
        }
    }

    /// What moves, in words.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::Camera => "the camera turns 8° about its target and comes a tenth nearer",
            Self::Light => "the light turns 5°",
            Self::Both => {
                "the camera turns 8° about its target and comes a tenth nearer while the light turns 5°"
            }
            Self::Recede => "the camera moves away to eight times its distance",
        }
    }

    /// Camera and light of `count` frames, the first as given, the last at the end of the path.
    /// Computed in f64 and rounded once.
    ///
    /// # Errors
    /// [`BadFrameCount`] unless 2 ≤ `count` ≤ [`MAX_FRAMES`](Self::MAX_FRAMES).
    pub fn frames(self, camera: &Camera, light: &Light, count: u32) -> Result<Vec<Frame>, BadFrameCount> {
        if !(2..=Self::MAX_FRAMES).contains(&count) {
            return Err(BadFrameCount { count });
        }
        let share = |i: u32| f64::from(i) / f64::from(count - 1);
        Ok((0..count).map(|i| self.at(camera, light, share(i))).collect())
    }

    /// Camera and light after a `share` of the path, 0 to 1.
    fn at(self, camera: &Camera, light: &Light, share: f64) -> Frame {
        let camera_at = match self {
            _ if share == 0.0 => *camera,
            Self::Light => *camera,
            Self::Camera | Self::Both => {
                let turn = DQuat::from_axis_angle(unit(camera.up, DVec3::Y), (ORBIT * share).to_radians());
                place(camera, |arm| (turn * arm) * (1.0 - NEARER * share))
            }
            Self::Recede => place(camera, |arm| arm * AWAY.powf(share)),
        };
        let light_at = match self {
            Self::Light | Self::Both if share > 0.0 => {
                turned(light, camera.target.as_dvec3(), (TURN * share).to_radians())
            }
            _ => *light,
        };
        Frame { camera: camera_at, light: light_at }
    }
}

/// The camera with another arm from its target to its eye.
fn place(camera: &Camera, arm: impl FnOnce(DVec3) -> DVec3) -> Camera {
    let target = camera.target.as_dvec3();
    let old = camera.position.as_dvec3() - target;
    let new = arm(old);
    let projection = match camera.projection {
        // Where rays are parallel, only a larger picture shows what a camera farther away would.
        Projection::Orthographic { height } => {
            Projection::Orthographic { height: (f64::from(height) * new.length() / old.length()) as f32 }
        }
        perspective @ Projection::Perspective { .. } => perspective,
    };
    Camera { position: (target + new).as_vec3(), projection, ..*camera }
}

fn unit(v: Vec3, otherwise: DVec3) -> DVec3 {
    v.as_dvec3().normalize_or(otherwise)
}

fn turned(light: &Light, about: DVec3, angle: f64) -> Light {
    let (Light::Directional { direction } | Light::Spot { direction, .. }) = *light;
    let along = unit(direction, DVec3::NEG_Y);
    let upright = (DVec3::Y - along * along.y).normalize_or(DVec3::Z);
    let turn = DQuat::from_axis_angle(upright, angle);
    let direction = (turn * along).as_vec3();
    match *light {
        Light::Directional { .. } => Light::Directional { direction },
        Light::Spot { position, outer_angle, .. } => {
            let position = (about + turn * (position.as_dvec3() - about)).as_vec3();
            Light::Spot { position, direction, outer_angle }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            position: Vec3::new(3.0, 4.0, 9.0),
            target: Vec3::new(1.0, 1.0, 0.0),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.7 },
        }
    }

    fn angle(a: Vec3, b: Vec3) -> f64 {
        f64::from(a.angle_between(b).to_degrees())
    }

    fn direction(light: &Light) -> Vec3 {
        let (Light::Directional { direction } | Light::Spot { direction, .. }) = *light;
        direction
    }

    #[test]
    fn paths_begin_at_the_scene_and_end_where_they_say() {
        let sun = Light::Directional { direction: Vec3::new(0.6, -0.8, 0.1).normalize() };
        for path in Path::ALL {
            let frames = path.frames(&camera(), &sun, 9).unwrap();
            let (first, last) = (frames[0], frames[8]);
            assert_eq!(first, Frame { camera: camera(), light: sun }, "{path:?}");
            let arm = |frame: &Frame| frame.camera.position - frame.camera.target;
            let ratio = f64::from(arm(&last).length() / arm(&first).length());
            let level = |v: Vec3| Vec3::new(v.x, 0.0, v.z);
            let turn = angle(level(arm(&first)), level(arm(&last)));
            let (orbit, distance) = match path {
                Path::Light => (0.0, 1.0),
                Path::Recede => (0.0, 8.0),
                Path::Camera | Path::Both => (8.0, 0.9),
            };
            assert!(
                (turn - orbit).abs() < 0.02 && (ratio - distance).abs() < 1e-4,
                "{path:?}: {turn} {ratio}"
            );
            let swing = angle(direction(&sun), direction(&last.light));
            let expected = if matches!(path, Path::Light | Path::Both) { 5.0 } else { 0.0 };
            assert!((swing - expected).abs() < 0.02, "{path:?}: {swing}");
        }
    }

    #[test]
    fn parallel_rays_show_more_from_afar() {
        let camera = Camera { projection: Projection::Orthographic { height: 2.0 }, ..camera() };
        let sun = Light::Directional { direction: Vec3::NEG_Y };
        let height = |frame: &Frame| match frame.camera.projection {
            Projection::Orthographic { height } => height,
            Projection::Perspective { .. } => f32::NAN,
        };
        let frames = Path::Recede.frames(&camera, &sun, 3).unwrap();
        assert!((height(&frames[2]) - 16.0).abs() < 1e-4);
        let frames = Path::Camera.frames(&camera, &sun, 3).unwrap();
        assert!((height(&frames[2]) - 1.8).abs() < 1e-4);
    }

    #[test]
    fn steps_are_even() {
        let sun = Light::Directional { direction: Vec3::NEG_Y };
        let frames = Path::Light.frames(&camera(), &sun, 6).unwrap();
        for pair in frames.windows(2) {
            assert!((angle(direction(&pair[0].light), direction(&pair[1].light)) - 1.0).abs() < 0.02);
        }
        let frames = Path::Recede.frames(&camera(), &sun, 6).unwrap();
        let distance = |frame: &Frame| (frame.camera.position - frame.camera.target).length();
        for pair in frames.windows(2) {
            assert!((distance(&pair[1]) / distance(&pair[0]) - 8f32.powf(0.2)).abs() < 1e-4);
        }
    }

    #[test]
    fn a_spot_moves_so_that_its_shadows_do() {
        let spot =
            Light::Spot { position: Vec3::new(0.0, 5.0, 0.0), direction: Vec3::NEG_Y, outer_angle: 0.5 };
        let Light::Spot { position, .. } = Path::Light.frames(&camera(), &spot, 2).unwrap()[1].light else {
            panic!("no longer a spot");
        };
        assert!((position - Vec3::new(0.0, 5.0, 0.0)).length() > 0.3);
    }

    #[test]
    fn one_frame_is_no_motion() {
        let sun = Light::Directional { direction: Vec3::NEG_Y };
        for count in [0, 1, Path::MAX_FRAMES + 1] {
            let error = Path::Both.frames(&camera(), &sun, count).unwrap_err().to_string();
            assert!(error.contains(&count.to_string()) && error.contains("2 to 10000"), "{error}");
        }
    }
}
