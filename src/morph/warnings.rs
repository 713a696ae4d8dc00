//! What a user should know of a morph, the gravest first.

/// How much a warning matters, most first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The result is not to be used as it is.
    Broken,
    /// The input may not be what was meant, or the result not what is needed: look at it.
    Doubtful,
    /// What follows from the input, to be known.
    Known,
}

/// Warnings in the order they came.
#[derive(Debug, Default)]
pub struct Warnings(Vec<(Severity, String)>);

impl Warnings {
    /// Those of reading a field.
    pub fn of_field(texts: &[String]) -> Self {
        Self(texts.iter().map(|text| (Severity::Doubtful, text.clone())).collect())
    }

    /// Adds one.
    pub fn push(&mut self, severity: Severity, text: impl Into<String>) {
        self.0.push((severity, text.into()));
    }

    /// Adds all of another.
    pub fn append(&mut self, other: Self) {
        self.0.extend(other.0);
    }

    /// The texts by severity; those of one severity in the order they came.
    pub fn into_texts(mut self) -> Vec<String> {
        self.0.sort_by_key(|(severity, _)| *severity);
        self.0.into_iter().map(|(_, text)| text).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gravest_come_first_and_equals_stay_in_order() {
        let mut warnings = Warnings::of_field(&["a".into(), "b".into()]);
        warnings.push(Severity::Known, "c");
        let mut more = Warnings::default();
        more.push(Severity::Broken, "d");
        more.push(Severity::Doubtful, "e");
        warnings.append(more);
        assert_eq!(warnings.into_texts(), ["d", "a", "b", "e", "c"]);
    }
}
