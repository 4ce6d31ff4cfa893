//! Plain text tables.

use std::io::{self, Write};

/// Columns padded to their widest cell; numbers, which begin with a digit, to the right. The last cell of a
/// row with fewer cells than columns goes across the rest.
pub(crate) fn print(out: &mut impl Write, header: &[&str], rows: &[Vec<String>]) -> io::Result<()> {
    let column = |c: usize| {
        rows.iter().filter(move |r| c == 0 || r.len() == header.len()).filter_map(move |r| r.get(c))
    };
    let width = |c: usize| {
        let cells = column(c).map(|cell| cell.chars().count());
        cells.chain([header[c].chars().count()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let numeric =
        |c: usize| column(c).all(|cell| cell.starts_with(|ch: char| ch.is_ascii_digit() || ch == '-'));
    let numeric: Vec<bool> = (0..header.len()).map(numeric).collect();
    let mut line = |cells: Vec<&str>| {
        let whole = cells.len() == header.len();
        let padded = cells.iter().enumerate().map(|(c, cell)| match numeric[c] && (whole || c == 0) {
            true => format!("{cell:>0$}", widths[c]),
            false => format!("{cell:<0$}", widths[c]),
        });
        let text = padded.collect::<Vec<_>>().join("  ");
        writeln!(out, "{}", text.trim_end())
    };
    line(header.to_vec())?;
    for row in rows {
        line(row.iter().map(String::as_str).collect())?;
    }
    Ok(())
}
