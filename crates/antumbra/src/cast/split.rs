//! Storage arrays that may be larger than one binding: shaders index several buffers as one.

use std::fmt::Write;

/// How an array is split into buffers: each holds as many elements, the last one what is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Split {
    /// Elements of the whole array, 1 or more.
    pub(super) elements: u64,
    /// Elements of a buffer, 1 or more.
    pub(super) each: u64,
}

impl Split {
    /// Most buffers of an array.
    pub(super) const MAX_BUFFERS: u32 = 8;

    /// Of elements of `bytes` bytes each, in buffers of at most `max` bytes.
    pub(super) fn new(elements: u64, bytes: u64, max: u64) -> Self {
        let elements = elements.max(1);
        Self { elements, each: (max / bytes).clamp(1, elements) }
    }

    /// Number of buffers.
    pub(super) fn count(self) -> u32 {
        u32::try_from(self.elements.div_ceil(self.each)).unwrap_or(u32::MAX)
    }

    /// Elements of each buffer in turn.
    pub(super) fn sizes(self) -> impl Iterator<Item = u64> {
        (0..u64::from(self.count())).map(move |i| self.each.min(self.elements - i * self.each))
    }

    /// WGSL that declares the buffers `name_0`, `name_1` … of `group` as arrays of `of`.
    pub(super) fn declared(
        self,
        name: &str,
        access: &str,
        of: &str,
        group: u32,
        binding: impl Fn(u32) -> u32,
    ) -> String {
        (0..self.count()).fold(String::new(), |mut text, k| {
            let at = binding(k);
            let _ = writeln!(
                text,
                "@group({group}) @binding({at}) var<storage, {access}> {name}_{k}: array<{of}>;"
            );
            text
        })
    }

    /// WGSL statements for element `i`: what `does` makes of a buffer's name and of an index within it, which
    /// must return.
    pub(super) fn chosen(self, name: &str, does: impl Fn(&str, &str) -> String) -> String {
        let last = self.count() - 1;
        (0..=last).fold(String::new(), |mut text, k| {
            let start = u64::from(k) * self.each;
            let index = if k == 0 { "i".into() } else { format!("(i - {start}u)") };
            let done = does(&format!("{name}_{k}"), &index);
            let _ = match k < last {
                true => write!(text, "if i < {}u {{ {done} }} ", start + self.each),
                false => write!(text, "{done}"),
            };
            text
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_is_in_one_buffer() {
        for (elements, max, sizes) in [(10, 40, vec![10]), (10, 39, vec![9, 1]), (9, 12, vec![3, 3, 3])] {
            let split = Split::new(elements, 4, max);
            assert_eq!(split.sizes().collect::<Vec<_>>(), sizes);
            assert_eq!(split.count() as usize, sizes.len());
        }
        assert_eq!(Split::new(0, 4, 1).sizes().collect::<Vec<_>>(), [1]);
    }

    #[test]
    fn the_text_chooses_the_buffer() {
        let text = |max| Split::new(10, 4, max).chosen("a", |buffer, i| format!("return {buffer}[{i}];"));
        assert_eq!(text(40), "return a_0[i];");
        let three = "if i < 4u { return a_0[i]; } if i < 8u { return a_1[(i - 4u)]; } return a_2[(i - 8u)];";
        assert_eq!(text(16), three);
    }
}
