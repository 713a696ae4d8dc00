//! Calls from the library back into C: progress and cancellation.

use super::text::c_text;
use crate::error::{Error, Result};
use crate::morph;
use std::ffi::{c_char, c_void};
use std::panic::resume_unwind;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

/// Called now and then during long work with the pointer that was handed in, the current stage
/// (English, valid during the call) and the fraction of the whole work that is done, from 0 to 1.
/// Return 0 to go on; anything else cancels: it is then not called again, and the work ends soon
/// with BLADESMITH_STATUS_CANCELLED. It runs on the thread that started the work, which waits for
/// it: be brief, call nothing that throws or jumps out of it, and free no handle in use.
pub type Progress =
    Option<unsafe extern "C" fn(user: *mut c_void, stage: *const c_char, fraction: f64) -> i32>;

/// Runs `work` on another thread while this one makes the calls it asks for.
///
/// # Errors
/// Those of `work`; [`Error::Cancelled`] if a call returned non-zero, whatever `work` made of it.
///
/// # Safety
/// `callback` may be called with `user` until this returns.
pub(super) unsafe fn follow<T: Send>(
    callback: Progress,
    user: *mut c_void,
    work: impl FnOnce(morph::Progress<'_>) -> Result<T> + Send,
) -> Result<T> {
    let Some(callback) = callback else { return work(&|_, _| true) };
    let (ask, asked) = mpsc::channel::<(String, f64)>();
    let (reply, answer) = mpsc::channel::<bool>();
    let cancelled = AtomicBool::new(false);
    let stopped = &cancelled;
    std::thread::scope(|scope| {
        let worker = scope.spawn(move || {
            let line = Mutex::new((ask, answer));
            work(&move |stage, fraction| consult(&line, stopped, stage, fraction))
        });
        for (stage, fraction) in asked {
            // SAFETY: promised by the caller of this function.
            let go_on = unsafe { callback(user, c_text(&stage).as_ptr(), fraction) } == 0;
            cancelled.fetch_or(!go_on, Ordering::Relaxed);
            // A worker that panicked meanwhile takes no answer; joining it tells.
            let _ = reply.send(go_on);
        }
        let result = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
        if cancelled.load(Ordering::Relaxed) { Err(Error::Cancelled) } else { result }
    })
}

/// Where a worker asks, with stage and fraction, and where it hears whether to go on.
type Line = (mpsc::Sender<(String, f64)>, mpsc::Receiver<bool>);

/// One question to the calling thread and its answer; `false` once it has said so.
fn consult(line: &Mutex<Line>, stopped: &AtomicBool, stage: &str, fraction: f64) -> bool {
    let Ok(line) = line.lock() else { return false };
    if stopped.load(Ordering::Relaxed) {
        return false;
    }
    line.0.send((stage.to_owned(), fraction)).is_ok() && line.1.recv().unwrap_or(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    struct Seen {
        thread: std::thread::ThreadId,
        calls: usize,
        cancel_at: usize,
    }

    unsafe extern "C" fn count(user: *mut c_void, _stage: *const c_char, fraction: f64) -> i32 {
        // SAFETY: the tests pass a `Seen`.
        let seen = unsafe { &mut *user.cast::<Seen>() };
        assert_eq!(seen.thread, std::thread::current().id());
        assert!((0.0..=1.0).contains(&fraction));
        seen.calls += 1;
        i32::from(seen.calls == seen.cancel_at)
    }

    fn run(cancel_at: usize) -> (Result<usize>, usize) {
        let mut seen = Seen { thread: std::thread::current().id(), calls: 0, cancel_at };
        let user = (&raw mut seen).cast();
        // SAFETY: `seen` outlives the call.
        let result = unsafe {
            follow(Some(count), user, |progress| {
                Ok((0..100).into_par_iter().filter(|&i| progress("fit", i as f64 / 100.0)).count())
            })
        };
        (result, seen.calls)
    }

    #[test]
    fn calls_from_many_threads_arrive_on_the_calling_one() {
        assert_eq!(run(0), (Ok(100), 100));
    }

    #[test]
    fn after_a_cancel_nothing_is_called_and_the_work_counts_as_cancelled() {
        assert_eq!(run(7), (Err(Error::Cancelled), 7));
    }

    #[test]
    #[should_panic(expected = "inside the work")]
    fn a_panic_in_the_work_reaches_the_caller() {
        let mut seen = Seen { thread: std::thread::current().id(), calls: 0, cancel_at: 0 };
        // SAFETY: `seen` outlives the call.
        let _ = unsafe { follow::<()>(Some(count), (&raw mut seen).cast(), |_| panic!("inside the work")) };
    }
}
