//! What stands where in a RON text.

use std::iter::Peekable;

use super::lexer::{Symbol, Token, Tokens};
use super::source::Span;

/// Deepest nesting of brackets that is looked into, as deep as `ron` reads by default.
const DEEPEST: usize = 128;

/// Most values that are kept; a file of rubbish must not fill the memory. What comes later is
/// scanned and left out.
const MOST_VALUES: usize = 500_000;

/// What a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A name alone: `Open`, `None`.
    Unit,
    /// `true` or `false`.
    Bool,
    /// A number, `inf`, `NaN` or a byte literal.
    Number,
    /// A range, `0..5`.
    Range,
    /// A string or a byte string.
    Text,
    /// A character.
    Character,
    /// Fields with keys in parentheses, with or without a name before: `Dunes(slab_m: 5.0)`.
    Struct,
    /// Values without keys in parentheses, with or without a name before: `(3, 4)`, `Some(1)`,
    /// and `()`.
    Tuple,
    /// `[..]`
    List,
    /// `{..}`
    Map,
    /// Something that is no value, and brackets nested too deep to be looked into.
    Unknown,
}

/// The key of an entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key<'a> {
    /// The key: a field's name without `r#`, a map's key without the quotes of a string.
    pub name: &'a str,
    /// Where it stands.
    pub span: Span,
}

/// A field of a struct, a pair of a map, or an element of a list or tuple (without key).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry<'a> {
    /// The key, if there is one.
    pub key: Option<Key<'a>>,
    /// The value.
    pub value: Node<'a>,
}

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node<'a> {
    /// The whole value, from its name to its closing bracket.
    pub span: Span,
    /// What it is.
    pub kind: Kind,
    /// The name that it starts with: `Dunes` of `Dunes(slab_m: 5.0)` and of `Dunes`.
    pub name: Option<Key<'a>>,
    /// The opening bracket.
    pub open: Option<Span>,
    /// The closing bracket, if it was found.
    pub close: Option<Span>,
    /// What is between the brackets.
    pub entries: Vec<Entry<'a>>,
}

impl<'a> Node<'a> {
    /// A value without brackets.
    fn leaf(kind: Kind, span: Span) -> Self {
        Self { span, kind, name: None, open: None, close: None, entries: Vec::new() }
    }

    /// The node and all below it, parents before children, in the order of the text.
    pub fn walk(&self) -> impl Iterator<Item = &Node<'a>> {
        let mut waiting = vec![self];
        std::iter::from_fn(move || {
            let node = waiting.pop()?;
            waiting.extend(node.entries.iter().rev().map(|entry| &entry.value));
            Some(node)
        })
    }
}

/// Where the values of a RON text stand. Any text gives a tree: what is not RON is skipped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tree<'a> {
    /// The text.
    pub text: &'a str,
    /// The value that the text holds, if there is one.
    pub root: Option<Node<'a>>,
    /// Brackets, strings and comments that are opened and not closed, in the order of the text:
    /// the span of a bracket is the bracket, that of a string or comment goes to the end.
    pub unclosed: Vec<Span>,
}

impl<'a> Tree<'a> {
    /// Scans a text, in time proportional to its length.
    pub fn parse(text: &'a str) -> Self {
        let tokens = Tokens::new(text).peekable();
        let mut scanner =
            Scanner { text, tokens, closers: Vec::new(), unclosed: Vec::new(), kept: 0 };
        scanner.skip_attributes();
        let root = scanner.tokens.peek().is_some().then(|| scanner.value());
        while let Some(token) = scanner.tokens.next() {
            scanner.note(token);
        }
        let mut unclosed = scanner.unclosed;
        unclosed.sort_by_key(|span| span.start);
        Self { text, root, unclosed }
    }

    /// The innermost node whose span holds the byte `offset`, its ends included.
    pub fn at(&self, offset: usize) -> Option<&Node<'a>> {
        let holds = |node: &Node| node.span.start <= offset && offset <= node.span.end;
        let mut found = self.root.as_ref().filter(|root| holds(root))?;
        while let Some(entry) = found.entries.iter().find(|entry| holds(&entry.value)) {
            found = &entry.value;
        }
        Some(found)
    }
}

/// A reader of tokens that always goes on.
struct Scanner<'a> {
    text: &'a str,
    tokens: Peekable<Tokens<'a>>,
    /// Closing brackets that are waited for, the innermost last.
    closers: Vec<char>,
    unclosed: Vec<Span>,
    /// Number of values kept so far.
    kept: usize,
}

impl<'a> Scanner<'a> {
    /// Notes a token that is cut off by the end of the text.
    fn note(&mut self, token: Token) {
        if matches!(token.symbol, Symbol::Text { closed: false } | Symbol::UnclosedComment) {
            self.unclosed.push(token.span);
        }
    }

    /// The next token, if it is `symbol`.
    fn next_if(&mut self, symbol: Symbol) -> Option<Token> {
        self.tokens.next_if(|token| token.symbol == symbol)
    }

    /// Skips `#![enable(...)]` and its like.
    fn skip_attributes(&mut self) {
        while self.next_if(Symbol::Other('#')).is_some() {
            self.next_if(Symbol::Other('!'));
            if let Some(open) = self.next_if(Symbol::Open('[')) {
                self.skip_bracket(open.span);
            }
        }
    }

    /// Reads one value; a token that starts none becomes [`Kind::Unknown`]. Closing brackets
    /// and commas are left in place.
    fn value(&mut self) -> Node<'a> {
        let Some(&token) = self.tokens.peek() else {
            return Node::leaf(Kind::Unknown, Span::new(self.text.len(), self.text.len()));
        };
        match token.symbol {
            Symbol::Close(_) | Symbol::Comma => {
                return Node::leaf(Kind::Unknown, Span::new(token.span.start, token.span.start));
            }
            Symbol::Open(bracket) => return self.bracketed(None, bracket),
            _ => self.tokens.next(),
        };
        self.note(token);
        match token.symbol {
            Symbol::Name => self.named(token),
            Symbol::Number => self.number(token),
            Symbol::Range => self.range(token.span),
            Symbol::Text { .. } => Node::leaf(Kind::Text, token.span),
            Symbol::Character => Node::leaf(Kind::Character, token.span),
            _ => Node::leaf(Kind::Unknown, token.span),
        }
    }

    /// A number, or the range that it begins.
    fn number(&mut self, token: Token) -> Node<'a> {
        match self.next_if(Symbol::Range) {
            Some(dots) => self.range(Span::new(token.span.start, dots.span.end)),
            None => Node::leaf(Kind::Number, token.span),
        }
    }

    /// A range whose text so far is `span`, dots included.
    fn range(&mut self, span: Span) -> Node<'a> {
        let end = self.next_if(Symbol::Number).map_or(span.end, |token| token.span.end);
        Node::leaf(Kind::Range, Span::new(span.start, end))
    }

    /// What begins with a name: a struct or variant, or a word such as `true`.
    fn named(&mut self, token: Token) -> Node<'a> {
        let written = token.span.of(self.text);
        let kind = match written {
            "true" | "false" => Kind::Bool,
            "inf" | "NaN" | "inff32" | "inff64" | "NaNf32" | "NaNf64" => Kind::Number,
            _ => Kind::Unit,
        };
        if kind != Kind::Unit {
            return Node::leaf(kind, token.span);
        }
        let name = Key { name: written.strip_prefix("r#").unwrap_or(written), span: token.span };
        match self.tokens.peek().map(|token| token.symbol) {
            Some(Symbol::Open('(')) => self.bracketed(Some(name), '('),
            _ => Node { name: Some(name), ..Node::leaf(Kind::Unit, token.span) },
        }
    }

    /// A value in brackets, of which the opening one comes next.
    fn bracketed(&mut self, name: Option<Key<'a>>, bracket: char) -> Node<'a> {
        let Some(open) = self.tokens.next().map(|token| token.span) else {
            return Node::leaf(Kind::Unknown, Span::new(self.text.len(), self.text.len()));
        };
        let start = name.as_ref().map_or(open.start, |name| name.span.start);
        if self.closers.len() >= DEEPEST {
            let end = self.skip_bracket(open);
            return Node {
                name,
                open: Some(open),
                ..Node::leaf(Kind::Unknown, Span::new(start, end))
            };
        }
        self.closers.push(closer(bracket));
        let (entries, mut end) = self.entries(open.end);
        self.closers.pop();
        let close = self.next_if(Symbol::Close(closer(bracket))).map(|token| token.span);
        match close {
            Some(close) => end = close.end,
            None => self.unclosed.push(open),
        }
        let kind = kind_of(bracket, &entries);
        Node { span: Span::new(start, end), kind, name, open: Some(open), close, entries }
    }

    /// Everything up to a closing bracket that somebody waits for, and where it ended.
    fn entries(&mut self, mut end: usize) -> (Vec<Entry<'a>>, usize) {
        let mut entries = Vec::new();
        while let Some(&token) = self.tokens.peek() {
            match token.symbol {
                Symbol::Close(bracket) if self.closers.contains(&bracket) => break,
                Symbol::Close(_) | Symbol::Comma | Symbol::Colon => {
                    self.tokens.next();
                    end = token.span.end;
                }
                _ => {
                    let keeps = self.kept < MOST_VALUES;
                    self.kept += usize::from(keeps);
                    let entry = self.entry();
                    end = entry.value.span.end;
                    entries.extend(keeps.then_some(entry));
                }
            }
        }
        (entries, end)
    }

    /// A value with the key before it, if a colon follows the first value.
    fn entry(&mut self) -> Entry<'a> {
        let first = self.value();
        if self.next_if(Symbol::Colon).is_none() {
            return Entry { key: None, value: first };
        }
        let written = first.span.of(self.text);
        let name = match (&first.name, first.kind) {
            (Some(name), Kind::Unit) => name.name,
            (_, Kind::Text) => unquoted(written),
            _ => written,
        };
        Entry { key: Some(Key { name, span: first.span }), value: self.value() }
    }

    /// Skips to the end of a bracket that is already open, without looking inside, and returns
    /// where it ended.
    fn skip_bracket(&mut self, open: Span) -> usize {
        let mut depth = 1_usize;
        for token in self.tokens.by_ref() {
            match token.symbol {
                Symbol::Open(_) => depth += 1,
                Symbol::Close(_) => depth -= 1,
                Symbol::Text { closed: false } | Symbol::UnclosedComment => {
                    self.unclosed.push(token.span);
                }
                _ => {}
            }
            if depth == 0 {
                return token.span.end;
            }
        }
        self.unclosed.push(open);
        self.text.len()
    }
}

/// The bracket that closes another.
fn closer(bracket: char) -> char {
    match bracket {
        '(' => ')',
        '[' => ']',
        _ => '}',
    }
}

/// What brackets and their content make.
fn kind_of(bracket: char, entries: &[Entry]) -> Kind {
    match bracket {
        '[' => Kind::List,
        '{' => Kind::Map,
        _ if entries.iter().any(|entry| entry.key.is_some()) => Kind::Struct,
        _ => Kind::Tuple,
    }
}

/// The inside of a string literal, its escapes as they are written.
fn unquoted(literal: &str) -> &str {
    let inner = literal.trim_start_matches(['b', 'r']).trim_matches('#');
    let inner = inner.strip_prefix('"').unwrap_or(inner);
    inner.strip_suffix('"').unwrap_or(inner)
}

#[cfg(test)]
mod tests;
