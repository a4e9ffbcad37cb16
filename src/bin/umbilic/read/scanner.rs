//! Splits a text file into lines and words, counting the lines.
//!
//! Comments that start with `#`, blank lines and all line endings are dealt with here. A line that ends in a
//! backslash continues on the next one. Bytes that are no UTF-8 do no harm: they only occur in names and comments,
//! which nobody reads, or else make a number unreadable.

use super::Fault;
use std::io::{self, BufRead};
use std::str::{FromStr, SplitWhitespace};

/// A cursor over the words of a text file.
pub(super) struct Scanner<R> {
    /// The text that has not been read yet.
    reader: R,
    /// The bytes of the current physical line, kept for their capacity.
    bytes: Vec<u8>,
    /// The current line without its comment.
    line: String,
    /// Where the unread words of the current line start.
    position: usize,
    /// The number of lines read, which is the number of the current line.
    line_number: usize,
}

impl<R: BufRead> Scanner<R> {
    /// Starts before the first line.
    pub(super) fn new(reader: R) -> Self {
        Self { reader, bytes: Vec::new(), line: String::new(), position: 0, line_number: 0 }
    }

    /// The number of the current line, counted from one.
    pub(super) fn line_number(&self) -> usize {
        self.line_number
    }

    /// A fault on the current line.
    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::on_line(self.line_number, message)
    }

    /// Goes to the next line that has words; returns `false` at the end.
    pub(super) fn next_line(&mut self) -> io::Result<bool> {
        self.line.clear();
        self.position = 0;
        loop {
            self.bytes.clear();
            if self.reader.read_until(b'\n', &mut self.bytes)? == 0 {
                return Ok(!self.line.trim().is_empty());
            }
            self.line_number += 1;
            let text = String::from_utf8_lossy(&self.bytes);
            let code = text.split('#').next().unwrap_or_default().trim_end();
            if let Some(start) = code.strip_suffix('\\') {
                self.line.push_str(start);
                self.line.push(' ');
                continue;
            }
            self.line.push_str(code);
            if !self.line.trim().is_empty() {
                return Ok(true);
            }
            self.line.clear();
        }
    }

    /// The current line without its comment.
    pub(super) fn text(&self) -> &str {
        &self.line
    }

    /// All words of the current line.
    pub(super) fn words(&self) -> SplitWhitespace<'_> {
        self.line.split_whitespace()
    }

    /// The next word, wherever the lines break, or `None` at the end.
    pub(super) fn next_word(&mut self) -> io::Result<Option<&str>> {
        while self.line[self.position..].trim_start().is_empty() {
            if !self.next_line()? {
                return Ok(None);
            }
        }
        let rest = &self.line[self.position..];
        let start = self.position + rest.len() - rest.trim_start().len();
        let word = self.line[start..].split_whitespace().next();
        self.position = start + word.map_or(0, str::len);
        Ok(word)
    }

    /// Skips the words that are left on the current line.
    pub(super) fn skip_rest_of_line(&mut self) {
        self.position = self.line.len();
    }
}

/// Reads a word as a number; the error says what `what` should have been.
pub(super) fn parse<T: FromStr>(word: &str, what: &str) -> Result<T, String> {
    word.parse().map_err(|_| format!("expected {what}, found `{}`", shorten(word)))
}

/// The start of a text, short enough for an error message and without control characters, which could play tricks on
/// a terminal.
pub(super) fn shorten(text: &str) -> String {
    const LONGEST: usize = 120;
    let mut characters = text.chars().map(|character| match character {
        _ if character.is_control() => char::REPLACEMENT_CHARACTER,
        _ => character,
    });
    let mut start: String = characters.by_ref().take(LONGEST).collect();
    if characters.next().is_some() {
        start.push('…');
    }
    start
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lose_comments_blanks_and_carriage_returns() {
        let mut scanner = Scanner::new(&b"# one\r\n\r\n a b # two\r\nc\n \n"[..]);
        assert!(scanner.next_line().unwrap());
        assert_eq!(scanner.words().collect::<Vec<_>>(), ["a", "b"]);
        assert_eq!(scanner.line_number(), 3);
        assert!(scanner.next_line().unwrap());
        assert_eq!(scanner.words().collect::<Vec<_>>(), ["c"]);
        assert!(!scanner.next_line().unwrap());
    }

    #[test]
    fn a_backslash_joins_lines() {
        let mut scanner = Scanner::new(&b"f 1 2\\\r\n3 \\\n4\nv\\"[..]);
        assert!(scanner.next_line().unwrap());
        assert_eq!(scanner.words().collect::<Vec<_>>(), ["f", "1", "2", "3", "4"]);
        assert_eq!(scanner.line_number(), 3);
        assert!(scanner.next_line().unwrap());
        assert_eq!(scanner.words().collect::<Vec<_>>(), ["v"]);
        assert!(!scanner.next_line().unwrap());
    }

    #[test]
    fn words_cross_lines_and_survive_foreign_bytes() {
        let mut scanner = Scanner::new(&b"a b\n\xff c\n d"[..]);
        assert_eq!(scanner.next_word().unwrap(), Some("a"));
        scanner.skip_rest_of_line();
        assert_eq!(scanner.next_word().unwrap(), Some("\u{fffd}"));
        assert_eq!(scanner.next_word().unwrap(), Some("c"));
        assert_eq!(scanner.next_word().unwrap(), Some("d"));
        assert_eq!(scanner.line_number(), 3);
        assert_eq!(scanner.next_word().unwrap(), None);
    }

    #[test]
    fn messages_quote_little_and_nothing_harmful() {
        let message = parse::<f64>(&"é".repeat(1000), "a coordinate").unwrap_err();
        assert!(message.chars().count() < 200);
        assert_eq!(shorten("a\u{1b}[2J"), "a\u{fffd}[2J");
    }
}
