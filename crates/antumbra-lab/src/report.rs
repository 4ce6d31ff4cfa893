//! The report of a comparison: a folder with one self-contained page, the data, and the images.
//!
//! | file | content |
//! | --- | --- |
//! | `index.html` | everything, images included; works from a disk without a network |
//! | `results.json` | [`Results`], schema [`crate::results::SCHEMA`] |
//! | `results.csv` | the scores, one row per technique |
//! | the rest | the images, and whatever else was handed in |

use crate::files::{self, FileError};
use crate::results::{Results, ResultsError};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

mod answer;
mod bars;
mod column;
mod plot;
mod sections;
mod table;
pub(crate) mod text;
mod viewer;

pub use text::{bytes, count, escape, milliseconds, percent, significant};

const PAGE: &str = include_str!("report/page.html");
/// The style sheet that all pages share.
pub const STYLE: &str = include_str!("report/style.css");
const VIEWER_SCRIPT: &str = include_str!("report/viewer.js");
const PAGE_SCRIPT: &str = include_str!("report/script.js");

/// Names that the report itself uses.
const OWN_FILES: [&str; 3] = ["index.html", "results.json", "results.csv"];

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The file system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// The results cannot be stored.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The results name an image that was not handed in.
    #[error(
        "the results name the image {0:?}, which is not among the images handed in: render it or correct the name"
    )]
    MissingImage(String),
    /// A name that is not safe as a file name everywhere.
    #[error(
        "{0:?} cannot name a file of the report: use letters, digits, '.', '-' and '_' (see `files::stem`), and no name of the report's own files"
    )]
    Name(String),
}

/// Writes the folder `out_dir`, whole or not at all, and returns its path. An earlier report there
/// is replaced; any other folder that is not empty is refused.
///
/// `images` maps file names to the bytes of the files. The PNGs that `results` names must be among
/// them and go into the page as well; further files (raw EXR planes, say) are written beside it.
///
/// # Errors
/// [`ReportError::MissingImage`] and [`ReportError::Name`] before anything is written;
/// [`ReportError::Results`] for numbers that are not finite; [`ReportError::File`].
pub fn write(
    results: &Results,
    images: &BTreeMap<String, Vec<u8>>,
    out_dir: &Path,
) -> Result<PathBuf, ReportError> {
    if let Some(name) = images.keys().find(|name| !is_safe(name)) {
        return Err(ReportError::Name(name.clone()));
    }
    let page = html(results, images)?;
    let mut listed = results.clone();
    listed.files = images.keys().cloned().chain(["index.html", "results.csv"].map(String::from)).collect();
    let json = listed.to_json()?;
    files::write_folder(out_dir, |folder| {
        for (name, bytes) in images {
            folder.write(name, bytes)?;
        }
        folder.write("results.csv", results.csv().as_bytes())?;
        folder.write("results.json", json.as_bytes())?;
        folder.write("index.html", page.as_bytes())?;
        Ok(())
    })
}

fn is_safe(name: &str) -> bool {
    let plain = !name.is_empty() && !name.starts_with('.') && name == files::stem(name);
    plain && !OWN_FILES.iter().any(|own| own.eq_ignore_ascii_case(name))
}

/// What a page is called: the scene's name, of a file without its folders.
fn title(scene: &str) -> &str {
    Path::new(scene).file_name().and_then(|name| name.to_str()).unwrap_or(scene)
}

/// The page alone.
///
/// # Errors
/// [`ReportError::MissingImage`].
fn html(results: &Results, images: &BTreeMap<String, Vec<u8>>) -> Result<String, ReportError> {
    let title = title(&results.run.scene.name);
    let best = answer::best(results, |t| t.scores.light_space.rmse);
    let parts = [
        ("title", text::escape(&format!("{title}: shadow techniques compared"))),
        ("scene", text::escape(title)),
        ("facts", sections::facts(results)),
        ("style", STYLE.to_owned()),
        ("script", format!("{VIEWER_SCRIPT}\n{PAGE_SCRIPT}")),
        ("images", viewer::images(results, images)?),
        ("answer", answer::paragraph(results)),
        ("options_left", viewer::options(results, viewer::Side::Left, best)),
        ("options_right", viewer::options(results, viewer::Side::Right, best)),
        ("heat_maps", viewer::heat_maps(results)),
        ("legend", viewer::legend()),
        ("table", table::scores(results)),
        ("regions", table::regions(results)),
        ("classes", table::classes(results)),
        ("plots", plot::section(results)),
        ("time", bars::time(results)),
        ("memory", bars::memory(results)),
        ("truth", sections::truth(results)),
        ("adapter", sections::adapter(results)),
        ("explain", sections::explain(results)),
        ("command", text::escape(&sections::command(&results.run.command))),
        ("definitions", sections::definitions()),
        ("program", text::escape(&format!("{} {}", results.run.program.name, results.run.program.version))),
        ("schema", text::escape(&results.schema)),
    ];
    Ok(text::fill(PAGE, &parts))
}
