//! A results or mesh file as a stream of lines, unpacked on the way if it is gzipped.
//!
//! Only a chunk of the file is in memory at a time, so its size does not matter.

use crate::error::{Error, Result};
use flate2::bufread::MultiGzDecoder;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::path::Path;

/// Bytes read at a time.
const CHUNK: usize = 1 << 18;

/// Longer lines mean that the file is not text.
const LONGEST_LINE: usize = 1 << 16;

/// Other ways of packing, by their first bytes.
const FOREIGN_PACKING: [(&[u8], &str); 4] =
    [(b"PK\x03\x04", "zip"), (b"BZh", "bzip2"), (b"\xfd7zXZ", "xz"), (b"\x28\xb5\x2f\xfd", "zstd")];

/// Lines and binary records of a file.
pub(super) struct Input {
    path: String,
    source: Box<dyn Read + Send>,
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    exhausted: bool,
    compressed: bool,
    line: usize,
    line_start: usize,
    unterminated: bool,
}

impl Input {
    /// Opens a file; gzip is recognised by its content.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be opened, [`Error::Field`] if it is packed in another way.
    pub fn open(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let io = |cause: std::io::Error| Error::io(&name, &cause);
        let mut file = BufReader::with_capacity(CHUNK, File::open(path).map_err(io)?);
        let head = file.fill_buf().map_err(io)?;
        if let Some((_, packing)) = FOREIGN_PACKING.iter().find(|(magic, _)| head.starts_with(magic)) {
            let why = format!("packed with {packing}; unpack it, or pack it with gzip");
            return Err(Error::Field { path: name, line: 0, why });
        }
        let compressed = head.starts_with(&[0x1f, 0x8b]);
        let source: Box<dyn Read + Send> =
            if compressed { Box::new(MultiGzDecoder::new(file)) } else { Box::new(file) };
        Ok(Self::new(name, source, compressed))
    }

    fn new(path: String, source: Box<dyn Read + Send>, compressed: bool) -> Self {
        Self {
            path,
            source,
            buffer: vec![0; CHUNK],
            start: 0,
            end: 0,
            exhausted: false,
            compressed,
            line: 0,
            line_start: 0,
            unterminated: false,
        }
    }

    /// The file's name, for messages.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Whether the file is gzipped.
    pub fn compressed(&self) -> bool {
        self.compressed
    }

    /// Number of the line last read, from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// Whether the line last read has no line end: the file stops there.
    pub fn unterminated(&self) -> bool {
        self.unterminated
    }

    /// An error at the line last read.
    pub fn error(&self, why: impl Into<String>) -> Error {
        Error::Field { path: self.path.clone(), line: self.line, why: why.into() }
    }

    /// The next line without its line end, or `None` at the end of the file.
    pub fn next_line(&mut self) -> Result<Option<&[u8]>> {
        let mut scanned = 0;
        let length = loop {
            let window = &self.buffer[self.start + scanned..self.end];
            if let Some(offset) = memchr::memchr(b'\n', window) {
                break scanned + offset;
            }
            scanned += window.len();
            if scanned > LONGEST_LINE {
                self.line += 1;
                return Err(self.error(format!("no line end within {LONGEST_LINE} bytes: not a text file")));
            }
            if !self.fill()? {
                break scanned;
            }
        };
        self.unterminated = self.start + length == self.end;
        if self.unterminated && length == 0 {
            return Ok(None);
        }
        self.line += 1;
        self.line_start = self.start;
        let line = &self.buffer[self.start..self.start + length];
        self.start += length + usize::from(!self.unterminated);
        Ok(Some(line.strip_suffix(b"\r").unwrap_or(line)))
    }

    /// Makes the line last read the next one again.
    pub fn put_back(&mut self) {
        self.start = self.line_start;
        self.line -= 1;
    }

    /// The next `size` bytes (at most a chunk), or `None` if the file ends before.
    pub fn take(&mut self, size: usize) -> Result<Option<&[u8]>> {
        while self.end - self.start < size {
            if !self.fill()? {
                return Ok(None);
            }
        }
        let bytes = &self.buffer[self.start..self.start + size];
        self.start += size;
        Ok(Some(bytes))
    }

    /// What lies behind an error in the content: a damaged archive, if the rest cannot be unpacked.
    pub fn deeper_cause(&mut self, error: Error) -> Error {
        while self.compressed && matches!(error, Error::Field { .. }) {
            self.start = self.end;
            match self.fill() {
                Ok(true) => (),
                Ok(false) => break,
                Err(damage) => return damage,
            }
        }
        error
    }

    /// Reads on behind what is not yet used; `false` at the end of the file.
    fn fill(&mut self) -> Result<bool> {
        if self.exhausted {
            return Ok(false);
        }
        self.buffer.copy_within(self.start..self.end, 0);
        self.end -= self.start;
        self.start = 0;
        let read = loop {
            match self.source.read(&mut self.buffer[self.end..]) {
                Err(cause) if cause.kind() == ErrorKind::Interrupted => (),
                Err(cause) => return Err(self.read_error(&cause)),
                Ok(read) => break read,
            }
        };
        self.end += read;
        self.exhausted = read == 0;
        Ok(read > 0)
    }

    fn read_error(&self, cause: &std::io::Error) -> Error {
        let why = match cause.kind() {
            ErrorKind::UnexpectedEof => {
                "the gzipped file ends early: it is truncated; copy it again".to_string()
            }
            _ if self.compressed => format!("the gzipped file is damaged ({cause}); copy it again"),
            _ => return Error::io(&self.path, cause),
        };
        Error::Field { path: self.path.clone(), line: 0, why }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hands out one byte at a time, the hardest case for chunk borders.
    struct Trickle(Vec<u8>, usize);

    impl Read for Trickle {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let Some(&byte) = self.0.get(self.1) else { return Ok(0) };
            buffer[0] = byte;
            self.1 += 1;
            Ok(1)
        }
    }

    fn trickle(text: &str) -> Input {
        Input::new("test".into(), Box::new(Trickle(text.into(), 0)), false)
    }

    #[test]
    fn lines_come_whole_whatever_the_chunks_and_line_ends() {
        let mut input = trickle("one\r\n\ntwo\nlast");
        for expected in ["one", "", "two", "last"] {
            assert!(!input.unterminated());
            assert_eq!(input.next_line().unwrap(), Some(expected.as_bytes()));
        }
        assert!(input.unterminated());
        assert_eq!(input.next_line().unwrap(), None);
        assert_eq!(input.line(), 4);
    }

    #[test]
    fn a_line_put_back_comes_again_and_bytes_can_be_taken_between_lines() {
        let mut input = trickle("head\nabcdetail\n");
        input.next_line().unwrap();
        input.put_back();
        assert_eq!(input.next_line().unwrap(), Some(&b"head"[..]));
        assert_eq!(input.take(3).unwrap(), Some(&b"abc"[..]));
        assert_eq!(input.next_line().unwrap(), Some(&b"detail"[..]));
        assert_eq!(input.take(1).unwrap(), None);
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let why = trickle(&"x".repeat(LONGEST_LINE + 2)).next_line().unwrap_err().to_string();
        assert!(why.contains("not a text file"), "{why}");
    }
}
