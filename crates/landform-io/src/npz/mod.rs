//! Archives of NumPy arrays and texts: what `numpy.load` reads as `.npz`.
//!
//! An archive is a ZIP file (APPNOTE 6.3.9) whose members are stored as they are, each an array
//! in NumPy's format or a text. Its parts are always written the same way, with 64-bit sizes, so
//! the reader, which reads archives of this writer only, can compare every byte that is not
//! content with what belongs there; contents have checksums (CRC-32). No damage goes unnoticed.

mod container;

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::Path;

use container::{Entry, Head};

use crate::npy::header;
use crate::{Fault, IfExists, IoError, Place, write_atomically};

/// One array or text of an archive.
#[derive(Clone, Debug, PartialEq)]
pub struct Member<'a> {
    /// Name in the archive, a path with `/`; that of an array ends in `.npy`.
    pub name: String,
    /// What it holds.
    pub content: Content<'a>,
}

/// What a member of an archive holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Content<'a> {
    /// A text in UTF-8.
    Text(Cow<'a, str>),
    /// Numbers in C order: the last axis varies fastest.
    Array {
        /// Type of a number as NumPy has it: `f8`, `u4`.
        kind: String,
        /// Size along each axis.
        shape: Vec<usize>,
        /// The numbers as they lie in memory.
        bytes: Cow<'a, [u8]>,
    },
}

/// Order of the bytes of a number on this machine, as NumPy writes it.
const ORDER: &str = if cfg!(target_endian = "little") { "<" } else { ">" };

/// Largest length of a member's name that is read.
const LONGEST_NAME: u64 = 4096;

impl Content<'_> {
    /// What stands before the numbers of an array.
    fn header(&self) -> Vec<u8> {
        match self {
            Self::Text(_) => Vec::new(),
            Self::Array { kind, shape, .. } => header::bytes(shape, &format!("{ORDER}{kind}")),
        }
    }

    fn bytes(&self) -> &[u8] {
        match self {
            Self::Text(text) => text.as_bytes(),
            Self::Array { bytes, .. } => bytes,
        }
    }
}

/// Writes an archive.
///
/// # Errors
/// [`IoError::Exists`] and [`IoError::System`], as [`write_atomically`].
pub fn write(path: &Path, members: &[Member<'_>], if_exists: IfExists) -> Result<(), IoError> {
    write_atomically(path, if_exists, |writer| {
        let mut directory = Vec::with_capacity(members.len());
        let mut start = 0;
        for Member { name, content } in members {
            let (header, bytes) = (content.header(), content.bytes());
            let mut checksum = crc32fast::Hasher::new();
            checksum.update(&header);
            checksum.update(bytes);
            let size = (header.len() + bytes.len()) as u64;
            let entry = Entry { name: name.clone(), checksum: checksum.finalize(), size, start };
            let head = entry.head();
            writer.write_all(&head)?;
            writer.write_all(&header)?;
            writer.write_all(bytes)?;
            start += head.len() as u64 + size;
            directory.push(entry);
        }
        writer.write_all(&container::tail(&directory, start))
    })
}

/// Reads an archive that [`write()`] has written, on a machine with the same order of bytes.
///
/// # Errors
/// [`IoError::System`] when the file cannot be read, [`IoError::Content`] when a byte of it is
/// not as it was written.
pub fn read(path: &Path) -> Result<Vec<Member<'static>>, IoError> {
    let system = |error| IoError::system(path, "read", error);
    let file = File::open(path).map_err(system)?;
    let length = file.metadata().map_err(system)?.len();
    let mut source = Source { reader: BufReader::new(file), position: 0, length };
    source.members().map_err(|problem| match problem {
        Trouble::System(error) if error.kind() != io::ErrorKind::UnexpectedEof => system(error),
        Trouble::System(_) => source.damage("the file ends too early").reading(path),
        Trouble::Damage(what) => source.damage(&what).reading(path),
    })
}

/// What can go wrong within an archive.
enum Trouble {
    System(io::Error),
    Damage(String),
}

impl From<io::Error> for Trouble {
    fn from(error: io::Error) -> Self {
        Self::System(error)
    }
}

fn damage<T>(what: impl Into<String>) -> Result<T, Trouble> {
    Err(Trouble::Damage(what.into()))
}

/// An archive that is being read.
struct Source {
    reader: BufReader<File>,
    position: u64,
    length: u64,
}

impl Source {
    fn damage(&self, what: &str) -> Fault {
        let expected = "the bytes that were written";
        let advice = "the file is damaged: take a copy of it, if there is one";
        Fault::new(what, expected, advice).at(Place::Byte(self.position))
    }

    fn members(&mut self) -> Result<Vec<Member<'static>>, Trouble> {
        let (mut members, mut directory) = (Vec::new(), Vec::new());
        loop {
            let start = self.position;
            let first = self.take(container::HEAD)?;
            let Some(head) = Head::parse(&first) else {
                break self.check_tail(first, &directory, start)?;
            };
            let name = self.take(u64::from(head.name_length).min(LONGEST_NAME))?;
            let Ok(name) = String::from_utf8(name) else { return damage("a name is no text") };
            let extra = self.take(container::EXTRA)?;
            let size = container::size_in(&extra);
            let entry = Entry { name, checksum: head.checksum, size, start };
            let found = [head.bytes.as_slice(), entry.name.as_bytes(), &extra].concat();
            if entry.head() != found {
                return damage("the head of a member is not as it was written");
            }
            let bytes = self.take(size)?;
            if crc32fast::hash(&bytes) != entry.checksum {
                return damage(format!("the checksum of `{}` is another", entry.name));
            }
            members.push(member(&entry.name, bytes)?);
            directory.push(entry);
        }
        Ok(members)
    }

    /// The next bytes, of which there must be as many.
    fn take(&mut self, count: u64) -> Result<Vec<u8>, Trouble> {
        if count > self.length.saturating_sub(self.position) {
            return Err(Trouble::System(io::ErrorKind::UnexpectedEof.into()));
        }
        let mut bytes = vec![0; count as usize];
        self.reader.read_exact(&mut bytes)?;
        self.position += count;
        Ok(bytes)
    }

    /// Checks everything after the members, whose `first` bytes are read already.
    fn check_tail(
        &mut self,
        first: Vec<u8>,
        directory: &[Entry],
        start: u64,
    ) -> Result<(), Trouble> {
        let rest = self.take(self.length - self.position)?;
        match container::tail(directory, start) == [first, rest].concat() {
            true => Ok(()),
            false => damage("the directory of the archive is not as it was written"),
        }
    }
}

/// A member from its bytes.
fn member(name: &str, mut bytes: Vec<u8>) -> Result<Member<'static>, Trouble> {
    let name = name.to_owned();
    if !name.ends_with(".npy") {
        return match String::from_utf8(bytes) {
            Ok(text) => Ok(Member { name, content: Content::Text(text.into()) }),
            Err(_) => damage(format!("`{name}` is no text")),
        };
    }
    let Some((start, kind, shape)) = described(&bytes) else {
        return damage(format!("`{name}` is no array"));
    };
    bytes.drain(..start);
    let size = kind.get(1..).and_then(|size| size.parse().ok());
    let needed = shape.iter().try_fold(size.unwrap_or(1), |all: usize, &one| all.checked_mul(one));
    if needed != Some(bytes.len()) {
        return damage(format!("`{name}` does not hold as many numbers as it says"));
    }
    Ok(Member { name, content: Content::Array { kind, shape, bytes: bytes.into() } })
}

/// Where the numbers of an array start, their type and the shape.
fn described(bytes: &[u8]) -> Option<(usize, String, Vec<usize>)> {
    let length = bytes.get(8..10)?;
    let start = 10 + usize::from(u16::from_le_bytes([length[0], length[1]]));
    let header = bytes.get(..start)?;
    let found = header::parse_any(std::str::from_utf8(&header[10..]).ok()?).ok()?;
    let shape: Vec<usize> = found.shape.iter().map(|&size| size as usize).collect();
    let written = header::bytes(&shape, &format!("{ORDER}{}", found.kind));
    (written == header).then_some((start, found.kind, shape))
}
