//! Numbers in fixed-column and free text, read from byte slices without allocation.
//!
//! A number ends where it can no longer go on, not at a blank: in `.frd` files neighbouring fields
//! touch each other, and three-digit exponents make a field one column wider than its format says.

/// Powers of ten that a double holds exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// Largest integer up to which a double holds every integer.
const EXACT_MANTISSA: u64 = 1 << 53;

/// `text` without leading blanks and tabs.
pub(super) fn skip_blanks(text: &[u8]) -> &[u8] {
    let blanks = text.iter().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
    &text[blanks..]
}

/// `text` without blanks and tabs on either side.
pub(super) fn trim(text: &[u8]) -> &[u8] {
    let text = skip_blanks(text);
    let blanks = text.iter().rev().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
    &text[..text.len() - blanks]
}

/// `text` without a byte-order mark.
pub(super) fn without_mark(text: &[u8]) -> &[u8] {
    text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text)
}

/// The integer that `text` begins with after blanks, and the rest.
pub(super) fn integer(text: &[u8]) -> Option<(i64, &[u8])> {
    let text = skip_blanks(text);
    let (negative, digits) = sign(text);
    let count = digits.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if count == 0 {
        return None;
    }
    let mut value = 0i64;
    for digit in &digits[..count] {
        value = value.checked_mul(10)?.checked_add(i64::from(digit - b'0'))?;
    }
    Some((if negative { -value } else { value }, &digits[count..]))
}

/// The integer that fills `text` apart from blanks.
pub(super) fn whole_integer(text: &[u8]) -> Option<i64> {
    let (value, rest) = integer(text)?;
    trim(rest).is_empty().then_some(value)
}

/// The number that `text` begins with after blanks, and the rest; `comma` takes a comma for the
/// decimal mark as well. Words for what is no number (`NaN`, `inf`, `****`, `1.#QNAN`) give NaN.
pub(super) fn number(text: &[u8], comma: bool) -> Option<(f64, &[u8])> {
    let text = skip_blanks(text);
    let (negative, body) = sign(text);
    let mantissa = Mantissa::scan(body, comma);
    if mantissa.digits == 0 || body.get(mantissa.length) == Some(&b'#') {
        return not_a_number(body);
    }
    let (exponent, used) = exponent(&body[mantissa.length..], mantissa.has_mark)?;
    let rest = &body[mantissa.length + used..];
    let power = exponent - mantissa.decimals;
    let value = mantissa.value(power).unwrap_or_else(|| {
        let digits: String =
            body[..mantissa.length].iter().filter(|b| b.is_ascii_digit()).map(|&b| char::from(b)).collect();
        fast_float2::parse(format!("{digits}e{power}")).unwrap_or(f64::NAN)
    });
    Some((if negative { -value } else { value }, rest))
}

/// The number that fills `text` apart from blanks.
pub(super) fn whole_number(text: &[u8], comma: bool) -> Option<f64> {
    let (value, rest) = number(text, comma)?;
    trim(rest).is_empty().then_some(value)
}

/// Up to 60 characters of a line, for messages.
pub(super) fn excerpt(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(&line[..line.len().min(60)]).into_owned();
    text.chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}

fn sign(text: &[u8]) -> (bool, &[u8]) {
    match text.first() {
        Some(b'-') => (true, &text[1..]),
        Some(b'+') => (false, &text[1..]),
        _ => (false, text),
    }
}

struct Mantissa {
    /// The digits as an integer; `None` once they no longer fit.
    integer: Option<u64>,
    digits: usize,
    decimals: i32,
    has_mark: bool,
    length: usize,
}

impl Mantissa {
    fn scan(body: &[u8], comma: bool) -> Self {
        let mut found = Self { integer: Some(0), digits: 0, decimals: 0, has_mark: false, length: 0 };
        for &byte in body {
            if byte.is_ascii_digit() {
                found.digits += 1;
                found.decimals += i32::from(found.has_mark);
                found.integer = found
                    .integer
                    .and_then(|value| value.checked_mul(10))
                    .and_then(|value| value.checked_add(u64::from(byte - b'0')));
            } else if !found.has_mark && (byte == b'.' || (comma && byte == b',')) {
                found.has_mark = true;
            } else {
                break;
            }
            found.length += 1;
        }
        found
    }

    /// The correctly rounded value times `10^power`, where one operation on exact doubles gives it.
    fn value(&self, power: i32) -> Option<f64> {
        let integer = self.integer.filter(|&value| value <= EXACT_MANTISSA)? as f64;
        let scale = *EXACT_POWERS.get(power.unsigned_abs() as usize)?;
        Some(if power < 0 { integer / scale } else { integer * scale })
    }
}

/// Decimal exponent at the start of `text` and the bytes it takes; `None` if it is cut off.
///
/// At most three digits belong to it: a fourth is the next field's.
fn exponent(text: &[u8], after_mark: bool) -> Option<(i32, usize)> {
    let lettered = matches!(text.first(), Some(b'E' | b'e' | b'D' | b'd'));
    let signed = text.get(usize::from(lettered)).filter(|byte| matches!(byte, b'+' | b'-'));
    let start = usize::from(lettered) + usize::from(signed.is_some());
    let digits = text[start..].iter().take(3).take_while(|byte| byte.is_ascii_digit()).count();
    if !lettered && !is_fortran_exponent(&text[start..], digits, after_mark && signed.is_some()) {
        return Some((0, 0));
    }
    if digits == 0 {
        return None;
    }
    let size =
        text[start..start + digits].iter().fold(0, |value, digit| value * 10 + i32::from(digit - b'0'));
    Some((if signed == Some(&b'-') { -size } else { size }, start + digits))
}

/// Fortran drops the letter of a three-digit exponent: `1.23456-103`.
fn is_fortran_exponent(digits: &[u8], count: usize, signed: bool) -> bool {
    signed && count == 3 && !matches!(digits.get(3), Some(b'.' | b',' | b'0'..=b'9'))
}

fn not_a_number(body: &[u8]) -> Option<(f64, &[u8])> {
    let length = body
        .iter()
        .take_while(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'#' | b'*' | b'.' | b'(' | b')'))
        .count();
    let word = body[..length].to_ascii_lowercase();
    let known = [&b"nan"[..], b"inf", b"1.#", b"*"].iter().any(|start| word.starts_with(start));
    known.then(|| (f64::NAN, &body[length..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Vec<f64> {
        let mut rest = text.as_bytes();
        let mut values = Vec::new();
        while let Some((value, after)) = number(rest, true) {
            values.push(value);
            rest = after;
        }
        assert!(trim(rest).is_empty(), "'{text}' left '{}'", String::from_utf8_lossy(rest));
        values
    }

    #[test]
    fn touching_fields_come_apart() {
        assert_eq!(all("-1.00000E+01-4.00000E+00 0.00000E+00"), [-10.0, -4.0, 0.0]);
        assert_eq!(all("1.23456E-003-1.23456E+0021.00000E+000"), [1.23456e-3, -123.456, 1.0]);
        assert_eq!(all(" 1,23456E-03-1,50000E+00"), [1.23456e-3, -1.5]);
        assert_eq!(all("1.23456-103 1.50000D+02"), [1.23456e-103, 150.0]);
        assert_eq!(all("3 -4. .5"), [3.0, -4.0, 0.5]);
    }

    #[test]
    fn values_are_rounded_like_the_standard_library() {
        for text in
            ["1.234567890123456789e-5", "9007199254740993", "2.2250738585072014e-308", "1e-30", "0.1", "7e22"]
        {
            assert_eq!(number(text.as_bytes(), false).unwrap().0, text.parse::<f64>().unwrap(), "{text}");
        }
        assert_eq!(number(b"1e999", false).unwrap().0, f64::INFINITY);
    }

    #[test]
    fn words_for_no_number_give_nan_and_garbage_gives_nothing() {
        for text in ["NaN", "-nan", "Inf", "-Infinity", "************", "1.#QNAN", "-1.#IND00"] {
            let (value, rest) = number(text.as_bytes(), false).unwrap_or_else(|| panic!("{text} not taken"));
            assert!(value.is_nan() && rest.is_empty(), "{text}");
        }
        for text in ["", "-", "abc", ".", "1.2E", "1.2E+"] {
            assert!(number(text.as_bytes(), false).is_none_or(|(value, _)| value.is_nan()), "{text}");
        }
    }

    #[test]
    fn integers_stop_at_the_first_other_byte_and_never_overflow() {
        assert_eq!(integer(b"   -17,2"), Some((-17, &b",2"[..])));
        assert_eq!(whole_integer(b" 12 "), Some(12));
        assert_eq!(whole_integer(b"12x"), None);
        assert_eq!(integer(b"99999999999999999999"), None);
    }
}
