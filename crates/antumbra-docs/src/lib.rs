//! Documents whose numbers come from result files: `docs/x.md.in` and `docs/results/*.json` make `docs/x.md`.
//!
//! A result file is `{"source": …, "result": …}`: where numbers come from ([`Source`]), and what a command
//! printed as JSON. A template is a document with directives in double braces:
//!
//! - `{{table FILE .1 | COLUMN | COLUMN .3 | …}}`, alone on a line: a table of the file's rows, with one
//!   decimal, three in one column, and where it comes from below. Rows without any of the columns are left
//!   out.
//! - `{{FILE | ROW | COLUMN | FORMAT}}`: one number. `A / B` for a ratio, where B is `ROW | COLUMN` of the same
//!   file or `FILE | ROW | COLUMN`, and `A - B` for a difference.
//! - `{{source FILE}}`: where numbers come from whose table a document does not show.
//!
//! A document without a template of its own (the README) may have parts that carry theirs in a comment.
//!
//! FORMAT is `.N`, N decimals, or `.N%`, N decimals in percent; FILE is the file's name without its end, with
//! `:part` behind if the file holds several tables. A document that takes a number from a file without saying
//! where it comes from is an error.

mod between;
mod files;
mod record;
mod template;

pub use between::between;
pub use files::{Results, documents, fill_all, keep, keep_between};
pub use record::{Cell, Record, Row, Source};
pub use template::{fill, measured_numbers, refill};
