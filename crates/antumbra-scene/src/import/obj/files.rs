//! Text and other files beside a file, however they were written.

use std::path::{Path, PathBuf};
use std::{fs, io};

/// Text in UTF-8, or in UTF-16 with a byte order mark; bytes that are neither become question marks.
pub(super) fn text(bytes: &[u8]) -> String {
    let wide = |read: fn([u8; 2]) -> u16| -> String {
        let units = bytes[2..].chunks_exact(2).map(|pair| read([pair[0], pair[1]]));
        char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    }
}

/// The files that a file may name: those below its folder, or some in memory.
#[derive(Debug, Clone)]
pub(super) enum Files<'a> {
    Folder(PathBuf),
    /// Names and contents.
    Memory(&'a [(&'a str, &'a [u8])]),
}

impl Files<'_> {
    /// Where a file is: as it is named, in other letters, or, if it names a folder that is not there, beside
    /// the file that names it.
    pub(super) fn find(&self, name: &str) -> Option<PathBuf> {
        let name = name.replace('\\', "/");
        let last = name.rsplit('/').next().unwrap_or_default();
        [name.as_str(), last].into_iter().find_map(|name| match self {
            Self::Folder(folder) => {
                let exact = folder.join(name);
                if exact.is_file() { Some(exact) } else { in_other_letters(folder, name) }
            }
            Self::Memory(files) => {
                let exact = files.iter().find(|(own, _)| *own == name);
                let other = || files.iter().find(|(own, _)| own.to_lowercase() == name.to_lowercase());
                exact.or_else(other).map(|(own, _)| PathBuf::from(own))
            }
        })
    }

    /// What a file holds that was found.
    pub(super) fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        match self {
            Self::Folder(_) => fs::read(path),
            Self::Memory(files) => {
                let found = files.iter().find(|(own, _)| Path::new(own) == path);
                found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
            }
        }
    }

    /// Where a file would be that was not found: of it the system says so in its own words.
    pub(super) fn missing(&self, name: &str) -> PathBuf {
        match self {
            Self::Folder(folder) => folder.join(name),
            Self::Memory(_) => name.into(),
        }
    }

    /// The files that one of them may name.
    pub(super) fn beside(&self, path: &Path) -> Self {
        match self {
            Self::Folder(folder) => Self::Folder(path.parent().unwrap_or(folder).to_path_buf()),
            Self::Memory(files) => Self::Memory(files),
        }
    }
}

/// Windows does not tell capitals from small letters, and files from there come to systems that do.
fn in_other_letters(folder: &Path, name: &str) -> Option<PathBuf> {
    let mut path = folder.to_path_buf();
    for part in name.split('/').filter(|part| !part.is_empty()) {
        if matches!(part, "." | "..") {
            path.push(part);
            continue;
        }
        let list = if path.as_os_str().is_empty() { Path::new(".") } else { &path };
        let entries = fs::read_dir(list).ok()?;
        let mut names: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.file_name())).collect();
        names.sort();
        let same = |found: &std::ffi::OsString| found.to_string_lossy().to_lowercase() == part.to_lowercase();
        path.push(names.into_iter().find(same)?);
    }
    path.is_file().then_some(path)
}
