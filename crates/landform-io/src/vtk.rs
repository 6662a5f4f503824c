//! VTK image data (`.vti`): fields on planes and volumes, for ParaView and other viewers.
//!
//! Values stand at points. VTK's second axis runs north, so rows are written from the south.

use std::io::Write;
use std::path::Path;

use crate::{Fault, IfExists, IoError, Metadata, SampleType, write_atomically};

/// Writes values in node order on `size` columns, rows and layers, `spacing_m` apart in all
/// directions, as doubles, with the origin at the lowest south-western node.
///
/// The metadata give the name of the array (`field`); title, unit, seed and notes go into a comment.
///
/// # Errors
/// [`IoError`]: size and values disagree, or the output cannot be written.
pub fn write_image_data(
    path: &Path,
    size: [usize; 3],
    spacing_m: f64,
    values: &[f64],
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let [columns, rows, layers] = size;
    let count = columns.checked_mul(rows).and_then(|count| count.checked_mul(layers));
    if count != Some(values.len()) || values.is_empty() {
        let problem = format!("{columns} x {rows} x {layers} nodes with {} values", values.len());
        return Err(Fault::new(problem, "one value a node", "make them agree").writing(path));
    }
    let extent = format!("0 {} 0 {} 0 {}", columns - 1, rows - 1, layers - 1);
    let name = escaped(metadata.field.as_deref().unwrap_or("values"));
    let bytes = size_of_val(values) as u64;
    write_atomically(path, if_exists, |writer| {
        write!(
            writer,
            r#"<?xml version="1.0"?>
<!--{}-->
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="{spacing_m} {spacing_m} {spacing_m}">
    <Piece Extent="{extent}">
      <PointData Scalars="{name}">
        <DataArray type="Float64" Name="{name}" format="appended" offset="0"/>
      </PointData>
    </Piece>
  </ImageData>
  <AppendedData encoding="raw">
   _"#,
            comment(metadata),
        )?;
        writer.write_all(&bytes.to_le_bytes())?;
        for layer in values.chunks_exact(columns * rows) {
            for row in layer.chunks_exact(columns).rev() {
                SampleType::F64.write(row, writer)?;
            }
        }
        writer.write_all(b"\n  </AppendedData>\n</VTKFile>\n")
    })
}

/// What is known of the values, as the text of a comment.
fn comment(metadata: &Metadata) -> String {
    let text = |key: &str, value: &Option<String>| {
        value.as_ref().map(|value| format!("{key}: {value}")).into_iter()
    };
    let mut lines: Vec<String> =
        text("title", &metadata.title).chain(text("unit", &metadata.unit)).collect();
    lines.extend(metadata.seed.map(|seed| format!("seed: {seed}")));
    lines.extend(metadata.notes.iter().map(|(key, value)| format!("{key}: {value}")));
    // Two hyphens would end the comment.
    format!(" {} ", lines.join("; ").replace("--", "- -").trim_end_matches('-'))
}

/// A text as the value of an attribute.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' => escaped.push_str("&quot;"),
            letter if letter.is_control() => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scratch::Scratch;

    #[test]
    fn values_stand_row_by_row_from_the_south_after_their_length() {
        let folder = Scratch::new("vtk_image");
        let path = folder.path("rock.vti");
        let values: Vec<f64> = (0..12).map(f64::from).collect();
        let metadata = Metadata {
            field: Some("a<b".into()),
            title: Some("rock -- dense".into()),
            ..Metadata::default()
        };
        write_image_data(&path, [3, 2, 2], 0.5, &values, &metadata, IfExists::Refuse).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let mark = b"\n   _";
        let start = bytes.windows(5).position(|five| five == mark).unwrap() + 5;
        let head = String::from_utf8(bytes[..start].to_vec()).unwrap();
        assert!(head.contains(r#"WholeExtent="0 2 0 1 0 1" Origin="0 0 0" Spacing="0.5 0.5 0.5""#));
        assert!(head.contains(r#"Name="a&lt;b""#) && head.contains("rock - - dense"), "{head}");
        let words: Vec<[u8; 8]> =
            bytes[start..][..8 * 13].chunks_exact(8).map(|word| word.try_into().unwrap()).collect();
        assert_eq!(u64::from_le_bytes(words[0]), 96);
        let read: Vec<f64> = words[1..].iter().map(|&word| f64::from_le_bytes(word)).collect();
        assert_eq!(read, [3.0, 4.0, 5.0, 0.0, 1.0, 2.0, 9.0, 10.0, 11.0, 6.0, 7.0, 8.0]);
        assert!(bytes[start + 8 * 13..].starts_with(b"\n  </AppendedData>"));
    }

    #[test]
    fn sizes_that_do_not_fit_are_refused() {
        let folder = Scratch::new("vtk_refused");
        let path = folder.path("rock.vti");
        let metadata = Metadata::default();
        for size in [[3, 2, 1], [usize::MAX, 2, 2], [0, 0, 0]] {
            let result = write_image_data(&path, size, 1.0, &[0.0; 4], &metadata, IfExists::Refuse);
            assert!(result.unwrap_err().to_string().contains("one value a node"));
        }
        assert_eq!(folder.file_count(), 0);
    }
}
