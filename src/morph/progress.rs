//! How a caller follows the work and stops it.

use crate::error::{Error, Result};
use std::sync::{Mutex, PoisonError};

/// Called with the current stage and the overall fraction done; returning `false` cancels.
pub type Progress<'a> = &'a (dyn Fn(&str, f64) -> bool + Sync);

/// Tells the caller where the work is.
///
/// # Errors
/// [`Error::Cancelled`] where the caller wants it to stop.
pub fn tell(progress: Progress<'_>, stage: &str, fraction: f64) -> Result<()> {
    if progress(stage, fraction) { Ok(()) } else { Err(Error::Cancelled) }
}

/// A stage whose pieces are worked on by several threads at once. The caller hears of one after
/// the other, of a fraction that never falls, and of nothing more once it has cancelled.
pub struct Shared<'a> {
    progress: Progress<'a>,
    stage: &'a str,
    pieces: usize,
    /// Pieces done; none once cancelled.
    done: Mutex<Option<usize>>,
}

impl<'a> Shared<'a> {
    /// A stage of so many pieces.
    pub fn new(progress: Progress<'a>, stage: &'a str, pieces: usize) -> Self {
        Self { progress, stage, pieces, done: Mutex::new(Some(0)) }
    }

    /// Tells the caller that a piece goes on.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the caller wants the work to stop, or has wanted so.
    pub fn goes_on(&self) -> Result<()> {
        self.tell(0)
    }

    /// Tells the caller that one more piece is done.
    ///
    /// # Errors
    /// As [`Shared::goes_on`].
    pub fn piece_done(&self) -> Result<()> {
        self.tell(1)
    }

    fn tell(&self, more: usize) -> Result<()> {
        let mut state = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        let done = state.ok_or(Error::Cancelled)? + more;
        let told = tell(self.progress, self.stage, done as f64 / self.pieces as f64);
        *state = told.is_ok().then_some(done);
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    /// Works on a hundred pieces; cancels at a call, and gives the fractions heard.
    fn heard(cancel_at: usize) -> (Result<()>, Vec<f64>) {
        let heard = Mutex::new(Vec::new());
        let listen = |_: &str, fraction: f64| {
            let mut heard = heard.lock().unwrap();
            heard.push(fraction);
            heard.len() != cancel_at
        };
        let stage = Shared::new(&listen, "work", 100);
        let piece = |_| stage.goes_on().and_then(|()| stage.piece_done());
        let result = (0..100).into_par_iter().try_for_each(piece);
        (result, heard.into_inner().unwrap())
    }

    #[test]
    fn fractions_rise_to_one_whatever_the_threads_do() {
        let (result, heard) = heard(0);
        assert_eq!((result, heard.len()), (Ok(()), 200));
        assert!(heard.is_sorted() && heard.last() == Some(&1.0), "{heard:?}");
    }

    #[test]
    fn nothing_is_heard_after_a_cancel() {
        let (result, heard) = heard(7);
        assert_eq!((result, heard.len()), (Err(Error::Cancelled), 7));
    }
}
