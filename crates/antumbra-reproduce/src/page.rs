//! A page as data: what it says, its tables with the paper's numbers beside ours, pictures, plots and
//! verdicts. [`crate::html`] shows it; [`crate::results`] keeps its numbers.

use crate::{
    stored_image::StoredImage,
    verdict::{Fact, Verdict},
};
use antumbra_lab::chart::Panel;
use anyhow::Result;
use serde::{Deserialize, Serialize};

/// What a target found.
#[derive(Debug, Clone, Default)]
pub struct Page {
    /// Its parts, from top to bottom.
    pub blocks: Vec<Block>,
    /// What became of the paper's claims.
    pub verdicts: Vec<Verdict>,
    /// What the paper says that cannot come out otherwise.
    pub facts: Vec<Fact>,
}

/// A part of a page.
#[derive(Debug, Clone)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// Numbers.
    Table(Table),
    /// Pictures laid out as in the paper.
    Pictures(Pictures),
    /// Curves, and what they show.
    Plot(Vec<Panel>, String),
    /// Numbers of many things, to be sorted.
    Matrix(Matrix),
}

/// Numbers under headings, beside the paper's where it has them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// What the numbers are.
    pub caption: String,
    /// Headings of the cells; that of the rows' names is first.
    pub head: Vec<String>,
    /// From top to bottom.
    pub rows: Vec<Row>,
}

/// A row of a table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What the row is.
    pub name: String,
    /// One cell for each heading but the first.
    pub cells: Vec<Cell>,
}

/// Our number and the paper's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// What we measured; `None` where it was not measured or does not exist.
    pub ours: Option<f64>,
    /// What the paper says, if anything.
    pub paper: Option<f64>,
    /// What both are in.
    pub unit: Unit,
}

/// How a number is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// As it is.
    Number,
    /// A share; 0.05 is written 5 %.
    Share,
    /// A multiple.
    Times,
    /// Milliseconds.
    Milliseconds,
    /// Bytes.
    Bytes,
}

/// Pictures in rows.
#[derive(Debug, Clone)]
pub struct Pictures {
    /// What they show.
    pub caption: String,
    /// How many are beside each other.
    pub columns: usize,
    /// Row by row.
    pub tiles: Vec<Tile>,
}

/// A picture with a caption.
#[derive(Debug, Clone)]
pub struct Tile {
    /// What it shows.
    pub caption: String,
    /// A PNG file.
    pub png: Vec<u8>,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Whether its pixels are to be seen as squares.
    pub close_up: bool,
}

/// Rows that can be sorted by any column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Matrix {
    /// What it shows.
    pub caption: String,
    /// The numbers' meanings, from left to right.
    pub columns: Vec<Column>,
    /// Its rows, in the order in which they were measured.
    pub rows: Vec<Entry>,
}

/// A column of a matrix.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// Unique name for files.
    pub key: String,
    /// Heading over several columns.
    pub group: String,
    /// Heading.
    pub label: String,
    /// One sentence.
    pub meaning: String,
    /// How its numbers are written.
    pub unit: Unit,
    /// Whether more is better.
    pub higher: bool,
}

/// A row of a matrix.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// What is measured on, such as a scene.
    pub scene: String,
    /// What is measured, such as a technique with its settings.
    pub technique: String,
    /// Name for people.
    pub title: String,
    /// Group of techniques, also the colour of its mark.
    pub family: String,
    /// One value for each column.
    pub values: Vec<Option<f64>>,
    /// Columns in which no other row of the scene is both better and faster.
    #[serde(rename = "leads")]
    pub on_front: Vec<String>,
}

impl Page {
    /// Adds a paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// Adds a table.
    pub fn table(&mut self, table: Table) {
        self.blocks.push(Block::Table(table));
    }

    /// Adds pictures.
    pub fn pictures(&mut self, caption: impl Into<String>, columns: usize, tiles: Vec<Tile>) {
        self.blocks.push(Block::Pictures(Pictures { caption: caption.into(), columns, tiles }));
    }

    /// Adds a verdict.
    pub fn verdict(&mut self, verdict: Verdict) {
        self.verdicts.push(verdict);
    }

    /// Adds a fact.
    pub fn fact(&mut self, fact: Fact) {
        self.facts.push(fact);
    }
}

impl Table {
    /// An empty table.
    #[must_use]
    pub fn new(caption: impl Into<String>, head: &[&str]) -> Self {
        Self { caption: caption.into(), head: head.iter().map(|h| (*h).into()).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    pub fn row(&mut self, name: impl Into<String>, cells: Vec<Cell>) {
        self.rows.push(Row { name: name.into(), cells });
    }
}

impl Cell {
    /// Our number alone.
    pub fn ours(value: impl Into<Option<f64>>, unit: Unit) -> Self {
        // JSON holds finite numbers only.
        Self { ours: value.into().filter(|v| v.is_finite()), paper: None, unit }
    }

    /// The same beside the paper's.
    #[must_use]
    pub fn paper(self, value: impl Into<Option<f64>>) -> Self {
        Self { paper: value.into(), ..self }
    }
}

impl Tile {
    /// A whole picture.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn new(caption: impl Into<String>, picture: &StoredImage) -> Result<Self> {
        Ok(Self { caption: caption.into(), png: picture.png()?, size: picture.size, close_up: false })
    }

    /// A part of one, enlarged by the page.
    ///
    /// # Errors
    /// As [`StoredImage::close_up`].
    pub fn close_up(caption: impl Into<String>, picture: &StoredImage, window: [u32; 4]) -> Result<Self> {
        Ok(Self { close_up: true, ..Self::new(caption, &picture.close_up(window, 1)?)? })
    }
}
