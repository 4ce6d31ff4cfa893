//! Runs the program in a folder of its own, and makes small scenes for it.

#![allow(dead_code, reason = "each test program uses a part of it")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use serde_json::{Value, json};
use std::{
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::atomic::{AtomicU32, Ordering},
};

/// An empty folder, removed at the end.
#[derive(Debug)]
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("antumbra-cli-test-{}-{number}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// Every file and folder below, sorted.
    pub(crate) fn names(&self) -> Vec<PathBuf> {
        let mut found = Vec::new();
        let mut open = vec![self.0.clone()];
        while let Some(folder) = open.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                found.push(path.strip_prefix(&self.0).unwrap().to_owned());
                if path.is_dir() {
                    open.push(path);
                }
            }
        }
        found.sort();
        found
    }

    pub(crate) fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.0.join(name), bytes).unwrap();
    }

    /// Runs the program in this folder.
    pub(crate) fn run(&self, arguments: &[impl AsRef<OsStr>]) -> Answer {
        self.run_with(arguments, &[])
    }

    pub(crate) fn run_with(&self, arguments: &[impl AsRef<OsStr>], environment: &[(&str, &str)]) -> Answer {
        let output = Command::new(env!("CARGO_BIN_EXE_antumbra"))
            .args(arguments)
            .current_dir(&self.0)
            .envs(environment.iter().copied())
            .output()
            .unwrap();
        Answer {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// How a run ended and what it said.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Answer {
    /// Standard output of a run that went well.
    #[track_caller]
    pub(crate) fn good(self) -> String {
        assert_eq!(self.code, Some(0), "{}", self.err);
        assert_eq!(self.err, "", "nothing to say on standard error");
        self.out
    }

    /// What a run that was refused said, which has to contain all of `words`.
    #[track_caller]
    pub(crate) fn refusal(&self, words: &[&str]) {
        assert_eq!(self.code, Some(2), "out: {}\nerr: {}", self.out, self.err);
        assert_eq!(self.out, "", "a refusal prints no results");
        for word in words {
            assert!(self.err.contains(word), "'{word}' is missing in: {}", self.err);
        }
        assert!(!self.err.contains("panicked"), "{}", self.err);
    }
}

/// A ground of 8 by 8 with a smaller square one unit above it.
pub(crate) fn positions() -> Vec<f32> {
    let square =
        |s: f32, y: f32| [[-s, y, -s], [-s, y, s], [s, y, s], [s, y, -s]].into_iter().flatten().collect();
    let both: [Vec<f32>; 2] = [square(4.0, 0.0), square(1.0, 1.0)];
    both.concat()
}

/// Two triangles for each square.
pub(crate) const INDICES: [u16; 12] = [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7];

/// A binary glTF file of those vertices and triangles, changed by `change`.
pub(crate) fn glb(positions: &[f32], indices: &[u16], change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let mut binary: Vec<u8> = positions.iter().flat_map(|v| v.to_le_bytes()).collect();
    let split = binary.len();
    binary.extend(indices.iter().flat_map(|v| v.to_le_bytes()));
    let mut document = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": positions.len() / 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": indices.len(), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": split},
            {"buffer": 0, "byteOffset": split, "byteLength": binary.len() - split},
        ],
        "buffers": [{"byteLength": binary.len()}],
    });
    change(&mut document);
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |n: usize| (n as u32).to_le_bytes();
    let mut file = [b"glTF".as_slice(), &word(2), &word(12 + 8 + text.len() + 8 + binary.len())].concat();
    file.extend([&word(text.len()), b"JSON".as_slice(), &text].concat());
    file.extend([&word(binary.len()), b"BIN\0".as_slice(), &binary].concat());
    file
}

/// Width and height that a PNG file states.
pub(crate) fn png_size(path: &Path) -> [u32; 2] {
    let bytes = fs::read(path).unwrap();
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n", "{}", path.display());
    [16, 20].map(|i| u32::from_be_bytes(bytes[i..i + 4].try_into().unwrap()))
}
