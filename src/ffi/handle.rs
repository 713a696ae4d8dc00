//! Opaque handles and single outputs behind pointers.

use super::slice::check_pointer;
use crate::error::{Error, Result};

/// Borrows what a handle stands for.
///
/// # Safety
/// `handle` is NULL or came from this library as a `T` and has not been freed.
pub(super) unsafe fn borrow<'a, T>(handle: *const T, name: &'static str) -> Result<&'a T> {
    // SAFETY: promised by the caller; handles are never written to once given out.
    let inside = unsafe { handle.as_ref() };
    inside
        .ok_or(Error::Argument { name, why: "is NULL; pass a handle that was returned with status 0".into() })
}

/// Drops what a handle stands for; NULL is fine.
///
/// # Safety
/// As for [`borrow`]; nobody uses the handle any more.
pub(super) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: every handle is a leaked box.
        drop(unsafe { Box::from_raw(handle) });
    }
}

/// A checked place for one output, written only on success.
pub(super) struct Out<T>(*mut T);

impl<T> Out<T> {
    /// Checks that there is a place to write to.
    ///
    /// # Safety
    /// `place` is NULL or has room for one `T`.
    pub(super) unsafe fn new(place: *mut T, name: &'static str) -> Result<Self> {
        check_pointer(place, 1, name)?;
        Ok(Self(place))
    }

    /// Writes the output.
    pub(super) fn write(&self, value: T) {
        // SAFETY: checked for NULL and alignment in `new`, where the caller promised the room.
        unsafe { self.0.write(value) };
    }
}

impl<T> Out<*mut T> {
    /// Hands a value over to the caller as a handle.
    pub(super) fn hand_over(self, value: T) {
        self.write(Box::into_raw(Box::new(value)));
    }
}
