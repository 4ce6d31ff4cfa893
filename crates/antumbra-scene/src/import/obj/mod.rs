//! Wavefront OBJ: polygons by line, with one mesh for each object and material.

mod material;

use super::error::{Problem, invalid};
use super::vertices::Vertices;
use crate::{Instance, Material, Scene};
use glam::{Mat4, Vec2, Vec3};
use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// Imports a file with its material libraries and images.
pub(super) fn import(path: &Path) -> Result<Scene, Problem> {
    let bytes = fs::read(path).map_err(Problem::Read)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    read(&String::from_utf8_lossy(&bytes), path.parent().unwrap_or(Path::new("")), &name)
}

fn read(text: &str, folder: &Path, name: &str) -> Result<Scene, Problem> {
    let mut parser = Parser::default();
    let whole = text.replace("\\\r\n", " ").replace("\\\n", " ");
    for (number, line) in (1..).zip(whole.lines()) {
        parser.line(line.split('#').next().unwrap_or_default().trim(), number)?;
    }
    let mut scene = Scene { name: name.into(), ..Scene::default() };
    for library in &parser.libraries {
        material::read(&mut scene, library, folder)?;
    }
    let plain = scene.materials.len();
    scene.materials.push(Material::default());
    for part in parser.parts {
        if part.vertices.triangles.is_empty() {
            continue;
        }
        let material = scene.materials[..plain].iter().position(|m| m.name == part.material);
        let mut vertices = part.vertices;
        if part.lacks_normals {
            vertices.normals.clear();
        }
        scene.meshes.push(vertices.into_mesh(&part.object, material.unwrap_or(plain)));
        scene.instances.push(Instance { mesh: scene.meshes.len() - 1, world_from_mesh: Mat4::IDENTITY });
    }
    scene.validate()?;
    Ok(scene)
}

/// The faces of one object in one material.
#[derive(Debug, Default)]
struct Part {
    object: String,
    material: String,
    vertices: Vertices,
    /// Vertices by their position, texture coordinate and normal numbers.
    seen: HashMap<[Option<usize>; 3], u32>,
    lacks_normals: bool,
}

#[derive(Debug, Default)]
struct Parser {
    positions: Vec<Vec3>,
    colors: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    libraries: Vec<String>,
    object: String,
    material: String,
    parts: Vec<Part>,
    places: HashMap<(String, String), usize>,
}

impl Parser {
    fn line(&mut self, line: &str, number: usize) -> Result<(), Problem> {
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        let vector = || numbers(rest, number, keyword);
        match keyword {
            "v" => {
                let v = vector()?;
                self.positions.push(first(&v, number, keyword)?);
                // Six or more numbers: a colour follows the position.
                self.colors.push(if v.len() >= 6 { Vec3::new(v[3], v[4], v[5]) } else { Vec3::ONE });
            }
            "vn" => self.normals.push(first(&vector()?, number, keyword)?),
            "vt" => {
                let v = vector()?;
                // OBJ puts v = 0 at the bottom of the image, scenes at the top.
                let [u, v] = [0, 1].map(|k| v.get(k).copied().unwrap_or(0.0));
                self.uvs.push(Vec2::new(u, 1.0 - v));
            }
            "f" => self.face(rest, number)?,
            "o" | "g" => self.object = rest.into(),
            "usemtl" => self.material = rest.into(),
            "mtllib" => self.libraries.push(rest.into()),
            _ => {} // Points, lines, curves, smoothing groups.
        }
        Ok(())
    }

    /// Splits a polygon into a fan of triangles.
    fn face(&mut self, corners: &str, line: usize) -> Result<(), Problem> {
        let key = (self.object.clone(), self.material.clone());
        let place = *self.places.entry(key).or_insert_with_key(|(object, material)| {
            self.parts.push(Part { object: object.clone(), material: material.clone(), ..Part::default() });
            self.parts.len() - 1
        });
        let mut fan = Vec::new();
        for corner in corners.split_whitespace() {
            fan.push(self.corner(corner, line, place)?);
        }
        let triangles = fan.windows(2).skip(1).flat_map(|w| [fan[0], w[0], w[1]]);
        self.parts[place].vertices.triangles.extend(triangles);
        Ok(())
    }

    /// The vertex number of a corner such as `3/1/2`, `3//2`, `3/1` or `-1`.
    fn corner(&mut self, corner: &str, line: usize, place: usize) -> Result<u32, Problem> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut numbers = [None; 3];
        for (k, text) in corner.split('/').enumerate().filter(|(_, text)| !text.is_empty()) {
            let count = counts.get(k).copied().unwrap_or(0);
            let place = text.parse::<i64>().ok().and_then(|number| match number {
                1.. => usize::try_from(number - 1).ok(),
                0 => None,
                _ => count.checked_sub(usize::try_from(number.unsigned_abs()).ok()?),
            });
            if place.is_none_or(|place| place >= count) {
                let allowed = format!("allowed here are 1 to {count} and -1 to -{count}");
                return Err(invalid(
                    format!("line {line}: '{text}' of corner {corner}"),
                    "no vertex",
                    allowed,
                ));
            }
            numbers[k] = place;
        }
        let [Some(position), uv, normal] = numbers else {
            let allowed = "it must begin with the number of a position";
            return Err(invalid(format!("line {line}: corner"), format!("'{corner}'"), allowed));
        };
        let part = &mut self.parts[place];
        if let Some(&known) = part.seen.get(&numbers) {
            return Ok(known);
        }
        let vertices = &mut part.vertices;
        let index = vertices.positions.len() as u32;
        vertices.positions.push(self.positions[position]);
        vertices.colors.push(self.colors[position].extend(1.0));
        vertices.uvs.push(uv.map_or(Vec2::ZERO, |i| self.uvs[i]));
        vertices.normals.push(normal.map_or(Vec3::ZERO, |i| self.normals[i]));
        part.lacks_normals |= normal.is_none();
        part.seen.insert(numbers, index);
        Ok(index)
    }
}

/// The finite numbers of a line.
fn numbers(text: &str, line: usize, keyword: &str) -> Result<Vec<f32>, Problem> {
    let read = |word: &str| {
        word.parse().ok().filter(|x: &f32| x.is_finite()).ok_or_else(|| {
            invalid(format!("line {line}: number of '{keyword}'"), format!("'{word}'"), "it must be finite")
        })
    };
    text.split_whitespace().map(read).collect()
}

/// The first three numbers of a line.
fn first(numbers: &[f32], line: usize, keyword: &str) -> Result<Vec3, Problem> {
    match *numbers {
        [x, y, z, ..] => Ok(Vec3::new(x, y, z)),
        _ => Err(invalid(
            format!("line {line}: '{keyword}'"),
            format!("{} numbers long", numbers.len()),
            "it needs at least 3",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Scene, Problem> {
        read(text, Path::new(""), "test")
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\nvt 0.25 0.25\nvn 0 0 1\n";

    #[test]
    fn polygons_objects_and_relative_numbers() {
        let text = format!("{SQUARE}f 1/1/1 2/1/1 3/1/1 4/1/1 # a quad\no other\nf -4 -3 \\\n-2\nl 1 2\n");
        let scene = parse(&text).unwrap();
        assert_eq!(scene.meshes.len(), 2);
        assert_eq!(scene.meshes[0].indices, [0, 1, 2, 0, 2, 3]);
        assert_eq!(scene.meshes[0].uvs[0], Vec2::new(0.25, 0.75));
        assert_eq!(scene.meshes[0].colors[1].x, 0.5);
        assert_eq!(scene.meshes[1].normals, [Vec3::Z; 3], "flat, as the file has none");
    }

    #[test]
    fn bad_lines_are_named() {
        let refusal = |line: &str| parse(&format!("{SQUARE}{line}\n")).unwrap_err().to_string();
        assert_eq!(
            refusal("f 1 2 5"),
            "line 7: '5' of corner 5 is no vertex; allowed here are 1 to 4 and -1 to -4"
        );
        assert!(refusal("f 1 2 9223372036854775807").contains("allowed here are 1 to 4"));
        assert!(refusal("f 1/2 2 3").contains("allowed here are 1 to 1"));
        assert!(refusal("f 1 2 -5").contains("'-5' of corner -5"));
        assert!(refusal("f 1 2 /1").contains("corner is '/1'; it must begin with the number of a position"));
        assert_eq!(refusal("v 0 nan 0"), "line 7: number of 'v' is 'nan'; it must be finite");
        assert_eq!(refusal("v 0 1"), "line 7: 'v' is 2 numbers long; it needs at least 3");
        assert!(refusal("f 1 2").contains("no triangles"));
    }
}
