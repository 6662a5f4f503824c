//! Writes the seeds of every target into `corpus/TARGET/` and its words into `words/TARGET.dict`.

use std::fs;
use std::io;
use std::path::Path;

use landform_tests::fuzzing::TARGETS;

fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    fs::create_dir_all(folder.join("words"))?;
    for target in TARGETS {
        let corpus = folder.join("corpus").join(target.name);
        fs::create_dir_all(&corpus)?;
        for (name, bytes) in (target.seeds)() {
            fs::write(corpus.join(name), bytes)?;
        }
        let words: String = (target.words)().iter().map(|word| line(word)).collect();
        fs::write(folder.join("words").join(format!("{}.dict", target.name)), words)?;
    }
    Ok(())
}

/// A word as a line of a dictionary: quoted, with every unusual byte in hexadecimal.
fn line(word: &str) -> String {
    let byte = |byte: u8| match byte {
        b' '..=b'~' if byte != b'"' && byte != b'\\' => char::from(byte).to_string(),
        _ => format!("\\x{byte:02x}"),
    };
    format!("\"{}\"\n", word.bytes().map(byte).collect::<String>())
}
