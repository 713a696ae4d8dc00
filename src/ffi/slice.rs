//! Arrays and texts into and arrays out of the library.

use crate::error::{Error, Result};
use std::ffi::{CStr, c_char};
use std::path::PathBuf;
#[cfg(unix)]
use std::{ffi::OsStr, os::unix::ffi::OsStrExt};

/// Checks an array that starts at `pointer`: NULL only when it is empty, aligned, and no longer
/// than memory can be.
pub(super) fn check_pointer<T>(pointer: *const T, length: usize, name: &'static str) -> Result<()> {
    let refuse = |why: String| Err(Error::Argument { name, why });
    if length == 0 {
        return Ok(());
    }
    if pointer.is_null() {
        return refuse(format!("is NULL, but {length} value(s) are expected there"));
    }
    if !pointer.is_aligned() {
        return refuse(format!("is not aligned to {} bytes", align_of::<T>()));
    }
    match length.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => refuse(format!("cannot hold {length} values: that is more than the address space")),
    }
}

/// `points` times the numbers each takes.
///
/// # Errors
/// [`Error::Argument`] where the product overflows.
pub(super) fn total(points: usize, each: usize, name: &'static str) -> Result<usize> {
    points.checked_mul(each).ok_or_else(|| Error::Argument {
        name,
        why: format!("{points} times {each} values is more than the address space"),
    })
}

/// An array of the caller.
///
/// # Safety
/// If not NULL, `pointer` must point to `length` values that nobody changes meanwhile.
pub(super) unsafe fn slice<'a, T>(pointer: *const T, length: usize, name: &'static str) -> Result<&'a [T]> {
    check_pointer(pointer, length, name)?;
    if length == 0 {
        return Ok(&[]);
    }
    // SAFETY: not NULL, aligned, not too long; the rest is promised by the caller.
    Ok(unsafe { std::slice::from_raw_parts(pointer, length) })
}

/// An array of the caller to be filled; NULL takes nothing.
pub(super) struct ArrayOut<T> {
    start: *mut T,
    length: usize,
}

impl<T> ArrayOut<T> {
    /// Checks the array.
    ///
    /// # Safety
    /// If not NULL, `start` must have room for `length` values.
    pub(super) unsafe fn new(start: *mut T, length: usize, name: &'static str) -> Result<Self> {
        if start.is_null() {
            return Ok(Self { start, length: 0 });
        }
        check_pointer(start, length, name)?;
        Ok(Self { start, length })
    }

    /// Writes the values one after the other, as many as there is room for.
    pub(super) fn fill(self, values: impl IntoIterator<Item = T>) {
        for (i, value) in values.into_iter().take(self.length).enumerate() {
            // SAFETY: `i` is below the length, for which `new` was promised room.
            unsafe { self.start.add(i).write(value) };
        }
    }
}

/// The bytes of a NUL-terminated text; NULL is `None`.
///
/// # Safety
/// If not NULL, `pointer` must point to a NUL-terminated text.
unsafe fn c_bytes<'a>(pointer: *const c_char) -> Option<&'a [u8]> {
    // SAFETY: promised by the caller.
    (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) }.to_bytes())
}

/// A NUL-terminated UTF-8 text; NULL is `None`.
///
/// # Safety
/// As for [`c_bytes`].
pub(super) unsafe fn text<'a>(pointer: *const c_char, name: &'static str) -> Result<Option<&'a str>> {
    // SAFETY: promised by the caller.
    let bytes = unsafe { c_bytes(pointer) };
    bytes.map(std::str::from_utf8).transpose().map_err(|error| Error::Argument {
        name,
        why: format!("is not UTF-8 after its first {} bytes", error.valid_up_to()),
    })
}

/// A file name; NULL is `None`. Where names are bytes to the system they are taken as they come.
///
/// # Safety
/// As for [`c_bytes`].
pub(super) unsafe fn file_name(pointer: *const c_char, name: &'static str) -> Result<Option<PathBuf>> {
    // SAFETY: promised by the caller.
    #[cfg(unix)]
    let path = unsafe { c_bytes(pointer) }.map(|bytes| PathBuf::from(OsStr::from_bytes(bytes)));
    // SAFETY: promised by the caller.
    #[cfg(not(unix))]
    let path = unsafe { text(pointer, name) }?.map(PathBuf::from);
    if path.as_ref().is_some_and(|path| path.as_os_str().is_empty()) {
        return Err(Error::Argument { name, why: "is empty; pass a file name".into() });
    }
    Ok(path)
}

/// Refuses values that are not finite.
pub(super) fn finite(values: &[f64], each: usize, name: &'static str) -> Result<()> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => Err(Error::Argument {
            name,
            why: format!(
                "value {} of point {} is {}; only finite numbers can be used",
                at % each + 1,
                at / each + 1,
                values[at]
            ),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_is_null_only_when_empty() {
        // SAFETY: NULL is never read.
        let (none, some) =
            unsafe { (slice::<f64>(std::ptr::null(), 0, "xyz"), slice::<f64>(std::ptr::null(), 3, "xyz")) };
        assert_eq!(none, Ok(&[][..]));
        assert_eq!(
            some.unwrap_err().to_string(),
            "argument 'xyz': is NULL, but 3 value(s) are expected there"
        );
    }

    #[test]
    fn lengths_beyond_memory_are_refused() {
        let one = 1.0_f64;
        assert!(check_pointer(&one, usize::MAX / 8, "uv").is_err());
        assert!(check_pointer(&one, usize::MAX / 4, "uv").is_err());
        assert!(total(usize::MAX / 2, 3, "uv").is_err());
    }

    #[test]
    fn misaligned_arrays_are_refused() {
        let values = [0.0_f64; 2];
        let off = values.as_ptr().wrapping_byte_add(1);
        assert!(check_pointer(off, 1, "uv").unwrap_err().to_string().contains("aligned to 8 bytes"));
    }

    #[test]
    fn what_is_not_finite_is_named_by_point() {
        let why = finite(&[0.0, 1.0, 2.0, f64::NAN], 2, "uv").unwrap_err().to_string();
        assert_eq!(why, "argument 'uv': value 2 of point 2 is NaN; only finite numbers can be used");
    }
}
