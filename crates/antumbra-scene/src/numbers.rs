//! What files call their cameras and lights.

use crate::{Camera, Light, Scene};

/// A camera or light of a file. Its place in [`Scene::camera_numbers`] or [`Scene::light_numbers`] is
/// the number that the file gives it, also where other entries could not be taken.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Numbered {
    /// What the file calls it; empty if it has no name.
    pub name: String,
    /// Where it stands: indices into [`Scene::cameras`] or [`Scene::lights`], one for each node that
    /// uses it. Empty if it was not taken.
    pub places: Vec<usize>,
    /// Why it was not taken; empty if it was.
    pub reason: String,
}

impl Scene {
    /// The camera that the file calls `number`, where its node `copy` (0 if only one uses it) puts
    /// it. Scenes without [`Scene::camera_numbers`] number their cameras from 0.
    ///
    /// # Errors
    /// A sentence that says which cameras there are, or why this one was not taken.
    pub fn camera_of_file(&self, number: usize, copy: usize) -> Result<Camera, String> {
        let place = find("camera", &self.camera_numbers, self.cameras.len(), [number, copy])?;
        self.cameras.get(place).copied().ok_or_else(|| format!("camera {place} does not exist"))
    }

    /// Like [`Scene::camera_of_file`] for lights.
    ///
    /// # Errors
    /// A sentence that says which lights there are, or why this one was not taken.
    pub fn light_of_file(&self, number: usize, copy: usize) -> Result<Light, String> {
        let place = find("light", &self.light_numbers, self.lights.len(), [number, copy])?;
        self.lights.get(place).copied().ok_or_else(|| format!("light {place} does not exist"))
    }
}

/// The place of an entry in the scene's own list of `count`.
fn find(kind: &str, numbers: &[Numbered], count: usize, [number, copy]: [usize; 2]) -> Result<usize, String> {
    let plain: Vec<Numbered>;
    let numbers = if numbers.is_empty() {
        plain = (0..count).map(|i| Numbered { places: vec![i], ..Numbered::default() }).collect();
        &plain
    } else {
        numbers
    };
    let s = if numbers.len() == 1 { "" } else { "s" };
    let Some(entry) = numbers.get(number) else {
        let all: Vec<String> = numbers.iter().enumerate().map(|(i, entry)| entry.shown(i)).collect();
        let list = if all.is_empty() { String::new() } else { format!(": {}", all.join(", ")) };
        return Err(format!("the scene has {} {kind}{s}{list}", numbers.len()));
    };
    if entry.places.is_empty() {
        let taken: Vec<String> = (0..numbers.len())
            .filter(|&i| !numbers[i].places.is_empty())
            .map(|i| numbers[i].shown(i))
            .collect();
        let others = if taken.is_empty() { "none".into() } else { taken.join(", ") };
        return Err(format!("{kind} {} {}; usable are: {others}", entry.shown(number), entry.reason));
    }
    entry.places.get(copy).copied().ok_or_else(|| {
        let last = entry.places.len() - 1;
        format!("{kind} {} stands in {} places, {number}.0 to {number}.{last}", entry.shown(number), last + 1)
    })
}

impl Numbered {
    fn shown(&self, number: usize) -> String {
        let name = if self.name.is_empty() { String::new() } else { format!(" '{}'", self.name) };
        let lost = if self.places.is_empty() { " (not taken)" } else { "" };
        format!("{number}{name}{lost}")
    }
}
