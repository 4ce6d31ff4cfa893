//! Pages that open by a double click: pictures and style are inside.

use crate::{
    catalogue::{SOURCES, source_of},
    page::{Block, Cell, Page, Pictures, Table, Tile, Unit},
    results::{Record, Reproduction},
    target::{Source, Target},
    verdict::{Outcome, number},
};
use antumbra_lab::{
    chart,
    report::{STYLE, bytes, escape},
};
use base64::{Engine, engine::general_purpose::STANDARD};

mod matrix;
mod verdicts;

use verdicts::{facts, lines, list};

const OWN_STYLE: &str = include_str!("html/page.css");
const SCRIPT: &str = include_str!("html/sort.js");

/// The page of one target.
#[must_use]
pub fn page(target: &Target, page: &Page, record: &Record, results: &Reproduction) -> String {
    let source = source_of(target).map_or("", |s| s.name);
    let blocks: String = page.blocks.iter().map(block).collect();
    let mut note = format!("<p class=\"quiet\">{}</p>", escape(&machine(results)));
    if record.quick {
        note.insert_str(0, QUICK);
    }
    let body = format!(
        "<header><p class=\"kicker\"><a href=\"index.html\">All pages</a> · {kicker}</p><h1>{title}</h1></header>\n\
         <main>\n<section class=\"verdicts\" aria-label=\"Verdicts\">{verdicts}</section>{facts}\n\
         <section class=\"pair\"><div><h3>What the source did</h3><p>{paper}</p></div>\
         <div><h3>What we ran</h3><p>{ours}</p></div></section>{note}\n\
         <section>{blocks}</section>\n</main>\n{footer}",
        kicker = escape(&format!("{source} · {}", target.id)),
        title = escape(target.title),
        verdicts = list(&record.verdicts),
        facts = facts(&record.facts),
        paper = escape(target.paper),
        ours = escape(target.ours),
        footer = footer(results, &format!("antumbra reproduce {}", target.id)),
    );
    document(target.title, &body)
}

const QUICK: &str = "<p class=\"warning\">A quick run: pictures and maps have a quarter of their size each way \
     and times are of one frame. It shows that everything works; its verdicts are not the program's.</p>";

/// The page that leads to all others.
#[must_use]
pub fn index(results: &Reproduction) -> String {
    let all = |outcome| results.targets.iter().map(|r| r.count(outcome)).sum::<usize>();
    let [holds, differs, open] = [Outcome::Holds, Outcome::Differs, Outcome::Open].map(all);
    let others = results.targets.iter().flat_map(|r| &r.verdicts).filter(|v| !v.source.is_of_a_document());
    let mut answer = format!(
        "<p>{} claims of the documents were tried: {holds} hold, {differs} differ{}. {}</p>",
        holds + differs + open,
        if open > 0 {
            format!(", {open} {} open", if open == 1 { "is" } else { "are" })
        } else {
            String::new()
        },
        others_say(others.count())
    );
    if results.targets.iter().any(|r| r.quick) {
        answer += QUICK;
    }
    let groups: String = SOURCES.iter().map(|source| group(source, results)).collect();
    let body = format!(
        "<header><p class=\"kicker\">antumbra · the experiments of the papers, run again</p><h1>Reproduction</h1>\
         </header>\n<main>\n<section class=\"answer\">{answer}</section><p class=\"quiet\">{}</p>\n{groups}</main>\n{}",
        escape(&machine(results)),
        footer(results, "antumbra reproduce all")
    );
    document("Reproduction", &body)
}

fn others_say(count: usize) -> String {
    if count == 0 { String::new() } else { format!("{count} more claims are ours and not counted.") }
}

fn group(source: &Source, results: &Reproduction) -> String {
    let rows: String = source
        .targets
        .iter()
        .filter_map(|t| results.targets.iter().find(|r| r.id == t.id))
        .map(|record| {
            let lines = match record.verdicts.is_empty() {
                true => "<td class=\"none\">numbers only</td>".into(),
                false => format!("<td>{}</td>", lines(&record.verdicts)),
            };
            format!(
                "<tr><th scope=\"row\"><a href=\"{}\">{}</a><code>{}</code></th>{lines}</tr>\n",
                escape(&record.file),
                escape(&record.title),
                escape(&record.id)
            )
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "<section><h2>{}</h2><div class=\"scroll\"><table class=\"index\"><tbody>{rows}</tbody></table></div></section>\n",
        escape(source.name)
    )
}

fn machine(results: &Reproduction) -> String {
    let adapter = &results.adapter;
    let soft = if adapter.device_type == "cpu" {
        " It is a software rasteriser: ratios between techniques tell of work on this processor, not on a graphics card."
    } else {
        ""
    };
    format!("Measured on {}, {}.{soft}", adapter.name, adapter.driver)
}

fn footer(results: &Reproduction, command: &str) -> String {
    format!(
        "<footer><p><code>{}</code> · {} {} · schema <code>{}</code> · the numbers are in \
         <a href=\"results.json\">results.json</a> and <a href=\"results.csv\">results.csv</a></p></footer>",
        escape(command),
        escape(&results.program.name),
        escape(&results.program.version),
        escape(&results.schema)
    )
}

fn document(title: &str, body: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{} · antumbra</title>\n\
         <style>\n{STYLE}\n{OWN_STYLE}</style>\n</head>\n<body>\n{body}\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        escape(title)
    )
}

fn block(block: &Block) -> String {
    match block {
        Block::Text(text) => format!("<p>{}</p>\n", escape(text)),
        Block::Table(it) => table(it),
        Block::Pictures(it) => pictures(it),
        Block::Plot(panels, caption) => format!(
            "<figure class=\"plot\">{}<figcaption>{}</figcaption></figure>\n",
            chart::svg(panels),
            escape(caption)
        ),
        Block::Matrix(it) => matrix::table(it),
    }
}

fn table(table: &Table) -> String {
    let head: String = table.head.iter().map(|h| format!("<th scope=\"col\">{}</th>", escape(h))).collect();
    let row = |row: &crate::page::Row| {
        let cells: String = row.cells.iter().map(cell).collect();
        format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", escape(&row.name))
    };
    let rows: String = table.rows.iter().map(row).collect();
    let both = table.rows.iter().any(|r| r.cells.iter().any(|c| c.paper.is_some()));
    let key = if both { " Below each of our numbers: the paper's, and ours over it." } else { "" };
    format!(
        "<figure class=\"numbers\"><figcaption>{}{key}</figcaption><div class=\"scroll\" tabindex=\"0\"><table><thead><tr>{head}</tr></thead>\
         <tbody>{rows}</tbody></table></div></figure>\n",
        escape(&table.caption)
    )
}

fn cell(cell: &Cell) -> String {
    let ours = match cell.ours {
        Some(value) => write(value, cell.unit),
        None => "<span class=\"none\">–</span>".into(),
    };
    let Some(paper) = cell.paper else { return format!("<td>{ours}</td>") };
    let over = cell.ours.filter(|_| paper != 0.0).map(|v| format!(" · ×{:.2}", v / paper));
    format!("<td><b>{ours}</b><small>{}{}</small></td>", write(paper, cell.unit), over.unwrap_or_default())
}

/// A number with its unit.
fn write(value: f64, unit: Unit) -> String {
    let text = match unit {
        Unit::Number => number(value),
        Unit::Share => format!("{}\u{202f}%", number(100.0 * value)),
        Unit::Times => format!("{value:.2}×"),
        Unit::Milliseconds => format!("{}\u{202f}ms", number(value)),
        Unit::Bytes => bytes(value),
    };
    escape(&text)
}

fn pictures(pictures: &Pictures) -> String {
    let tiles: String = pictures.tiles.iter().map(tile).collect();
    format!(
        "<figure class=\"sheet\"><figcaption>{}</figcaption><div class=\"tiles\" style=\"--columns:{}\">{tiles}</div></figure>\n",
        escape(&pictures.caption),
        pictures.columns
    )
}

fn tile(tile: &Tile) -> String {
    let class = if tile.close_up { " class=\"pixels\"" } else { "" };
    format!(
        "<figure><img{class} alt=\"{caption}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{caption}</figcaption></figure>\n",
        tile.size[0],
        tile.size[1],
        STANDARD.encode(&tile.png),
        caption = escape(&tile.caption),
    )
}
