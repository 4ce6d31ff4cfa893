//! The vertices and triangles of one primitive, before any node moves them.

use super::accessor::{Asset, Format, Table, follow};
use super::document::Primitive;
use super::{extensions, topology};
use crate::import::error::{Problem, invalid};
use crate::import::vertices::Vertices;
use glam::{Affine2, Vec2, Vec3, Vec4};

/// Which texture coordinates the material wants, and how they are transformed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Coordinates {
    pub(super) set: usize,
    pub(super) transform: Affine2,
}

/// What an attribute may look like.
#[derive(Debug, Clone, Copy)]
struct Rule {
    shapes: &'static [&'static str],
    /// Formats allowed without any extension, as (format, normalised).
    formats: &'static [(Format, bool)],
    /// Whether `KHR_mesh_quantization` adds the 8 and 16-bit integers.
    quantizable: bool,
}

const FLOAT: (Format, bool) = (Format::F32, false);
const DIRECTION: Rule = Rule { shapes: &["VEC3"], formats: &[FLOAT], quantizable: true };
const PLACEMENT: Rule = Rule {
    shapes: &["VEC3", "VEC4"],
    formats: &[FLOAT, (Format::I8, true), (Format::I16, true)],
    quantizable: false,
};
const COORDINATES: Rule =
    Rule { shapes: &["VEC2"], formats: &[FLOAT, (Format::U8, true), (Format::U16, true)], quantizable: true };
const COLOR: Rule = Rule { shapes: &["VEC3", "VEC4"], quantizable: false, ..COORDINATES };
const WEIGHTS: Rule = Rule { shapes: &["VEC4"], quantizable: false, ..COORDINATES };
const JOINTS: Rule =
    Rule { shapes: &["VEC4"], formats: &[(Format::U8, false), (Format::U16, false)], quantizable: false };
const INDICES: Rule = Rule {
    shapes: &["SCALAR"],
    formats: &[(Format::U8, false), (Format::U16, false), (Format::U32, false)],
    quantizable: false,
};

impl Asset {
    fn attribute(&self, index: usize, element: &str, rule: Rule) -> Result<Table, Problem> {
        let table = self.table(index, element)?;
        let integer = !matches!(table.format, Format::F32 | Format::U32);
        let quantized = self.document.extensions_used.iter().any(|e| e == "KHR_mesh_quantization");
        if !rule.shapes.contains(&table.shape.as_str()) {
            return Err(invalid(element, &table.shape, format!("allowed are {}", rule.shapes.join(", "))));
        }
        if !(rule.formats.contains(&(table.format, table.normalized))
            || rule.quantizable && integer && quantized)
        {
            let kind = |(format, normalized): (Format, bool)| {
                format!("{}{format:?}", if normalized { "normalised " } else { "" })
            };
            let allowed: Vec<_> = rule.formats.iter().copied().map(kind).collect();
            let more = if rule.quantizable { "; smaller integers need KHR_mesh_quantization" } else { "" };
            let allowed = format!("allowed are {}{more}", allowed.join(", "));
            return Err(invalid(element, kind((table.format, table.normalized)), allowed));
        }
        Ok(table)
    }

    /// An attribute as vectors, all finite, as many as there are positions.
    fn vectors<const N: usize>(
        &self,
        index: usize,
        element: &str,
        rule: Rule,
        positions: Option<usize>,
    ) -> Result<Vec<[f32; N]>, Problem> {
        let table = self.attribute(index, element, rule)?;
        counted(&table, element, positions)?;
        let read = |i: usize| {
            let vector: [f32; N] =
                std::array::from_fn(|k| if k < table.width { table.float(i, k) } else { 1.0 });
            if vector.iter().all(|x| x.is_finite()) {
                Ok(vector)
            } else {
                Err(invalid(format!("{element}[{i}]"), format!("{vector:?}"), "it must be finite"))
            }
        };
        (0..table.count).map(read).collect()
    }

    /// Translations, rotations or scales of instances, padded to four numbers.
    pub(super) fn placement(
        &self,
        index: usize,
        element: &str,
        count: usize,
    ) -> Result<Vec<[f32; 4]>, Problem> {
        self.vectors(index, element, PLACEMENT, Some(count))
    }

    /// Reads one primitive, moved by its morph targets. `None` for points and lines and for
    /// primitives without positions.
    pub(super) fn vertices(
        &self,
        primitive: &Primitive,
        element: &str,
        weights: &[f32],
        coordinates: Coordinates,
    ) -> Result<Option<Vertices>, Problem> {
        let plain = primitive.attributes.get("POSITION").and_then(|&i| self.document.accessors.get(i));
        let has_data = plain.is_some_and(|a| a.buffer_view.is_some() || a.sparse.is_some());
        extensions::check_primitive(&primitive.extensions, has_data, element)?;
        let topology = topology::from_mode(primitive.mode, element)?;
        let (Some(topology), Some(&position)) = (topology, primitive.attributes.get("POSITION")) else {
            return Ok(None);
        };
        let name = |attribute: &str| format!("{element}.attributes.{attribute}");
        let mut positions: Vec<Vec3> = self
            .vectors(position, &name("POSITION"), DIRECTION, None)?
            .into_iter()
            .map(Vec3::from_array)
            .collect();
        let count = Some(positions.len());
        let mut normals: Vec<Vec3> = match primitive.attributes.get("NORMAL") {
            Some(&i) => {
                let normals = self.vectors(i, &name("NORMAL"), DIRECTION, count)?;
                normals.into_iter().map(Vec3::from_array).collect()
            }
            None => Vec::new(),
        };
        self.morph(primitive, element, weights, [&mut positions, &mut normals])?;
        let set = format!("TEXCOORD_{}", coordinates.set);
        let uvs = match primitive.attributes.get(&set) {
            Some(&i) => {
                let uvs = self.vectors(i, &name(&set), COORDINATES, count)?;
                uvs.into_iter().map(|uv| coordinates.transform.transform_point2(uv.into())).collect()
            }
            None => vec![Vec2::ZERO; positions.len()],
        };
        let colors = match primitive.attributes.get("COLOR_0") {
            Some(&i) => {
                self.vectors(i, &name("COLOR_0"), COLOR, count)?.into_iter().map(Vec4::from_array).collect()
            }
            None => vec![Vec4::ONE; positions.len()],
        };
        let joints = self.joints(primitive, &name, positions.len())?;
        let corners = self.corners(primitive, element, positions.len())?;
        let triangles = topology.triangles(&corners);
        Ok(Some(Vertices { positions, normals, uvs, colors, joints, triangles }))
    }

    /// Adds the weighted morph targets. Targets without weight are checked but not read.
    fn morph(
        &self,
        primitive: &Primitive,
        element: &str,
        weights: &[f32],
        [positions, normals]: [&mut Vec<Vec3>; 2],
    ) -> Result<(), Problem> {
        let count = positions.len();
        if !weights.is_empty() && weights.len() != primitive.targets.len() {
            let allowed = format!("there must be {}, one for each target", primitive.targets.len());
            return Err(invalid(
                format!("{element}: weights"),
                format!("{} numbers", weights.len()),
                allowed,
            ));
        }
        for (i, target) in primitive.targets.iter().enumerate() {
            let weight = weights.get(i).copied().unwrap_or(0.0);
            for (attribute, values) in [("POSITION", &mut *positions), ("NORMAL", &mut *normals)] {
                let Some(&index) = target.get(attribute) else { continue };
                let element = format!("{element}.targets[{i}].{attribute}");
                let found = follow(&self.document.accessors, "accessors", index, &element)?.count;
                if found != count {
                    let allowed = format!("there must be {count}, one for each position");
                    return Err(invalid(element, format!("{found} elements"), allowed));
                }
                if weight != 0.0 && !values.is_empty() {
                    let moves = self.vectors(index, &element, DIRECTION, Some(count))?;
                    values.iter_mut().zip(moves).for_each(|(v, m)| *v += Vec3::from_array(m) * weight);
                }
            }
        }
        Ok(())
    }

    /// Joints and weights of each vertex, all sets together.
    fn joints(
        &self,
        primitive: &Primitive,
        name: &dyn Fn(&str) -> String,
        positions: usize,
    ) -> Result<Vec<Vec<(u32, f32)>>, Problem> {
        let mut all = Vec::new();
        for set in 0.. {
            let [joints, weights] = ["JOINTS", "WEIGHTS"].map(|s| format!("{s}_{set}"));
            let indices = [&joints, &weights].map(|s| primitive.attributes.get(s.as_str()));
            let (&joint_index, &weight_index) = match indices {
                [Some(joint), Some(weight)] => (joint, weight),
                [None, None] => break,
                [found, _] => {
                    let lonely = if found.is_some() { &joints } else { &weights };
                    return Err(invalid(
                        name(lonely),
                        "alone",
                        format!("{joints} and {weights} come in pairs"),
                    ));
                }
            };
            let table = self.attribute(joint_index, &name(&joints), JOINTS)?;
            counted(&table, &name(&joints), Some(positions))?;
            let values: Vec<[f32; 4]> =
                self.vectors(weight_index, &name(&weights), WEIGHTS, Some(positions))?;
            all.resize(positions, Vec::new());
            for (i, (vertex, weights)) in all.iter_mut().zip(values).enumerate() {
                let pairs = weights.into_iter().enumerate().filter(|(_, w)| *w != 0.0);
                vertex.extend(pairs.map(|(k, w)| (table.unsigned(i, k), w)));
            }
        }
        Ok(all)
    }

    /// The vertex numbers of a primitive in drawing order, each below `vertices`.
    fn corners(&self, primitive: &Primitive, element: &str, vertices: usize) -> Result<Vec<u32>, Problem> {
        let Some(index) = primitive.indices else {
            let Ok(end) = u32::try_from(vertices) else {
                let allowed = format!("at most {} are allowed", u32::MAX);
                return Err(invalid(format!("{element}.attributes.POSITION"), vertices, allowed));
            };
            return Ok((0..end).collect());
        };
        let element = format!("{element}.indices");
        follow(&self.document.accessors, "accessors", index, &element)?;
        let table = self.attribute(index, &element, INDICES)?;
        let restart = match table.format {
            Format::U8 => u32::from(u8::MAX),
            Format::U16 => u32::from(u16::MAX),
            _ => u32::MAX,
        };
        let read = |i: usize| {
            let value = table.unsigned(i, 0);
            if value == restart {
                let allowed = "that value restarts primitives on GPUs and is not allowed";
                Err(invalid(format!("{element}[{i}]"), value, allowed))
            } else if value as usize >= vertices {
                let allowed = format!("it must be below {vertices}, the number of vertices");
                Err(invalid(format!("{element}[{i}]"), value, allowed))
            } else {
                Ok(value)
            }
        };
        (0..table.count).map(read).collect()
    }
}

fn counted(table: &Table, element: &str, positions: Option<usize>) -> Result<(), Problem> {
    match positions {
        Some(n) if n != table.count => {
            let allowed = format!("there must be {n}, one for each position");
            Err(invalid(element, format!("{} elements", table.count), allowed))
        }
        _ => Ok(()),
    }
}
