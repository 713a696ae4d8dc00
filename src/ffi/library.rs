//! What the library says about itself.

use super::guard;
use std::ffi::c_char;

/// Number of the binary interface this header describes. It changes only when a program compiled
/// against an older header could no longer run; it is also the number in the so-name.
pub const BLADESMITH_ABI_VERSION: u32 = 1;

/// Number of the binary interface of the loaded library: compare it with BLADESMITH_ABI_VERSION
/// before any other call.
///
/// Errors: none.
#[unsafe(no_mangle)]
pub extern "C" fn bladesmith_abi_version() -> u32 {
    BLADESMITH_ABI_VERSION
}

/// Release of the loaded library, such as "0.1.0".
///
/// Owner: the library; valid for ever.
/// Errors: none.
#[unsafe(no_mangle)]
pub extern "C" fn bladesmith_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Why the last call on this thread that returns a status failed; "" after a success. English in
/// UTF-8: what was expected, what came, what to do.
///
/// Owner: the library; valid until the next call on this thread that returns a status. All
/// other functions leave it alone, so what is no longer needed may be freed before reading it.
/// Errors: none; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn bladesmith_last_error() -> *const c_char {
    guard::last_error()
}
