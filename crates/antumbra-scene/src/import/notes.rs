//! What importers left out or changed: one note for each kind, with a count.

/// Most elements that a note names; the rest is counted.
const NAMED: usize = 3;

/// Notes by kind, in the order in which the kinds turned up.
#[derive(Debug, Clone, Default)]
pub(super) struct Notes(Vec<(String, Vec<String>)>);

impl Notes {
    /// Adds an element to the note that says `said` of it.
    pub(super) fn add(&mut self, element: impl Into<String>, said: impl Into<String>) {
        let said = said.into();
        match self.0.iter_mut().find(|(other, _)| *other == said) {
            Some((_, elements)) => elements.push(element.into()),
            None => self.0.push((said, vec![element.into()])),
        }
    }

    /// Adds a note about the whole file.
    pub(super) fn say(&mut self, said: impl Into<String>) {
        self.0.push((said.into(), Vec::new()));
    }

    /// One sentence for each kind: its elements, then what is said of them.
    pub(super) fn sentences(&self) -> Vec<String> {
        self.0.iter().map(|(said, elements)| sentence(said, elements)).collect()
    }
}

fn sentence(said: &str, elements: &[String]) -> String {
    let named = elements[..elements.len().min(NAMED)].join(", ");
    match elements.len() {
        0 => said.into(),
        n if n > NAMED => format!("{named} and {} more ({n} in all): {said}", n - NAMED),
        _ => format!("{named}: {said}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_note_for_each_kind() {
        let mut notes = Notes::default();
        notes.say("the file is odd");
        for i in 0..5 {
            notes.add(format!("nodes[{i}]"), "left out");
        }
        notes.add("cameras[0]", "turned");
        let want = [
            "the file is odd",
            "nodes[0], nodes[1], nodes[2] and 2 more (5 in all): left out",
            "cameras[0]: turned",
        ];
        assert_eq!(notes.sentences(), want);
    }
}
