//! The experiments of the shadow map papers, run again on scenes that anyone can make.
//!
//! A [`target::Target`] is a table or figure of a source; running it on a [`workbench::Workbench`] gives a
//! [`page::Page`], which [`html`] shows and [`results`] keeps as data. [`run`](run()) does this for a
//! list of targets and writes a folder:
//!
//! | file | content |
//! | --- | --- |
//! | `index.html` | every claim with its verdict, and the way to all pages |
//! | `csm-figure-9.html`, … | one page per target; pictures are inside |
//! | `results.json`, `results.csv` | the numbers, see [`results`] |
//! | `cache/` | measurements, so that an interrupted run goes on; may be removed |
//!
//! Every verdict is computed from what was measured ([`verdict`]).

mod brabec;
pub mod cache;
pub mod catalogue;
mod csm;
mod esm;
pub mod fidelity;
mod gallery;
pub mod html;
pub mod numbers;
pub mod page;
pub mod results;
mod run;
mod slides;
mod spsm;
mod step;
pub mod stored_image;
pub mod study;
mod table;
pub mod target;
pub mod verdict;
pub mod workbench;

pub use run::{Options, RunObserver, check, run};
