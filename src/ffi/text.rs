//! Texts out of the library: (buffer, capacity, length), and C strings.

use super::handle::Out;
use super::slice::check_pointer;
use super::status::{Failure, Outcome};
use crate::error::{Error, Result};
use serde::Serialize;
use std::ffi::{CString, c_char};
use std::sync::OnceLock;

/// A text as a C string; a NUL inside, which C would take for the end, is left out.
pub(super) fn c_text(text: &str) -> CString {
    let bytes: Vec<u8> = text.bytes().filter(|&byte| byte != 0).collect();
    CString::new(bytes).unwrap_or_default()
}

/// A JSON text made when it is first asked for: callers ask for its length, then for the text.
#[derive(Default)]
pub(super) struct Json(OnceLock<String>);

impl Json {
    /// The text, made from what `content` gives.
    ///
    /// # Errors
    /// Those of `content`.
    pub(super) fn of<T: Serialize>(&self, content: impl FnOnce() -> Result<T>) -> Result<&str> {
        if let Some(text) = self.0.get() {
            return Ok(text);
        }
        let text = serde_json::to_string_pretty(&content()?)
            .map_err(|error| Error::Internal { why: format!("writing JSON: {error}") })?;
        Ok(self.0.get_or_init(|| text))
    }
}

/// Where a caller wants a text.
pub(super) struct TextOut {
    buffer: *mut c_char,
    capacity: usize,
    length: Out<usize>,
}

impl TextOut {
    /// Checks the three arguments; `capacity` 0 only asks for the length.
    ///
    /// # Safety
    /// `buffer` must have room for `capacity` bytes and `length` for one number.
    pub(super) unsafe fn new(buffer: *mut c_char, capacity: usize, length: *mut usize) -> Result<Self> {
        check_pointer(buffer, capacity, "buffer")?;
        // SAFETY: promised by the caller.
        let length = unsafe { Out::new(length, "length") }?;
        Ok(Self { buffer, capacity, length })
    }

    /// Sets the length; copies the text with a NUL at its end if it fits and was asked for.
    pub(super) fn write(self, text: &str) -> Outcome {
        let needed = text.len() + 1;
        self.length.write(text.len());
        if self.capacity == 0 {
            return Ok(());
        }
        if self.capacity < needed {
            return Err(Failure::TooSmall { capacity: self.capacity, needed, unit: "bytes" });
        }
        // SAFETY: the buffer has room for `needed` bytes and belongs to the caller, so it does
        // not overlap with a text of ours.
        unsafe {
            self.buffer.copy_from_nonoverlapping(text.as_ptr().cast(), text.len());
            self.buffer.add(text.len()).write(0);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ask(text: &str, buffer: &mut [u8]) -> (Outcome, usize) {
        let mut length = usize::MAX;
        // SAFETY: buffer and length are ours.
        let out = unsafe { TextOut::new(buffer.as_mut_ptr().cast(), buffer.len(), &mut length) };
        (out.unwrap().write(text), length)
    }

    proptest! {
        #[test]
        fn a_buffer_is_filled_whole_or_left_alone(text in ".{0,20}", capacity in 0usize..90) {
            let mut buffer = vec![b'#'; capacity];
            let (outcome, length) = ask(&text, &mut buffer);
            prop_assert_eq!(length, text.len());
            if capacity > text.len() {
                prop_assert!(outcome.is_ok());
                prop_assert_eq!(&buffer[..length], text.as_bytes());
                prop_assert_eq!(buffer[length], 0);
                prop_assert!(buffer[length + 1..].iter().all(|&byte| byte == b'#'));
            } else {
                prop_assert_eq!(outcome.is_ok(), capacity == 0);
                prop_assert!(buffer.iter().all(|&byte| byte == b'#'));
            }
        }
    }

    #[test]
    fn a_nul_inside_does_not_cut_a_message() {
        assert_eq!(c_text("face\0 7").as_c_str(), c"face 7");
    }
}
