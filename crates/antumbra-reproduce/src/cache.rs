//! Measurements on disk, so that an interrupted run goes on where it was.
//!
//! A measurement is kept under a key that says everything that determines it: the program (a
//! fingerprint of its executable, which covers techniques, scenes and experiments alike), the
//! graphics adapter with its driver, and what was asked. A file is written whole or not at all, and
//! says its key, so that a stale, foreign or damaged one is measured anew.

use antumbra_lab::files;
use anyhow::{Context, Result};
use flate2::{Compression, read::DeflateDecoder, write::DeflateEncoder};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::{
    fs,
    io::{Read, Write},
    path::{Path, PathBuf},
};

/// Measurements in one folder, of one program on one adapter.
#[derive(Debug)]
pub struct Cache {
    folder: PathBuf,
    /// What all keys begin with.
    base: String,
}

/// What a file holds.
#[derive(Serialize, Deserialize)]
struct Entry<T> {
    key: String,
    value: T,
}

impl Cache {
    /// Measurements of `program` on `adapter` (both as fingerprints or texts) in `folder`, which is
    /// made when the first is kept.
    #[must_use]
    pub fn new(folder: &Path, program: &str, adapter: &str) -> Self {
        Self { folder: folder.to_owned(), base: format!("{program} {adapter}") }
    }

    /// The measurement of that key, taken from disk if it is there, else made and kept.
    ///
    /// # Errors
    /// What `make` returns; a folder that cannot be written to.
    pub fn memo<T: Serialize + DeserializeOwned>(
        &self,
        key: &impl Serialize,
        make: impl FnOnce() -> Result<T>,
    ) -> Result<T> {
        let key = format!("{} {}", self.base, serde_json::to_string(key).context("a key of the cache")?);
        let path = self.folder.join(format!("{:032x}", fingerprint(key.as_bytes())));
        if let Some(entry) = read::<T>(&path).filter(|entry| entry.key == key) {
            return Ok(entry.value);
        }
        let entry = Entry { key, value: make()? };
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(&serde_json::to_vec(&entry).context("a measurement")?)?;
        files::write_atomically(&path, &encoder.finish()?).context("measurements cannot be kept")?;
        Ok(entry.value)
    }
}

/// What a file holds, if it is whole.
fn read<T: DeserializeOwned>(path: &Path) -> Option<Entry<T>> {
    let mut text = Vec::new();
    DeflateDecoder::new(fs::File::open(path).ok()?).read_to_end(&mut text).ok()?;
    serde_json::from_slice(&text).ok()
}

/// 128 bits that tell contents apart (FNV-1a; against accidents, not against malice).
#[must_use]
pub fn fingerprint(bytes: &[u8]) -> u128 {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.iter().fold(OFFSET, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(PRIME))
}

/// Numbers and bytes as base64 text in JSON.
pub(crate) mod packed {
    use base64::{Engine, engine::general_purpose::STANDARD};
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub(crate) fn serialize<T: bytemuck::NoUninit, S: Serializer>(
        values: &[T],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.serialize_str(&STANDARD.encode(bytemuck::cast_slice::<T, u8>(values)))
    }

    pub(crate) fn deserialize<'a, T: bytemuck::AnyBitPattern + bytemuck::NoUninit, D: Deserializer<'a>>(
        from: D,
    ) -> Result<Vec<T>, D::Error> {
        let bytes = STANDARD.decode(String::deserialize(from)?).map_err(D::Error::custom)?;
        if bytes.len() % size_of::<T>() != 0 {
            return Err(D::Error::custom("a part of a number"));
        }
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests fail by panicking")]
mod tests {
    use super::*;

    struct Folder(PathBuf);
    impl Folder {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("antumbra-cache-{name}-{}", std::process::id()));
            Self(path)
        }
    }
    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn only_file(folder: &Path) -> PathBuf {
        fs::read_dir(folder).unwrap().next().unwrap().unwrap().path()
    }

    #[test]
    fn a_measurement_is_made_once_for_each_key_program_and_adapter() {
        let folder = Folder::new("once");
        let ask = |program: &str, key: &str, value: u32| {
            Cache::new(&folder.0, program, "gpu").memo(&key, || Ok(value)).unwrap()
        };
        assert_eq!([ask("v1", "a", 1), ask("v1", "a", 2)], [1, 1]);
        assert_eq!([ask("v1", "b", 3), ask("v2", "a", 4)], [3, 4]);
    }

    #[test]
    fn damaged_and_foreign_files_are_made_anew() {
        let folder = Folder::new("damaged");
        let cache = Cache::new(&folder.0, "v1", "gpu");
        let ask = |value: u32| cache.memo(&"key", || Ok(value)).unwrap();
        assert_eq!(ask(1), 1);
        let path = only_file(&folder.0);
        let whole = fs::read(&path).unwrap();
        fs::write(&path, &whole[..whole.len() / 2]).unwrap();
        assert_eq!([ask(2), ask(3)], [2, 2]);
        // Another key's measurement under this name.
        fs::write(&path, b"").unwrap();
        assert_eq!(ask(4), 4);
        cache.memo(&"other", || Ok(5)).unwrap();
        let other = fs::read_dir(&folder.0).unwrap().map(|e| e.unwrap().path()).find(|p| *p != path).unwrap();
        fs::copy(other, &path).unwrap();
        assert_eq!(ask(6), 6);
    }

    #[test]
    fn what_fails_is_not_kept() {
        let folder = Folder::new("fails");
        let cache = Cache::new(&folder.0, "v1", "gpu");
        assert!(cache.memo::<u32>(&"key", || anyhow::bail!("no")).is_err());
        assert_eq!(cache.memo(&"key", || Ok(7)).unwrap(), 7);
    }

    #[test]
    fn packed_numbers_come_back_to_the_last_bit() {
        #[derive(Serialize, Deserialize, PartialEq, Debug)]
        struct Numbers(#[serde(with = "packed")] Vec<f32>);
        let numbers = Numbers(vec![0.1, -0.0, f32::MIN_POSITIVE, 1.0 / 3.0]);
        let text = serde_json::to_string(&numbers).unwrap();
        assert_eq!(serde_json::from_str::<Numbers>(&text).unwrap(), numbers);
        assert!(serde_json::from_str::<Numbers>("\"AAA=\"").is_err());
    }
}
