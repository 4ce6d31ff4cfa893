//! Plain text tables that fit the terminal.
//!
//! A table that is too wide first breaks its headings at spaces, then the text of its last column, and at
//! last continues its columns in further blocks, each with the first column again. Where standard output is
//! no terminal, tables are as wide as their cells.

use std::io::{self, IsTerminal, Write};

/// Space between columns.
const GAP: usize = 2;
/// Least width to which the text of a last column is broken.
const MIN_TEXT: usize = 24;

/// Columns padded to their widest cell; numbers, which begin with a digit, to the right. The second cell of a
/// row with fewer cells than columns goes across the rest.
pub(crate) fn print(out: &mut impl Write, header: &[&str], rows: &[Vec<String>]) -> io::Result<()> {
    write(out, header, rows, width())
}

/// Columns of the terminal on standard output; `usize::MAX` where there is none.
fn width() -> usize {
    let stdout = io::stdout();
    let size = stdout.is_terminal().then(|| terminal_size::terminal_size_of(&stdout)).flatten();
    size.map_or(usize::MAX, |(width, _)| usize::from(width.0))
}

/// A column with its cells, each of one line or several.
struct Column {
    header: Vec<String>,
    cells: Vec<Vec<String>>,
    numeric: bool,
}

impl Column {
    fn new(header: &str, cells: &[String]) -> Self {
        let starts_numeric =
            |cell: &String| cell.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '–');
        Self {
            header: vec![header.to_string()],
            cells: cells.iter().map(|cell| vec![cell.clone()]).collect(),
            numeric: cells.iter().filter(|cell| !cell.is_empty()).all(starts_numeric),
        }
    }

    fn width(&self) -> usize {
        let lines = self.cells.iter().flatten().chain(&self.header);
        lines.map(|line| line.chars().count()).max().unwrap_or(0)
    }

    /// One line per word, as far as the cells are not as wide anyhow.
    fn break_header(&mut self) {
        let cells = self.cells.iter().flatten().map(|line| line.chars().count()).max().unwrap_or(0);
        let longest =
            self.header.iter().flat_map(|line| line.split(' ')).map(|word| word.chars().count()).max();
        self.header = broken(&self.header.join(" "), cells.max(longest.unwrap_or(0)));
    }

    fn break_cells(&mut self, width: usize) {
        for cell in &mut self.cells {
            *cell = broken(&cell.join(" "), width);
        }
    }

    fn padded(&self, line: Option<&String>) -> String {
        let line = line.map_or("", String::as_str);
        if self.numeric { format!("{line:>0$}", self.width()) } else { format!("{line:<0$}", self.width()) }
    }
}

/// A text in lines of at most `width` characters, broken at spaces; longer words stay whole. Leading spaces
/// are kept.
fn broken(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let body = text.trim_start();
    let mut line = " ".repeat(text.len() - body.len());
    let mut empty = true;
    for word in body.split(' ') {
        if !empty && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(std::mem::take(&mut line));
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    lines.push(line);
    lines
}

fn write(out: &mut impl Write, header: &[&str], rows: &[Vec<String>], width: usize) -> io::Result<()> {
    let whole = |row: &Vec<String>, c: usize| c == 0 || row.len() == header.len();
    let cells = |c: usize| {
        let cell = |row: &Vec<String>| row.get(c).filter(|_| whole(row, c)).cloned().unwrap_or_default();
        rows.iter().map(cell).collect::<Vec<_>>()
    };
    let across = |row: &Vec<String>| row.get(1).filter(|_| !whole(row, 1)).cloned();
    let across: Vec<Option<String>> = rows.iter().map(across).collect();
    let mut columns: Vec<Column> =
        header.iter().enumerate().map(|(c, header)| Column::new(header, &cells(c))).collect();
    let total = |columns: &[Column]| columns.iter().map(|column| column.width() + GAP).sum::<usize>() - GAP;
    if total(&columns) > width {
        columns.iter_mut().for_each(Column::break_header);
    }
    let all = total(&columns);
    // Alone beside the first column it may be broken further.
    let alone = width.saturating_sub(columns[0].width() + GAP);
    if let Some(last) = columns.last_mut().filter(|last| all > width && !last.numeric) {
        last.break_cells(width.saturating_sub(all - last.width()).max(MIN_TEXT.min(alone)));
    }
    let mut first = 1;
    for end in blocks(&columns, width) {
        if first > 1 {
            writeln!(out)?;
        }
        let shown: Vec<&Column> = columns[..1].iter().chain(&columns[first..end]).collect();
        let beside = width.saturating_sub(columns[0].width() + GAP).max(1);
        let across =
            across.iter().map(|text| text.iter().filter(|_| first == 1).flat_map(|t| broken(t, beside)));
        block(out, &shown, &across.map(Iterator::collect).collect::<Vec<_>>())?;
        first = end;
    }
    Ok(())
}

/// Ends of the runs of columns that fit beside the first one.
fn blocks(columns: &[Column], width: usize) -> Vec<usize> {
    let mut ends = Vec::new();
    let mut used = columns[0].width();
    for (i, column) in columns.iter().enumerate().skip(1) {
        let needed = GAP + column.width();
        let is_first = used == columns[0].width();
        if used + needed > width && !is_first {
            ends.push(i);
            used = columns[0].width();
        }
        used += needed;
    }
    ends.push(columns.len());
    ends
}

/// Headings and rows of some columns, each row with the lines of text that stand behind its first cell
/// instead.
fn block(out: &mut impl Write, columns: &[&Column], across: &[Vec<String>]) -> io::Result<()> {
    let line = |cells: Vec<Option<&String>>| {
        let padded: Vec<String> =
            columns.iter().zip(cells).map(|(column, cell)| column.padded(cell)).collect();
        padded.join(&" ".repeat(GAP)).trim_end().to_string()
    };
    // Headings stand on the lowest of their lines.
    let height = columns.iter().map(|column| column.header.len()).max().unwrap_or(0);
    for i in 0..height {
        let at = |column: &&Column| (i + column.header.len()).checked_sub(height);
        writeln!(out, "{}", line(columns.iter().map(|c| at(c).and_then(|at| c.header.get(at))).collect()))?;
    }
    for (row, across) in across.iter().enumerate() {
        for (i, text) in across.iter().enumerate() {
            let head = columns[0].padded(columns[0].cells[row].get(i));
            writeln!(out, "{head}{}{text}", " ".repeat(GAP))?;
        }
        let whole = across.is_empty();
        let height = columns.iter().filter(|_| whole).map(|column| column.cells[row].len()).max();
        for i in 0..height.unwrap_or(0) {
            writeln!(out, "{}", line(columns.iter().map(|column| column.cells[row].get(i)).collect()))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(width: usize) -> Vec<String> {
        let header = ["technique", "RMSE light space", "frame ms", "meaning"];
        let row = |cells: [&str; 4]| cells.map(String::from).to_vec();
        let rows = [
            row(["hard", "0.2061", "12.0", "one comparison for each pixel, without any filter"]),
            row(["- basis", "", "", ""]),
            vec!["dpm".into(), "left out: it needs 5 storage buffers".into()],
            row(["evsm", "0.0790", "9.5", "moments of two exponentials"]),
        ];
        let mut out = Vec::new();
        write(&mut out, &header, &rows, width).unwrap();
        String::from_utf8(out).unwrap().lines().map(String::from).collect()
    }

    #[test]
    fn a_wide_terminal_has_one_line_a_row() {
        let all = lines(200);
        assert_eq!(all.len(), 5);
        assert_eq!(all[3], "dpm        left out: it needs 5 storage buffers");
        assert!(all[0].starts_with("technique  RMSE light space  frame ms  meaning"), "{}", all[0]);
        assert!(all[1].contains("          0.2061      12.0  one comparison"), "{}", all[1]);
    }

    #[test]
    fn narrower_ones_break_headings_text_and_at_last_columns() {
        for width in [30, 36, 44, 60, 80] {
            let all = lines(width);
            assert!(all.iter().all(|line| line.chars().count() <= width), "{width}: {all:#?}");
            let text = all.join(" ");
            for word in ["light", "frame", "comparison", "filter", "0.0790", "9.5", "exponentials"] {
                assert!(text.contains(word), "{width}: {word}");
            }
        }
        assert!(lines(60)[0].contains("RMSE") && !lines(60)[0].contains("technique"));
        assert_eq!(lines(30).iter().filter(|line| line.starts_with("hard")).count(), 2);
    }
}
