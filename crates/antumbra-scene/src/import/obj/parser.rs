//! The lines of an OBJ file: vertices, and faces by object, group and material.

use crate::import::error::{Problem, invalid};
use glam::{DVec3, Vec2, Vec3};
use std::collections::{BTreeMap, HashMap};

/// The number of a vertex that a corner does not name.
pub(super) const NONE: u32 = u32::MAX;

/// The faces of one group in one material.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) object: String,
    pub(super) group: String,
    pub(super) material: String,
    /// Numbers of position, texture coordinates and normal, or [`NONE`].
    pub(super) corners: Vec<[u32; 3]>,
    /// How many corners each face has.
    pub(super) faces: Vec<u32>,
    pub(super) lacks_normals: bool,
}

/// The byte order mark, which stands in front of files, and within those that were joined.
const BOM: char = '\u{feff}';

/// What a file holds.
#[derive(Debug, Default)]
pub(super) struct Parser {
    pub(super) positions: Vec<DVec3>,
    /// One per position, or none at all.
    pub(super) colors: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    /// Zero where the file has none.
    pub(super) normals: Vec<Vec3>,
    /// What stands behind `mtllib`.
    pub(super) libraries: Vec<String>,
    pub(super) parts: Vec<Part>,
    /// What was left out: how often, and in which line first.
    left_out: BTreeMap<&'static str, (usize, usize)>,
    object: String,
    group: String,
    material: String,
    /// The part that faces go to, if that is known.
    place: Option<usize>,
    places: HashMap<[String; 3], usize>,
    /// The largest numbers of vertices that were still to come, with their lines and corners.
    ahead: [Option<(usize, usize, String)>; 3],
}

/// Statements that describe no polygon. All others are unknown.
const CURVES: [&str; 21] = [
    "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp",
    "end", "con", "bsp", "bzp", "cdc", "cdp", "res", "ctech",
];
/// Statements that change looks, or nothing at all.
const LOOKS: [&str; 12] = [
    "s",
    "mg",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "usemap",
    "maplib",
    "shadow_obj",
    "trace_obj",
    "stech",
    "csh",
];

impl Parser {
    /// Reads a file; a line that ends in a backslash goes on in the next.
    pub(super) fn read(text: &str) -> Result<Self, Problem> {
        let mut parser = Self::default();
        let mut begun = String::new();
        for (number, line) in (1..).zip(lines(text)) {
            let line = without_comment(line);
            if let Some(part) = line.trim_end().strip_suffix('\\') {
                begun.push_str(part);
                begun.push(' ');
            } else if begun.is_empty() {
                parser.line(line, number)?;
            } else {
                begun.push_str(line);
                parser.line(&std::mem::take(&mut begun), number)?;
            }
        }
        parser.line(&begun, lines(text).count())?;
        parser.check_ahead()?;
        Ok(parser)
    }

    fn line(&mut self, line: &str, number: usize) -> Result<(), Problem> {
        let line = line.trim_matches(|c: char| c.is_whitespace() || c == BOM);
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        match keyword {
            "" => {}
            "v" => self.position(rest, number)?,
            "vn" => {
                let normal = first(&Numbers::read(rest, number, keyword)?, number, keyword)?.as_vec3();
                if !normal.is_finite() {
                    self.leave_out(
                        "normals that are no finite numbers are made anew from the triangles",
                        number,
                    );
                }
                self.normals.push(if normal.is_finite() { normal } else { Vec3::ZERO });
            }
            "vt" => {
                let numbers = Numbers::read(rest, number, keyword)?;
                let [u, v] = [numbers.at(0), numbers.at(1)];
                let finite = u.is_finite() && v.is_finite();
                if !finite {
                    self.leave_out("texture coordinates that are no finite numbers are taken as 0", number);
                }
                // OBJ puts v = 0 at the bottom of the image, scenes at the top.
                self.uvs.push(if finite { Vec2::new(u as f32, 1.0 - v as f32) } else { Vec2::Y });
            }
            "f" | "fo" => self.face(rest, number)?,
            "o" | "g" | "usemtl" => self.begin(keyword, rest),
            "mtllib" => self.libraries.push(rest.into()),
            "p" | "l" => self.leave_out("points and lines are left out, as they have no area", number),
            "call" => self.leave_out("files that 'call' names are not read", number),
            _ if CURVES.contains(&keyword) => {
                self.leave_out(
                    "statements of curved surfaces are left out; export polygons to see them",
                    number,
                );
            }
            _ if LOOKS.contains(&keyword) => {}
            _ if keyword.contains(|c: char| c.is_ascii_uppercase()) => {
                return self.line(&format!("{} {rest}", keyword.to_ascii_lowercase()), number);
            }
            _ => self.leave_out("lines begin with unknown words and are left out", number),
        }
        Ok(())
    }

    fn begin(&mut self, keyword: &str, name: &str) {
        let current = match keyword {
            "o" => {
                self.group.clear();
                &mut self.object
            }
            "g" => &mut self.group,
            _ => &mut self.material,
        };
        if current != name {
            *current = name.into();
        }
        self.place = None;
    }

    fn leave_out(&mut self, what: &'static str, line: usize) {
        self.left_out.entry(what).or_insert((0, line)).0 += 1;
    }

    /// What was left out, one sentence for each kind.
    pub(super) fn notes(&self) -> impl Iterator<Item = String> {
        self.left_out.iter().map(|(what, (count, line))| format!("{count} {what} (line {line} first)"))
    }

    fn position(&mut self, rest: &str, line: usize) -> Result<(), Problem> {
        let numbers = Numbers::read(rest, line, "v")?;
        let position = first(&numbers, line, "v")?;
        if let Some(place) = (0..3).find(|k| !position[*k].is_finite()) {
            return Err(not_finite(rest.split_whitespace().nth(place).unwrap_or_default(), line, "v"));
        }
        // Six or more numbers: a colour follows the position. Four: a weight, which polygons have no use for.
        if numbers.count >= 6 {
            let color = Vec3::from_array([3, 4, 5].map(|k| numbers.at(k) as f32));
            self.colors.resize(self.positions.len(), Vec3::ONE);
            self.colors.push(if color.is_finite() { color } else { Vec3::ONE });
        } else if numbers.count == 4 && numbers.at(3) != 1.0 {
            self.leave_out("weights of positions are left out, as they count for curves alone", line);
        }
        self.positions.push(position);
        Ok(())
    }

    fn face(&mut self, corners: &str, line: usize) -> Result<(), Problem> {
        let place = self.part();
        let before = self.parts[place].corners.len();
        for word in corners.split_whitespace() {
            let corner = self.corner(word, line)?;
            let part = &mut self.parts[place];
            part.lacks_normals |= corner[2] == NONE;
            part.corners.push(corner);
        }
        let part = &mut self.parts[place];
        let count = part.corners.len() - before;
        if count < 3 {
            part.corners.truncate(before);
            self.leave_out("faces of fewer than three corners are left out", line);
        } else {
            part.faces.push(count as u32);
        }
        Ok(())
    }

    /// The part that faces go to now.
    fn part(&mut self) -> usize {
        if let Some(place) = self.place {
            return place;
        }
        let key = [&self.object, &self.group, &self.material].map(Clone::clone);
        let next = self.parts.len();
        let place = *self.places.entry(key).or_insert(next);
        if place == next {
            self.parts.push(Part {
                object: self.object.clone(),
                group: self.group.clone(),
                material: self.material.clone(),
                ..Part::default()
            });
        }
        self.place = Some(place);
        place
    }

    /// The numbers, from 0, of a corner such as `3/1/2`, `3//2`, `3/1` or `-1`.
    fn corner(&mut self, corner: &str, line: usize) -> Result<[u32; 3], Problem> {
        let mut numbers = [NONE; 3];
        for (k, text) in corner.split('/').enumerate().filter(|(_, text)| !text.is_empty()) {
            let count = self.counts().get(k).copied().unwrap_or(0);
            let place = text.parse::<i64>().ok().and_then(|number| match number {
                1.. => usize::try_from(number - 1).ok(),
                0 => None,
                _ => count.checked_sub(usize::try_from(number.unsigned_abs()).ok()?),
            });
            let Some(place) = place.filter(|place| k < 3 && *place < NONE as usize) else {
                return Err(no_vertex(text, corner, line, count));
            };
            if place >= count && self.ahead[k].as_ref().is_none_or(|(max, ..)| place > *max) {
                self.ahead[k] = Some((place, line, corner.into()));
            }
            numbers[k] = place as u32;
        }
        if numbers[0] == NONE {
            let allowed = "it must begin with the number of a position";
            return Err(invalid(format!("line {line}: corner"), format!("'{corner}'"), allowed));
        }
        Ok(numbers)
    }

    fn counts(&self) -> [usize; 3] {
        [self.positions.len(), self.uvs.len(), self.normals.len()]
    }

    /// Faces may come before their vertices, but those must come.
    fn check_ahead(&mut self) -> Result<(), Problem> {
        if !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), Vec3::ONE);
        }
        for (ahead, count) in self.ahead.iter().zip(self.counts()) {
            if let Some((place, line, corner)) = ahead
                && *place >= count
            {
                return Err(no_vertex(&(place + 1).to_string(), corner, *line, count));
            }
        }
        Ok(())
    }
}

fn no_vertex(text: &str, corner: &str, line: usize, count: usize) -> Problem {
    let element = format!("line {line}: '{text}' of corner {corner}");
    let allowed = match count {
        0 => "the file has no such vertices up to here".into(),
        _ => format!("allowed here are 1 to {count} and -1 to -{count}"),
    };
    invalid(element, "no vertex", allowed)
}

/// The lines of a text, whichever of the three systems wrote it.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    // Where lines end in two characters, there is an empty one between: the number counts line feeds.
    let separator = if text.contains('\n') { '\n' } else { '\r' };
    text.split(separator)
}

/// A comment begins with a # that is not within a word.
fn without_comment(line: &str) -> &str {
    let begins = |(at, _): &(usize, &str)| {
        line[..*at].chars().next_back().is_none_or(|c| c.is_whitespace() || c == BOM)
    };
    match line.match_indices('#').find(begins) {
        Some((at, _)) => &line[..at],
        None => line,
    }
}

/// The first eight numbers of a line, and how many there are.
#[derive(Debug)]
struct Numbers {
    values: [f64; 8],
    count: usize,
}

impl Numbers {
    /// Numbers that are not finite are left to the caller.
    fn read(text: &str, line: usize, keyword: &str) -> Result<Self, Problem> {
        let mut numbers = Self { values: [0.0; 8], count: 0 };
        for word in text.split_whitespace() {
            let value = number(word).ok_or_else(|| not_finite(word, line, keyword))?;
            if let Some(place) = numbers.values.get_mut(numbers.count) {
                *place = value;
            }
            numbers.count += 1;
        }
        Ok(numbers)
    }

    /// 0 where there is none.
    fn at(&self, place: usize) -> f64 {
        self.values[place]
    }
}

/// Also the exponents of Fortran and what C libraries print for what is no number.
fn number(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| {
        let lower = word.to_ascii_lowercase();
        let name = lower.trim_start_matches(['-', '+']);
        if name.starts_with("nan") || name.starts_with("1.#") {
            return Some(f64::NAN);
        }
        lower.replace('d', "e").parse().ok()
    })
}

fn not_finite(word: &str, line: usize, keyword: &str) -> Problem {
    let allowed = if word.contains(',') {
        "it must be a finite number with a decimal point; replace commas by points"
    } else {
        "it must be finite"
    };
    invalid(format!("line {line}: number of '{keyword}'"), format!("'{word}'"), allowed)
}

/// The first three numbers of a line.
fn first(numbers: &Numbers, line: usize, keyword: &str) -> Result<DVec3, Problem> {
    if numbers.count >= 3 {
        return Ok(DVec3::new(numbers.at(0), numbers.at(1), numbers.at(2)));
    }
    let found = format!("{} numbers long", numbers.count);
    Err(invalid(format!("line {line}: '{keyword}'"), found, "it needs at least 3"))
}
