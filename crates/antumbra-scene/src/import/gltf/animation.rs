//! Poses: what an animation makes of nodes and morph weights at one moment. Nodes are changed before
//! they are placed, so skins follow.

use super::accessor::{Asset, Format, follow};
use super::container;
use super::document::Node;
use super::selection;
use crate::import::error::{Problem, invalid};
use crate::import::notes::Notes;
use crate::import::options::{self, Options};
use glam::{DMat4, DQuat};
use serde::Deserialize;

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Animation {
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

#[derive(Debug, Deserialize)]
struct Channel {
    sampler: usize,
    target: Target,
}

#[derive(Debug, Deserialize)]
struct Target {
    node: Option<usize>,
    path: String,
}

#[derive(Debug, Deserialize)]
struct Sampler {
    input: usize,
    output: usize,
    #[serde(default)]
    interpolation: Interpolation,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Interpolation {
    Step,
    #[default]
    Linear,
    CubicSpline,
}

/// What a channel moves.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Path {
    Translation,
    Rotation,
    Scale,
    Weights,
}

/// The moments and values of a sampler.
#[derive(Debug)]
struct Curve {
    times: Vec<f64>,
    /// For each moment `width` numbers; with cubic splines the tangent before, the value and the
    /// tangent behind.
    values: Vec<f64>,
    width: usize,
    interpolation: Interpolation,
    /// Whether the numbers are a rotation.
    turns: bool,
}

impl Asset {
    /// Moves the nodes as the options ask; says so if the file has animations and none is asked for.
    pub(super) fn animate(&mut self, options: &Options, notes: &mut Notes) -> Result<(), Problem> {
        let animations = &self.document.animations;
        let names: Vec<Option<&str>> = animations.iter().map(|a| a["name"].as_str()).collect();
        let several = if names.len() == 1 { "animation" } else { "animations" };
        let all = format!("the file has {} {several}: {}", names.len(), selection::listed(&names));
        let index = match (&options.animation, options.time) {
            (Some(wanted), _) => options::choose("animations", "animation", wanted, &names)?,
            (None, Some(time)) if names.is_empty() => {
                return Err(invalid("option time", time, "the file has no animations; leave it out"));
            }
            (None, Some(_)) => 0,
            (None, None) => {
                if !names.is_empty() {
                    notes.say(format!("{all}; the pose at rest is shown; another with --time SECONDS"));
                }
                return Ok(());
            }
        };
        if options.animation.is_none() && names.len() > 1 {
            notes.say(format!("{all}; the first poses the scene; another one with --animation"));
        }
        let time = options.time.unwrap_or(0.0);
        if !time.is_finite() {
            return Err(invalid("option time", time, "it must be a finite number of seconds"));
        }
        let element = format!("animations[{index}]");
        let animation: Animation = container::value(&animations[index], &element)?;
        self.pose(&animation, &element, time, notes)
    }

    fn pose(
        &mut self,
        animation: &Animation,
        element: &str,
        time: f64,
        notes: &mut Notes,
    ) -> Result<(), Problem> {
        let mut range: Option<[f64; 2]> = None;
        for (i, channel) in animation.channels.iter().enumerate() {
            let element_of = format!("{element}.channels[{i}]");
            let path = match channel.target.path.as_str() {
                "translation" => Path::Translation,
                "rotation" => Path::Rotation,
                "scale" => Path::Scale,
                "weights" => Path::Weights,
                other => {
                    notes.add(element_of, format!("left out: channels with the path '{other}' are not read"));
                    continue;
                }
            };
            let Some(node) = channel.target.node else { continue };
            follow(&self.document.nodes, "nodes", node, &format!("{element_of}.target.node"))?;
            let owner = format!("{element_of}.sampler");
            let sampler = follow(&animation.samplers, "samplers", channel.sampler, &owner)?;
            let curve = self.curve(sampler, path, &format!("{element}.samplers[{}]", channel.sampler))?;
            if let (Some(&first), Some(&last)) = (curve.times.first(), curve.times.last()) {
                let [low, high] = range.unwrap_or([first, last]);
                range = Some([low.min(first), high.max(last)]);
            }
            set(&mut self.document.nodes[node], path, &curve.at(time));
        }
        if let Some([first, last]) = range
            && !(first..=last).contains(&time)
        {
            let end = if time < first { "beginning" } else { "end" };
            notes.say(format!(
                "{element} lasts from {first} to {last} s; at {time} s it shows the pose of its {end}"
            ));
        }
        Ok(())
    }

    fn curve(&self, sampler: &Sampler, path: Path, element: &str) -> Result<Curve, Problem> {
        let input = format!("{element}.input");
        let keys = self.table(sampler.input, &input)?;
        if keys.shape != "SCALAR" || keys.format != Format::F32 {
            return Err(invalid(input, format!("{} {:?}", keys.shape, keys.format), "it must be SCALAR F32"));
        }
        let times: Vec<f64> = (0..keys.count).map(|i| keys.float(i, 0).into()).collect();
        if let Some(i) =
            (0..times.len()).find(|&i| !times[i].is_finite() || i > 0 && times[i] <= times[i - 1])
        {
            return Err(invalid(format!("{input}[{i}]"), times[i], "times must be finite and increase"));
        }
        let output = format!("{element}.output");
        let table = self.table(sampler.output, &output)?;
        let shape = match path {
            Path::Rotation => "VEC4",
            Path::Weights => "SCALAR",
            Path::Translation | Path::Scale => "VEC3",
        };
        if table.shape != shape || (table.format != Format::F32 && !table.normalized) {
            let value = format!("{} {:?}", table.shape, table.format);
            let allowed = format!("a {path:?} must be {shape} of F32 or normalised integers");
            return Err(invalid(output, value, allowed));
        }
        let parts = if sampler.interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let per_key = if path == Path::Weights { table.count / times.len() / parts } else { 1 };
        if per_key == 0 || table.count != times.len() * parts * per_key {
            let allowed = format!("{} times of {parts} values each are needed", times.len());
            return Err(invalid(output, format!("{} elements", table.count), allowed));
        }
        let values: Vec<f64> = (0..table.count)
            .flat_map(|i| (0..table.width).map(move |k| (i, k)))
            .map(|(i, k)| f64::from(table.float(i, k)))
            .collect();
        if let Some(i) = values.iter().position(|v| !v.is_finite()) {
            return Err(invalid(format!("{output}[{}]", i / table.width), values[i], "it must be finite"));
        }
        let turns = path == Path::Rotation;
        Ok(Curve { times, values, width: table.width * per_key, interpolation: sampler.interpolation, turns })
    }
}

impl Curve {
    /// Tangent before (0), value (1) or tangent behind (2) of a key.
    fn part(&self, key: usize, part: usize) -> &[f64] {
        let place = match self.interpolation {
            Interpolation::CubicSpline => 3 * key + part,
            _ => key,
        };
        &self.values[place * self.width..][..self.width]
    }

    /// The value at a moment; before the first key and behind the last that key's.
    fn at(&self, time: f64) -> Vec<f64> {
        let next = self.times.partition_point(|&t| t <= time);
        let last = self.times.len() - 1;
        if next == 0 || next > last || self.interpolation == Interpolation::Step {
            return self.part(next.saturating_sub(1).min(last), 1).to_vec();
        }
        let (from, to) = (self.part(next - 1, 1), self.part(next, 1));
        let length = self.times[next] - self.times[next - 1];
        let t = (time - self.times[next - 1]) / length;
        if self.interpolation == Interpolation::CubicSpline {
            let (leave, arrive) = (self.part(next - 1, 2), self.part(next, 0));
            // glTF 2.0, appendix C.4.
            let (t2, t3) = (t * t, t * t * t);
            let weights = [2.0 * t3 - 3.0 * t2 + 1.0, length * (t3 - 2.0 * t2 + t)];
            let weights_to = [3.0 * t2 - 2.0 * t3, length * (t3 - t2)];
            return (0..self.width)
                .map(|k| {
                    from[k] * weights[0]
                        + leave[k] * weights[1]
                        + to[k] * weights_to[0]
                        + arrive[k] * weights_to[1]
                })
                .collect();
        }
        if self.turns {
            let [from, to] = [from, to].map(rotation);
            return from.slerp(to, t).to_array().to_vec();
        }
        from.iter().zip(to).map(|(a, b)| a + (b - a) * t).collect()
    }
}

/// The rotation of four numbers, also where rounding made them no unit.
fn rotation(q: &[f64]) -> DQuat {
    let q = DQuat::from_xyzw(q[0], q[1], q[2], q[3]);
    if q.length() > 1e-6 { q.normalize() } else { DQuat::IDENTITY }
}

/// Gives a node one part of its pose.
fn set(node: &mut Node, path: Path, value: &[f64]) {
    if let Some(columns) = node.matrix.take_if(|_| path != Path::Weights) {
        let (scale, rotation, translation) = DMat4::from_cols_array(&columns).to_scale_rotation_translation();
        node.scale = Some(scale.to_array());
        node.rotation = Some(rotation.to_array());
        node.translation = Some(translation.to_array());
    }
    let three = || std::array::from_fn(|k| value[k]);
    match path {
        Path::Translation => node.translation = Some(three()),
        Path::Scale => node.scale = Some(three()),
        Path::Rotation => node.rotation = Some(rotation(value).to_array()),
        Path::Weights => node.weights = Some(value.iter().map(|&w| w as f32).collect()),
    }
}
