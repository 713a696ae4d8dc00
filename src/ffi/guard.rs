//! The way in and out of every exported function: no panic reaches C, and the text of the last
//! failure is kept for the thread that saw it.

use super::status::{Failure, Outcome, Status};
use super::text::c_text;
use crate::error::Error;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static LAST_ERROR: RefCell<Option<CString>> = const { RefCell::new(None) };
}

/// Runs the inside of a call that returns a status.
pub(super) fn guard(call: impl FnOnce() -> Outcome) -> i32 {
    set_last_error(None);
    let failure = match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(())) => return Status::Ok as i32,
        Ok(Err(failure)) => failure,
        Err(payload) => Failure::Core(Error::Internal { why: panic_text(payload.as_ref()) }),
    };
    let (code, message) = failure.describe();
    set_last_error(Some(c_text(&message)));
    code
}

/// Runs the inside of a call that returns nothing and leaves the last error alone, so that a
/// caller may clean up before reading it.
pub(super) fn guard_silent(call: impl FnOnce()) {
    // The payload itself could panic when dropped; it holds nothing worth that.
    if let Err(payload) = catch_unwind(AssertUnwindSafe(call)) {
        std::mem::forget(payload);
    }
}

/// Text of this thread's last failure; valid until its next call that returns a status.
pub(super) fn last_error() -> *const c_char {
    // While a thread is being torn down its text is gone.
    LAST_ERROR
        .try_with(|text| text.borrow().as_ref().map_or(c"".as_ptr(), |text| text.as_ptr()))
        .unwrap_or(c"".as_ptr())
}

fn set_last_error(text: Option<CString>) {
    let _ = LAST_ERROR.try_with(|last| *last.borrow_mut() = text);
}

fn panic_text(payload: &(dyn Any + Send)) -> String {
    let said = payload.downcast_ref::<&str>().copied();
    let said = said.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    said.unwrap_or("a panic without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    fn last_text() -> String {
        // SAFETY: the text is this thread's and nothing changes it before it is copied.
        unsafe { CStr::from_ptr(last_error()) }.to_str().unwrap().to_owned()
    }

    #[test]
    fn a_panic_becomes_status_900_with_its_message() {
        assert_eq!(guard(|| panic!("knot {} is missing", 7)), 900);
        assert_eq!(last_text(), "internal error: knot 7 is missing");
    }

    #[test]
    fn success_clears_the_text_of_an_earlier_failure() {
        assert_eq!(guard(|| Err(Error::Cancelled.into())), 10);
        assert_eq!(last_text(), "cancelled");
        assert_eq!(guard(|| Ok(())), 0);
        assert_eq!(last_text(), "");
    }

    #[test]
    fn the_text_is_the_threads_own() {
        assert_eq!(guard(|| Err(Error::Cancelled.into())), 10);
        assert_eq!(std::thread::spawn(last_text).join().unwrap(), "");
        assert_eq!(last_text(), "cancelled");
    }

    #[test]
    fn silent_calls_keep_the_text() {
        assert_eq!(guard(|| Err(Error::Cancelled.into())), 10);
        guard_silent(|| panic!("while freeing"));
        assert_eq!(last_text(), "cancelled");
    }
}
