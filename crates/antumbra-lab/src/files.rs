//! Files that appear whole or not at all.
//!
//! A file is written under a temporary name beside its place, flushed to the disk, and renamed at
//! the end; a folder likewise. Whatever fails before that is removed again, and what was there
//! before stays.

use serde_json::Value;
use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Why a file or folder could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The operating system refused.
    #[error("cannot {verb} {}: {}", path.display(), reason(source))]
    Io {
        /// "read", "write", …
        verb: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The path has no last part to write to, such as `/`.
    #[error("{} names no file or folder: give one to write to", .0.display())]
    NoName(PathBuf),
    /// The folder is not empty and no earlier report.
    #[error("{} already exists and is not an earlier report ({why}): choose another folder or empty it", path.display())]
    NotOurs {
        /// The folder.
        path: PathBuf,
        /// What in it says so.
        why: String,
    },
}

/// Names the usual reasons as a person would.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::StorageFull => "the disk is full".into(),
        io::ErrorKind::QuotaExceeded => "the disk quota is used up".into(),
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".into(),
        io::ErrorKind::NotFound => "no such file or folder".into(),
        io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory => "a file is in its way".into(),
        io::ErrorKind::IsADirectory => "it is a folder".into(),
        _ => error.to_string(),
    }
}

fn failed(verb: &'static str, path: &Path) -> impl FnOnce(io::Error) -> FileError {
    let path = path.to_owned();
    move |source| FileError::Io { verb, path, source }
}

/// A file stem for a technique's spec: what is not a letter, a digit, '.', '-' or '_' becomes '-'.
/// "esm.c=80,kernel=5" is "esm.c-80-kernel-5".
#[must_use]
pub fn stem(spec: &str) -> String {
    let keep = |c: char| if c.is_ascii_alphanumeric() || ".-_".contains(c) { c } else { '-' };
    spec.chars().map(keep).collect()
}

/// The bytes of a file.
///
/// # Errors
/// [`FileError::Io`].
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    fs::read(path).map_err(failed("read", path))
}

/// Writes a file, replacing an earlier one, whole or not at all. Missing parent folders are made.
///
/// # Errors
/// [`FileError::Io`] or [`FileError::NoName`]; the earlier file is then as it was.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let temporary = beside(path, "partial")?;
    create_parent(path)?;
    let write = || {
        let mut file = fs::File::create_new(&temporary)?;
        file.write_all(bytes)?;
        file.sync_all()
    };
    let written = write()
        .map_err(failed("write", path))
        .and_then(|()| fs::rename(&temporary, path).map_err(failed("write", path)));
    if written.is_err() {
        // The first error is the one to tell; a temporary file that cannot be removed either adds nothing.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// Makes the folder `out` from what `fill` writes into an empty folder beside it. An earlier report
/// (or an empty folder) of that name is replaced, anything else is refused before `fill` runs.
/// Returns the folder as it can be opened.
///
/// # Errors
/// [`FileError::NotOurs`], [`FileError::Io`], or what `fill` returns; what was there is then as it
/// was and nothing is left beside it.
pub fn write_folder<E: From<FileError>>(
    out: &Path,
    fill: impl FnOnce(&Folder<'_>) -> Result<(), E>,
) -> Result<PathBuf, E> {
    // Through links and "..", so that it is the folder that is replaced and not a link to it.
    let out = if out.exists() { out.canonicalize().map_err(failed("open", out))? } else { out.to_owned() };
    check_folder(&out)?;
    let partial = beside(&out, "partial")?;
    create_parent(&out)?;
    fs::create_dir(&partial).map_err(failed("create", &out))?;
    let folder = Folder { partial: &partial, out: &out };
    let result = fill(&folder).and_then(|()| Ok(put_in_place(&partial, &out)?));
    if result.is_err() {
        // As above: the first error is the one to tell.
        let _ = fs::remove_dir_all(&partial);
    }
    result.map(|()| out)
}

/// A folder that [`write_folder`] makes, while it is filled.
#[derive(Debug)]
pub struct Folder<'a> {
    partial: &'a Path,
    out: &'a Path,
}

impl Folder<'_> {
    /// Writes a file of the folder, whole or not at all.
    ///
    /// # Errors
    /// [`FileError::Io`], which names the file by the place where it was going to be.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), FileError> {
        write_atomically(&self.partial.join(name), bytes).map_err(|error| match error {
            FileError::Io { verb, source, .. } => FileError::Io { verb, path: self.out.join(name), source },
            other => other,
        })
    }
}

fn put_in_place(partial: &Path, out: &Path) -> Result<(), FileError> {
    // Again, since filling took a while.
    check_folder(out)?;
    if !out.exists() {
        return fs::rename(partial, out).map_err(failed("write", out));
    }
    let old = beside(out, "replaced")?;
    fs::rename(out, &old).map_err(failed("replace", out))?;
    if let Err(error) = fs::rename(partial, out) {
        fs::rename(&old, out).map_err(failed("restore", out))?;
        return Err(failed("write", out)(error));
    }
    // The new folder is there; what cannot be removed of the old one is told by its temporary name, which
    // is where it is.
    fs::remove_dir_all(&old).map_err(failed("remove", &old))
}

/// Files that say what else is in a folder of ours, and how their schema begins.
const INDEXES: [(&str, &str); 3] = [
    ("results.json", "antumbra-results/"),
    ("maps.json", "antumbra-maps/"),
    ("flicker.json", "antumbra-flicker/"),
];

/// What such a file lists, if it is one.
fn listed(folder: &Path, (name, schema): &(&str, &str)) -> Option<Vec<String>> {
    let index: Value = serde_json::from_slice(&fs::read(folder.join(name)).ok()?).ok()?;
    if !index.get("schema")?.as_str()?.starts_with(schema) {
        return None;
    }
    let files = index.get("files").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    Some(files.iter().filter_map(|f| f.as_str().map(String::from)).collect())
}

/// Whether [`write_folder`] may write there: if there is nothing, an empty folder, or a report of
/// ours that nobody added to.
///
/// # Errors
/// [`FileError::NotOurs`], or [`FileError::Io`] if the folder cannot be listed.
pub fn check_folder(out: &Path) -> Result<(), FileError> {
    if !out.exists() {
        return Ok(());
    }
    let foreign = |why: String| Err(FileError::NotOurs { path: out.to_owned(), why });
    if !out.is_dir() {
        return foreign("it is a file".into());
    }
    let entries = fs::read_dir(out).map_err(failed("list", out))?;
    let names = entries.map(|entry| entry.map(|e| e.file_name())).collect::<Result<Vec<_>, _>>();
    let names = names.map_err(failed("list", out))?;
    if names.is_empty() {
        return Ok(());
    }
    let Some((index, listed)) = INDEXES.iter().find_map(|index| Some((index.0, listed(out, index)?))) else {
        let names: Vec<&str> = INDEXES.iter().map(|index| index.0).collect();
        return foreign(format!("it is not empty and has no {} of this program", names.join(" or ")));
    };
    let known = |name: &&OsString| name.to_str().is_some_and(|n| n == index || listed.iter().any(|f| f == n));
    match names.iter().find(|name| !known(name)) {
        Some(name) => foreign(format!("{} in it is not part of the report", Path::new(name).display())),
        None => Ok(()),
    }
}

/// A name beside `path` that nobody else uses: "report" becomes "report.partial-4711-0".
fn beside(path: &Path, word: &str) -> Result<PathBuf, FileError> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let mut name = path.file_name().ok_or_else(|| FileError::NoName(path.to_owned()))?.to_owned();
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    name.push(format!(".{word}-{}-{number}", std::process::id()));
    Ok(path.with_file_name(name))
}

fn create_parent(path: &Path) -> Result<(), FileError> {
    match path.parent() {
        Some(parent) if parent != Path::new("") => {
            fs::create_dir_all(parent).map_err(failed("create", parent))
        }
        _ => Ok(()),
    }
}
