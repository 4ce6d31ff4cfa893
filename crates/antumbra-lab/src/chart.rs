//! Curves in panels, as SVG or PNG from one layout.

use crate::{
    axis::Axis,
    image::{ImageError, Rgba8Image},
    paint::{self, Anchor, Colour, INK, Letters, WHITE},
    report::escape,
};
use std::fmt::Write;

/// One line of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name in the legend.
    pub name: String,
    /// What it joins, in the axes' units.
    pub points: Vec<[f64; 2]>,
}

/// Curves over common axes, with a legend below.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Curves in the order of the legend; earlier ones are drawn broader, so that equal ones stay visible.
    pub curves: Vec<Curve>,
    /// Left and right end.
    pub x: [f64; 2],
    /// Lower and upper end; what lies beyond is cut off.
    pub y: [f64; 2],
    /// What the horizontal axis measures, with its unit.
    pub x_label: String,
    /// What the vertical axis measures, with its unit.
    pub y_label: String,
}

/// Units of the layout; a unit is a pixel of the SVG at its natural size.
const WIDTH: f64 = 560.0;
const PLOT: f64 = 300.0;
const LEFT: f64 = 46.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 34.0;
const BELOW: f64 = 46.0;
const LINE: f64 = 17.0;
/// Pixels of a PNG per unit.
const SCALE: f64 = 2.0;

const GRID: Colour = [222, 224, 220];
const QUIET: Colour = [90, 98, 108];
/// Told apart with the common colour deficiencies too [Okabe and Ito 2002].
const COLOURS: [Colour; 8] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [0, 0, 0],
    [128, 128, 128],
];

/// Where a layout is drawn.
trait Surface {
    fn lines(&mut self, points: &[[f64; 2]], width: f64, colour: Colour);
    fn text(&mut self, at: [f64; 2], anchor: Anchor, text: &str, colour: Colour);
}

/// An SVG document that needs no style and no script.
#[must_use]
pub fn svg(panels: &[Panel]) -> String {
    let [width, height] = size(panels);
    let mut surface = Svg(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" \
         height=\"{height}\" fill=\"white\"/>\n"
    ));
    draw(&mut surface, panels);
    surface.0 + "</svg>\n"
}

/// The same as an image, two pixels per unit of the SVG.
///
/// # Errors
/// [`ImageError::Png`].
pub fn png(panels: &[Panel]) -> Result<Vec<u8>, ImageError> {
    let [width, height] = size(panels).map(|units| (SCALE * units).ceil() as u32);
    let mut surface = paint::blank(width.max(1), height.max(1), WHITE);
    draw(&mut surface, panels);
    surface.to_png()
}

/// Side by side, in about as many rows as columns.
fn columns(panels: &[Panel]) -> usize {
    (panels.len() as f64).sqrt().ceil().max(1.0) as usize
}

/// All panels are as high as the one with the longest legend.
fn panel_height(panels: &[Panel]) -> f64 {
    let lines = panels.iter().map(|p| p.curves.len()).max().unwrap_or(0);
    TOP + PLOT + BELOW + LINE * lines as f64 + 6.0
}

fn size(panels: &[Panel]) -> [f64; 2] {
    let columns = columns(panels);
    let rows = panels.len().div_ceil(columns);
    [columns as f64 * WIDTH, rows as f64 * panel_height(panels)]
}

fn draw(surface: &mut dyn Surface, panels: &[Panel]) {
    let (columns, height) = (columns(panels), panel_height(panels));
    for (i, panel) in panels.iter().enumerate() {
        let corner = [(i % columns) as f64 * WIDTH, (i / columns) as f64 * height];
        draw_panel(surface, panel, corner);
    }
}

fn draw_panel(surface: &mut dyn Surface, panel: &Panel, [left, top]: [f64; 2]) {
    let (west, east) = (left + LEFT, left + WIDTH - RIGHT);
    let (north, south) = (top + TOP, top + TOP + PLOT);
    let x = Axis::linear(panel.x, [west, east]);
    let y = Axis::linear(panel.y, [south, north]);
    for (at, text) in x.ticks() {
        surface.lines(&[[at, north], [at, south]], 1.0, GRID);
        surface.text([at, south + 13.0], Anchor::Middle, &text, QUIET);
    }
    for (at, text) in y.ticks() {
        surface.lines(&[[west, at], [east, at]], 1.0, GRID);
        surface.text([west - 6.0, at], Anchor::End, &text, QUIET);
    }
    surface.lines(&[[west, north], [west, south], [east, south]], 1.0, QUIET);
    surface.text([west, north - 16.0], Anchor::Start, &panel.y_label, INK);
    surface.text([f64::midpoint(west, east), south + 31.0], Anchor::Middle, &panel.x_label, INK);
    let inside = |p: &[f64; 2]| {
        let cut = |v: f64, [low, high]: [f64; 2]| v.clamp(low.min(high), low.max(high));
        [x.place(cut(p[0], panel.x)), y.place(cut(p[1], panel.y))]
    };
    for (i, curve) in panel.curves.iter().enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        // Earlier ones show on both sides of later ones that lie upon them.
        let width = 1.5 + 4.0 * (1.0 - (i + 1) as f64 / panel.curves.len() as f64);
        let points: Vec<[f64; 2]> = curve.points.iter().map(inside).collect();
        surface.lines(&points, width, colour);
        let row = south + BELOW + LINE * (i as f64 + 0.5);
        surface.lines(&[[west, row], [west + 26.0, row]], width.min(4.0), colour);
        surface.text([west + 34.0, row], Anchor::Start, &curve.name, INK);
    }
}

struct Svg(String);

impl Surface for Svg {
    fn lines(&mut self, points: &[[f64; 2]], width: f64, [r, g, b]: Colour) {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
        let _ = writeln!(
            self.0,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"rgb({r},{g},{b})\" stroke-width=\"{width:.2}\" stroke-linejoin=\"round\"/>",
            points.join(" ")
        );
    }
    fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, text: &str, [r, g, b]: Colour) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let _ = writeln!(
            self.0,
            "<text x=\"{x:.2}\" y=\"{:.2}\" text-anchor=\"{anchor}\" fill=\"rgb({r},{g},{b})\">{}</text>",
            y + 4.0,
            escape(text)
        );
    }
}

impl Surface for Rgba8Image {
    fn lines(&mut self, points: &[[f64; 2]], width: f64, colour: Colour) {
        let points: Vec<[f64; 2]> = points.iter().map(|p| p.map(|v| SCALE * v)).collect();
        paint::lines(self, &points, SCALE * width, colour);
    }
    fn text(&mut self, at: [f64; 2], anchor: Anchor, text: &str, colour: Colour) {
        paint::text(self, at.map(|v| (SCALE * v).round() as i32), anchor, text, Letters::Large, colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(curves: usize) -> Panel {
        let curve = |i: usize| Curve {
            name: format!("<curve> {i}"),
            points: vec![[-1.0, 0.1 * i as f64], [0.0, 5.0], [1.0, 0.5]],
        };
        Panel {
            curves: (0..curves).map(curve).collect(),
            x: [-1.0, 1.0],
            y: [0.0, 1.0],
            x_label: "across & along".into(),
            y_label: "up".into(),
        }
    }

    #[test]
    fn an_svg_names_everything_and_stays_inside() {
        let text = svg(&[panel(3), panel(1)]);
        for word in ["&lt;curve&gt; 2", "across &amp; along", ">up<", "viewBox=\"0 0 1120 "] {
            assert!(text.contains(word), "{word}");
        }
        let height = panel_height(&[panel(3)]);
        let points = text.lines().filter_map(|l| l.split_once("points=\"")?.1.split_once('"'));
        for point in points.flat_map(|(points, _)| points.split(' ')) {
            let (x, y) = point.split_once(',').unwrap();
            let [x, y]: [f64; 2] = [x.parse().unwrap(), y.parse().unwrap()];
            assert!((0.0..=1120.0).contains(&x) && (0.0..=height).contains(&y), "{point}");
        }
    }

    #[test]
    fn a_png_shows_each_colour() {
        let [width, height] = size(&[panel(2)]).map(|units| (SCALE * units) as u32);
        let mut image = paint::blank(width, height, WHITE);
        draw(&mut image, &[panel(2)]);
        for [r, g, b] in &COLOURS[..2] {
            let pixels = image.rgba.chunks_exact(4).filter(|p| p[..3] == [*r, *g, *b]).count();
            assert!(pixels > 500, "{pixels}");
        }
        assert!(png(&[panel(2)]).unwrap().starts_with(b"\x89PNG"));
        assert!(!png(&[]).unwrap().is_empty());
    }
}
