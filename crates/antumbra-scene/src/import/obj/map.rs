//! Maps of a material library: which file, and how it lies on a surface.

use glam::Vec2;

/// A map as a library names it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Map {
    pub(super) file: String,
    /// How often the image repeats, and where it begins: u and v of the file times the first, plus the
    /// second.
    pub(super) scale: Vec2,
    pub(super) offset: Vec2,
    /// Whether the image repeats.
    pub(super) repeats: bool,
    /// The channel of a mask: `r`, `g`, `b`, `m` (matte, which is alpha) or `l` (luminance).
    pub(super) channel: Option<char>,
}

impl Map {
    /// Reads what stands behind `map_Kd` and the like: options, then the name of a file, blanks included.
    pub(super) fn read(text: &str) -> Self {
        let mut map =
            Self { file: String::new(), scale: Vec2::ONE, offset: Vec2::ZERO, repeats: true, channel: None };
        let mut rest = text.trim();
        while let Some((option, after)) = word(rest).filter(|(option, _)| option.starts_with('-')) {
            let option = option.to_ascii_lowercase();
            let (min, max) = match option.as_str() {
                "-s" | "-o" | "-t" => (1, 3),
                "-mm" => (2, 2),
                "-blendu" | "-blendv" | "-cc" | "-clamp" | "-bm" | "-boost" | "-texres" | "-imfchan"
                | "-type" => (1, 1),
                _ => break, // A name that begins with a hyphen.
            };
            let mut values = Vec::new();
            rest = after;
            while let Some((value, after)) = word(rest)
                .filter(|(value, _)| values.len() < min || values.len() < max && value.parse::<f32>().is_ok())
            {
                values.push(value);
                rest = after;
            }
            map.set(&option, &values);
        }
        map.file = unquoted(rest).into();
        map
    }

    fn set(&mut self, option: &str, values: &[&str]) {
        let number = |k: usize, otherwise: f32| {
            let value = values.get(k).and_then(|v| v.parse().ok()).filter(|v: &f32| v.is_finite());
            value.unwrap_or(otherwise)
        };
        let first = values.first().copied().unwrap_or_default().to_ascii_lowercase();
        match option {
            "-s" => self.scale = Vec2::new(number(0, 1.0), number(1, 1.0)),
            "-o" => self.offset = Vec2::new(number(0, 0.0), number(1, 0.0)),
            "-clamp" => self.repeats = first != "on",
            "-imfchan" => self.channel = first.chars().next(),
            _ => {}
        }
    }

    /// A scene's texture coordinates, whose v points down, where this map is.
    pub(super) fn place(&self, uv: Vec2) -> Vec2 {
        if (self.scale, self.offset) == (Vec2::ONE, Vec2::ZERO) {
            return uv;
        }
        let turned = Vec2::new(uv.x, 1.0 - uv.y) * self.scale + self.offset;
        Vec2::new(turned.x, 1.0 - turned.y)
    }

    /// Whether another map lies on a surface as this one does.
    pub(super) fn lies_as(&self, other: &Self) -> bool {
        (self.scale, self.offset, self.repeats) == (other.scale, other.offset, other.repeats)
    }
}

/// The first word and what follows it.
fn word(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (end > 0).then(|| (&text[..end], text[end..].trim_start()))
}

/// A name without the quotation marks that some programs put around it.
pub(super) fn unquoted(name: &str) -> &str {
    let name = name.trim();
    name.strip_prefix('"').and_then(|name| name.strip_suffix('"')).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_come_before_names_with_blanks() {
        let plain = Map::read("leaf.png");
        assert_eq!((plain.file.as_str(), plain.scale, plain.repeats), ("leaf.png", Vec2::ONE, true));
        let map = Map::read("-s 3 2 1 -o 0.5 -clamp on -imfchan M -mm 0 1 -BM 2 my leaf.png");
        assert_eq!(map.file, "my leaf.png");
        assert_eq!((map.scale, map.offset), (Vec2::new(3.0, 2.0), Vec2::new(0.5, 0.0)));
        assert_eq!((map.repeats, map.channel), (false, Some('m')));
        assert_eq!(Map::read("-s 3 leaf.png").file, "leaf.png");
        assert_eq!(Map::read("-leaf.png").file, "-leaf.png");
        assert_eq!(Map::read("\"C:\\my maps\\leaf.png\"").file, "C:\\my maps\\leaf.png");
        assert_eq!(Map::read("-s").file, "");
    }

    #[test]
    fn v_points_up_in_the_file() {
        let map = Map::read("-s 2 3 -o 0.25 0.5 a.png");
        // The lower left corner of the file, (0, 0), is sampled at (0.25, 0.5).
        assert_eq!(map.place(Vec2::new(0.0, 1.0)), Vec2::new(0.25, 0.5));
        assert_eq!(map.place(Vec2::new(1.0, 0.0)), Vec2::new(2.25, 1.0 - 3.5));
    }
}
