//! Archives of arrays: what is written is read back, and no damage goes unnoticed.

mod support;

use std::borrow::Cow;
use std::fs;

use landform_io::IfExists;
use landform_io::npz::{Content, Member, read, write};
use support::Scratch;

fn array(name: &str, kind: &str, shape: &[usize], bytes: Vec<u8>) -> Member<'static> {
    let (kind, shape, bytes) = (kind.to_owned(), shape.to_vec(), Cow::Owned(bytes));
    Member { name: name.into(), content: Content::Array { kind, shape, bytes } }
}

fn members() -> Vec<Member<'static>> {
    let numbers: Vec<u8> = [1.5_f64, -0.0, f64::NAN, f64::MIN_POSITIVE, 1e300, 7.0]
        .iter()
        .flat_map(|value| value.to_ne_bytes())
        .collect();
    let text = Content::Text("{\"grüße\": 1}".into());
    vec![
        Member { name: "manifest.json".into(), content: text },
        array("fields/sand.npy", "f8", &[2, 3], numbers),
        array("groups/none/members.npy", "u4", &[0], Vec::new()),
        array("state/bytes.npy", "u1", &[5], vec![1, 2, 3, 4, 5]),
        Member { name: "empty.ron".into(), content: Content::Text("".into()) },
    ]
}

#[test]
fn archives_come_back_as_they_were() {
    let folder = Scratch::new("archive");
    let path = folder.path("all.npz");
    for members in [members(), Vec::new()] {
        write(&path, &members, IfExists::Replace).unwrap();
        assert_eq!(read(&path).unwrap(), members);
    }
    assert_eq!(folder.file_count(), 1, "nothing temporary is left");
    assert!(write(&path, &[], IfExists::Refuse).unwrap_err().to_string().contains("exists"));
    assert!(read(&folder.path("missing.npz")).unwrap_err().to_string().contains("missing.npz"));
    assert!(read(&folder.path(".")).is_err());
}

#[test]
fn every_truncation_and_every_flipped_bit_is_refused() {
    let folder = Scratch::new("archive_damage");
    let path = folder.path("all.npz");
    write(&path, &members(), IfExists::Replace).unwrap();
    let good = fs::read(&path).unwrap();
    let refused = |bytes: &[u8], what: &str| {
        fs::write(&path, bytes).unwrap();
        let message = read(&path).expect_err(what).to_string();
        assert!(message.contains("damaged"), "{what}: {message}");
    };
    for length in 0..good.len() {
        refused(&good[..length], &format!("cut to {length} bytes"));
    }
    for byte in 0..good.len() {
        for bit in [0, 3, 7] {
            let mut bytes = good.clone();
            bytes[byte] ^= 1 << bit;
            refused(&bytes, &format!("bit {bit} of byte {byte}"));
        }
    }
    refused(&[good.as_slice(), b"more"].concat(), "more bytes");
    refused(&[good.as_slice(), &good].concat(), "twice");
}

/// A size that no file has takes no memory.
#[test]
fn absurd_sizes_take_no_memory() {
    let folder = Scratch::new("archive_sizes");
    let path = folder.path("all.npz");
    write(&path, &members(), IfExists::Replace).unwrap();
    let mut bytes = fs::read(&path).unwrap();
    let sizes = 30 + "manifest.json".len() + 4;
    bytes[sizes..sizes + 16].fill(0xFF);
    fs::write(&path, &bytes).unwrap();
    assert!(read(&path).unwrap_err().to_string().contains("ends too early"));
}
