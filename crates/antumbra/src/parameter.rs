//! The settings of a technique as a table: names, units, ranges, values.
//!
//! The public fields of a technique are the settings; [`Parameter`] is a view of one field, from
//! which the command line, reports and sliders are made.

use crate::error::SettingError;

/// A set of named alternatives that a setting chooses from.
pub trait Choice {
    /// All names, in order.
    fn names(&self) -> &'static [&'static str];
    /// Index of the current one.
    fn index(&self) -> usize;
    /// Takes the alternative with that index; `index < names().len()`.
    fn choose(&mut self, index: usize);
}

/// Declares an enum whose variants have names, as a [`Choice`].
macro_rules! choice {
    ($(#[$meta:meta])* $name:ident { $($(#[$vmeta:meta])* $variant:ident = $text:literal),+ $(,)? }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum $name { $($(#[$vmeta])* $variant),+ }

        impl $crate::parameter::Choice for $name {
            fn names(&self) -> &'static [&'static str] { &[$($text),+] }
            fn index(&self) -> usize { *self as usize }
            fn choose(&mut self, index: usize) {
                if let Some(value) = [$(Self::$variant),+].get(index) { *self = *value; }
            }
        }
    };
}
pub(crate) use choice;

impl std::fmt::Debug for Field<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(v, r) => write!(f, "Number({v}, {r:?})"),
            Self::Count(v, r) => write!(f, "Count({v}, {r:?})"),
            Self::Odd(v, r) => write!(f, "Odd({v}, {r:?})"),
            Self::Choice(c) => write!(f, "Choice({})", c.names()[c.index()]),
        }
    }
}

/// The field behind a [`Parameter`].
pub enum Field<'a> {
    /// A real number within a closed range.
    Number(&'a mut f32, std::ops::RangeInclusive<f32>),
    /// A whole number within a closed range.
    Count(&'a mut u32, std::ops::RangeInclusive<u32>),
    /// An odd whole number within a closed range (a kernel width).
    Odd(&'a mut u32, std::ops::RangeInclusive<u32>),
    /// One of several names.
    Choice(&'a mut dyn Choice),
}

/// One setting: what it is called, measured in, allowed to be, and is.
pub struct Parameter<'a> {
    /// Name, as written in `esm.c=60`.
    pub name: &'static str,
    /// Unit, such as `texels`; empty for pure numbers.
    pub unit: &'static str,
    /// One sentence.
    pub meaning: &'static str,
    /// Access to the value.
    pub field: Field<'a>,
}

impl std::fmt::Debug for Parameter<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} = {} ({})", self.name, self.value(), self.allowed())
    }
}

impl<'a> Parameter<'a> {
    /// The setting behind such a field.
    #[must_use]
    pub fn new(name: &'static str, unit: &'static str, field: Field<'a>, meaning: &'static str) -> Self {
        Self { name, unit, meaning, field }
    }

    /// The current value as [`set`](Self::set) would read it.
    #[must_use]
    pub fn value(&self) -> String {
        match &self.field {
            Field::Number(v, _) => v.to_string(),
            Field::Count(v, _) | Field::Odd(v, _) => v.to_string(),
            Field::Choice(c) => c.names()[c.index()].to_string(),
        }
    }

    /// The range or the names, for people.
    #[must_use]
    pub fn allowed(&self) -> String {
        match &self.field {
            Field::Number(_, r) => format!("{} to {}", r.start(), r.end()),
            Field::Count(_, r) => format!("whole, {} to {}", r.start(), r.end()),
            Field::Odd(_, r) => format!("odd, {} to {}", r.start(), r.end()),
            Field::Choice(c) => c.names().join(" | "),
        }
    }

    /// Whether the current value is allowed. Public fields can be set to anything, so
    /// [`ShadowMap::new`](crate::ShadowMap::new) asks again.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`].
    pub fn check(&self, technique: &str) -> Result<(), SettingError> {
        let good = match &self.field {
            Field::Number(v, r) => r.contains(*v),
            Field::Count(v, r) => r.contains(*v),
            Field::Odd(v, r) => r.contains(*v) && **v % 2 == 1,
            Field::Choice(_) => true,
        };
        if good { Ok(()) } else { Err(self.refusal(technique, &self.value())) }
    }

    /// Reads `text` into the field.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`], and then the field is as before.
    pub fn set(&mut self, technique: &str, text: &str) -> Result<(), SettingError> {
        let refusal = self.refusal(technique, text);
        let taken = match &mut self.field {
            Field::Number(v, r) => text.parse().ok().filter(|x| r.contains(x)).map(|x| **v = x),
            Field::Count(v, r) => text.parse().ok().filter(|x| r.contains(x)).map(|x| **v = x),
            Field::Odd(v, r) => {
                text.parse().ok().filter(|x| r.contains(x) && x % 2 == 1).map(|x: u32| **v = x)
            }
            Field::Choice(c) => c.names().iter().position(|n| *n == text).map(|i| c.choose(i)),
        };
        taken.ok_or(refusal)
    }

    fn refusal(&self, technique: &str, value: &str) -> SettingError {
        SettingError::OutOfRange {
            parameter: format!("{technique}.{}", self.name),
            value: value.to_string(),
            allowed: self.allowed(),
        }
    }
}
