//! Words of a large text, one after the other, without holding the text.

use std::io::{self, Read};

/// A word and the line it stands on.
#[derive(Debug, PartialEq)]
pub(super) struct Token<'a> {
    pub text: &'a [u8],
    pub line: u64,
}

/// Splits a text at white space; lines may end as on Windows.
pub(super) struct Tokens<R> {
    reader: R,
    buffer: Vec<u8>,
    /// The part of the buffer that is not yet used.
    start: usize,
    end: usize,
    line: u64,
}

/// Longer words are cut here: no number is that long, and memory stays bounded.
const LONGEST: usize = 1 << 10;

impl<R: Read> Tokens<R> {
    pub fn new(reader: R) -> Self {
        Self { reader, buffer: vec![0; 1 << 18], start: 0, end: 0, line: 1 }
    }

    /// The line of the last word, or of the end of the text.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// The next word; `None` at the end of the text.
    pub fn next(&mut self) -> io::Result<Option<Token<'_>>> {
        if !self.skip_space()? {
            return Ok(None);
        }
        let mut length = 0;
        loop {
            let word = &self.buffer[self.start..self.end];
            let rest = &word[length..];
            if let Some(more) = rest.iter().position(u8::is_ascii_whitespace) {
                length += more;
                break;
            }
            length = word.len();
            if length >= LONGEST || !self.refill()? {
                break;
            }
        }
        let first = self.start;
        self.start += length;
        Ok(Some(Token { text: &self.buffer[first..first + length], line: self.line }))
    }

    /// Moves to the next word; `false` at the end of the text.
    fn skip_space(&mut self) -> io::Result<bool> {
        loop {
            while self.start < self.end {
                let byte = self.buffer[self.start];
                if !byte.is_ascii_whitespace() {
                    return Ok(true);
                }
                self.line += u64::from(byte == b'\n');
                self.start += 1;
            }
            if !self.refill()? {
                return Ok(false);
            }
        }
    }

    /// Moves the unused part to the front and reads more; `false` at the end of the text.
    fn refill(&mut self) -> io::Result<bool> {
        self.buffer.copy_within(self.start..self.end, 0);
        self.end -= self.start;
        self.start = 0;
        loop {
            match self.reader.read(&mut self.buffer[self.end..]) {
                Ok(count) => {
                    self.end += count;
                    return Ok(count > 0);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reader that gives one byte at a time.
    struct Slow<'a>(&'a [u8]);

    impl Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let Some((first, rest)) = self.0.split_first() else { return Ok(0) };
            buffer[0] = *first;
            self.0 = rest;
            Ok(1)
        }
    }

    fn words(reader: impl Read) -> Vec<(String, u64)> {
        let mut tokens = Tokens::new(reader);
        let mut words = Vec::new();
        while let Some(token) = tokens.next().unwrap() {
            words.push((String::from_utf8_lossy(token.text).into_owned(), token.line));
        }
        words
    }

    #[test]
    fn words_do_not_depend_on_how_the_text_arrives() {
        let text = b" ncols 4\r\nnrows\t2\n\n1.5 -2e3\r\n7";
        let expected = [("ncols", 1), ("4", 1), ("nrows", 2), ("2", 2), ("1.5", 4), ("-2e3", 4)];
        let mut expected: Vec<_> = expected.map(|(word, line)| (word.to_string(), line)).into();
        expected.push(("7".into(), 5));
        assert_eq!(words(&text[..]), expected);
        assert_eq!(words(Slow(text)), expected);
    }

    #[test]
    fn an_endless_word_is_cut() {
        let longest = words(io::repeat(b'x').take(1 << 20));
        assert!(longest.iter().all(|(word, _)| word.len() < 1 << 19));
    }
}
