//! Tokens of a B-rep text, with errors that name the line.

use crate::error::{Error, Result};

/// Reads whitespace-separated tokens.
pub(super) struct Scanner<'a> {
    name: &'a str,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Scanner<'a> {
    pub fn new(name: &'a str, text: &'a str) -> Self {
        Self { name, bytes: text.as_bytes(), at: 0 }
    }

    /// Goes on at byte `at`.
    pub fn jump(&mut self, at: usize) {
        self.at = at;
    }

    /// Where the next token starts.
    pub fn mark(&mut self) -> usize {
        self.skip_space();
        self.at
    }

    /// An error at the next token.
    pub fn fail<T>(&mut self, why: impl std::fmt::Display) -> Result<T> {
        let at = self.mark();
        self.fail_at(at, why)
    }

    /// An error at a marked place.
    pub fn fail_at<T>(&self, at: usize, why: impl std::fmt::Display) -> Result<T> {
        let line = 1 + memchr::memchr_iter(b'\n', &self.bytes[..at]).count();
        Err(Error::Brep { name: self.name.into(), line, why: why.to_string() })
    }

    /// Gives the error of something built from what stands at a marked place its line.
    pub fn locate<T>(&self, at: usize, result: Result<T>) -> Result<T> {
        match result {
            Err(Error::Spline { why }) => self.fail_at(at, why),
            other => other,
        }
    }

    fn expected<T>(&mut self, what: &str) -> Result<T> {
        let token = self.peek();
        let shown = String::from_utf8_lossy(&token[..token.len().min(40)]).into_owned();
        match shown.as_str() {
            "" => self.fail(format!("expected {what}, but the text ends")),
            _ => self.fail(format!("expected {what}, found '{shown}'")),
        }
    }

    fn skip_space(&mut self) {
        while self.bytes.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    /// The next token, empty at the end; it is not taken.
    pub fn peek(&mut self) -> &'a [u8] {
        self.skip_space();
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        &rest[..end]
    }

    /// The next token; `what` names it in the error at the end of the text.
    pub fn token(&mut self, what: &str) -> Result<&'a [u8]> {
        let token = self.peek();
        if token.is_empty() {
            return self.expected(what);
        }
        self.at += token.len();
        Ok(token)
    }

    /// Exactly this word.
    pub fn keyword(&mut self, word: &str) -> Result<()> {
        if self.peek() != word.as_bytes() {
            return self.expected(&format!("'{word}'"));
        }
        self.at += word.len();
        Ok(())
    }

    /// A finite number.
    pub fn real(&mut self, what: &str) -> Result<f64> {
        self.skip_space();
        let rest = &self.bytes[self.at..];
        match fast_float2::parse_partial::<f64, _>(rest) {
            Ok((value, n)) if value.is_finite() && rest.get(n).is_none_or(u8::is_ascii_whitespace) => {
                self.at += n;
                Ok(value)
            }
            _ => self.expected(&format!("a finite number for {what}")),
        }
    }

    /// Several finite numbers.
    pub fn reals<const N: usize>(&mut self, what: &str) -> Result<[f64; N]> {
        let mut out = [0.0; N];
        for x in &mut out {
            *x = self.real(what)?;
        }
        Ok(out)
    }

    /// A number that must be positive or zero, as radii and tolerances.
    pub fn length(&mut self, what: &str) -> Result<f64> {
        let at = self.mark();
        let value = self.real(what)?;
        if value < 0.0 {
            return self.fail_at(at, format!("{what} is {value}: it must not be negative"));
        }
        Ok(value)
    }

    /// An integer; it ends at the first byte that is no digit.
    pub fn integer(&mut self, what: &str) -> Result<i64> {
        self.skip_space();
        let rest = &self.bytes[self.at..];
        let sign = usize::from(matches!(rest.first(), Some(b'-' | b'+')));
        let digits = rest[sign..].iter().take_while(|b| b.is_ascii_digit()).count();
        let text = std::str::from_utf8(&rest[..sign + digits]).unwrap_or("");
        match text.parse() {
            Ok(value) => {
                self.at += sign + digits;
                Ok(value)
            }
            Err(_) => self.expected(&format!("an integer for {what}")),
        }
    }

    /// An integer within `range`.
    pub fn integer_in(&mut self, what: &str, range: std::ops::RangeInclusive<i64>) -> Result<usize> {
        let at = self.mark();
        let value = self.integer(what)?;
        if !range.contains(&value) {
            let (low, high) = (range.start(), range.end());
            return self.fail_at(at, format!("{what} is {value}: it must lie within {low} to {high}"));
        }
        Ok(value as usize)
    }

    /// 0 or 1.
    pub fn flag(&mut self, what: &str) -> Result<bool> {
        Ok(self.integer_in(what, 0..=1)? == 1)
    }

    /// A number from 1 to `count`, as an index from 0.
    pub fn index(&mut self, what: &str, count: usize) -> Result<usize> {
        let at = self.mark();
        let value = self.integer(what)?;
        match usize::try_from(value) {
            Ok(n) if n >= 1 && n <= count => Ok(n - 1),
            _ => self.fail_at(at, format!("{what} {value} does not exist: there are {count}")),
        }
    }

    /// How many of something follow, each of which takes at least `width` numbers of the text.
    pub fn count(&mut self, what: &str, width: usize) -> Result<usize> {
        let at = self.mark();
        let value = self.integer(what)?;
        let room = (self.bytes.len() - self.at) / (2 * width);
        match usize::try_from(value) {
            Ok(n) if n <= room => Ok(n),
            _ => self.fail_at(at, format!("{value} is no possible number of {what} in the rest of the text")),
        }
    }
}
