//! Puts WGSL together: a technique's file, the shared files that it needs, and generated glue.
//!
//! WGSL files hold functions, constants and uniform structs only; textures and samplers reach them
//! as parameters, settings and buffers through functions that are written beside what is bound. The first
//! line may be `//! needs a b`: stems of other files, or a slot such as `lookup` that one of the technique's
//! [slots](crate::Description::slots) fills (`lookup_fitted`). Bound globals exist in the glue alone.

mod compose;
mod files;
mod names;
mod receiver;
pub(crate) mod settings;
mod unroll;

pub(crate) use compose::Composition;
pub use files::CASTER_WGSL;
pub(crate) use files::check as check_files;
pub(crate) use files::text as file;

/// A shader that a [`ShadowMap`](crate::ShadowMap) compiles.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Shader {
    /// What it is for: `cast`, `cut-out`, `scan`, `convert`, `blur`, `mips` or `sum`.
    pub pass: &'static str,
    /// A whole WGSL module with entry points `vertex` and `fragment`, or `compute`.
    pub text: String,
    /// Formats of the colours that it draws to.
    pub targets: Vec<wgpu::TextureFormat>,
}

/// A shader in pieces that remember which file they came from.
#[derive(Debug, Clone, Default)]
pub struct ShaderText {
    pieces: Vec<(String, String)>,
    /// Files that fill slots which others need.
    filled: Vec<&'static str>,
    /// The word that names begin with in the user's module; none where the library is alone.
    prefix: Option<String>,
}

impl ShaderText {
    /// Everything as one text. Every name at module scope begins with `shadow` (types with `Shadow`), or as
    /// [`named`](Self::named) says.
    #[must_use]
    pub fn text(&self) -> String {
        let text: String = self.pieces.iter().map(|(_, text)| text.as_str()).collect();
        if self.prefix.is_some() { self.renamed(&text) } else { text }
    }

    /// The caller's shader, followed by this one: her `enable` lines stay first and her line
    /// numbers stay right.
    #[must_use]
    pub fn after(&self, user: &str) -> wgpu::ShaderSource<'static> {
        wgpu::ShaderSource::Wgsl(format!("{user}\n{}", self.text()).into())
    }

    /// File and line (from 1) of line `line` (from 1) of [`after`](Self::after)`(user)`, if it is
    /// not the caller's own.
    #[must_use]
    pub fn locate(&self, user: &str, line: usize) -> Option<(&str, usize)> {
        // `lines` would drop a final empty line, which the joining newline makes real.
        let mut start = user.split('\n').count();
        for (name, text) in &self.pieces {
            let length = text.matches('\n').count();
            if (start + 1..=start + length).contains(&line) {
                return Some((name, line - start));
            }
            start += length;
        }
        None
    }
}

#[cfg(test)]
mod tests;
