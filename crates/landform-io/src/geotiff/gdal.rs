//! The metadata of GDAL: tag 42112, a small XML text.

use crate::{Encoding, Metadata};

/// The XML of metadata and encoding. Letters beyond ASCII become character references,
/// because the tag holds ASCII.
pub(super) fn xml(metadata: &Metadata, encoding: &Encoding) -> String {
    let mut text = String::from("<GDALMetadata>\n");
    let mut item = |attributes: String, value: &str| {
        text.push_str(&format!("  <Item {attributes}>{}</Item>\n", escaped(value)));
    };
    for (name, value) in metadata.entries() {
        item(format!("name=\"{}\"", escaped(&name)), &value);
    }
    let mut role = |name: &str, role: &str, value: &str| {
        item(format!("name=\"{name}\" sample=\"0\" role=\"{role}\""), value);
    };
    role("SCALE", "scale", &encoding.scale.to_string());
    role("OFFSET", "offset", &encoding.offset.to_string());
    for (name, value) in [("DESCRIPTION", &metadata.field), ("UNITTYPE", &metadata.unit)] {
        if let Some(value) = value {
            role(name, &name.to_lowercase(), value);
        }
    }
    text + "</GDALMetadata>\n"
}

/// Metadata, scale and offset from the XML; items that cannot be understood are left out.
pub(super) fn parse(xml: &str) -> (Metadata, [f64; 2]) {
    let mut entries = Vec::new();
    let mut scaling = [1.0, 0.0];
    let mut description = Metadata::default();
    for item in xml.split("<Item").skip(1) {
        let Some((attributes, rest)) = item.split_once('>') else { continue };
        let value = unescaped(rest.split('<').next().unwrap_or_default());
        let Some(name) = attribute(attributes, "name") else { continue };
        match attribute(attributes, "role").as_deref() {
            Some("scale") => scaling[0] = value.trim().parse().unwrap_or(1.0),
            Some("offset") => scaling[1] = value.trim().parse().unwrap_or(0.0),
            Some("description") => description.field = Some(value),
            Some("unittype") => description.unit = Some(value),
            _ => entries.push((name, value)),
        }
    }
    let mut metadata = Metadata::from_entries(entries);
    metadata.field = metadata.field.or(description.field);
    metadata.unit = metadata.unit.or(description.unit);
    (metadata, scaling)
}

fn attribute(attributes: &str, name: &str) -> Option<String> {
    let start = attributes.find(&format!("{name}=\""))? + name.len() + 2;
    Some(unescaped(attributes[start..].split('"').next()?))
}

fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            ' '..='~' if !"&<>\"".contains(letter) => escaped.push(letter),
            _ => escaped.push_str(&format!("&#{};", u32::from(letter))),
        }
    }
    escaped
}

fn unescaped(text: &str) -> String {
    let mut parts = text.split('&');
    let mut plain = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (name, rest) = part.split_once(';').unwrap_or((part, ""));
        let number = name.strip_prefix('#').map(|code| match code.strip_prefix('x') {
            Some(hexadecimal) => u32::from_str_radix(hexadecimal, 16),
            None => code.parse(),
        });
        let letter = match (name, number) {
            ("amp", _) => Some('&'),
            ("lt", _) => Some('<'),
            ("gt", _) => Some('>'),
            ("quot", _) => Some('"'),
            ("apos", _) => Some('\''),
            (_, Some(Ok(code))) => char::from_u32(code),
            _ => None,
        };
        plain.extend(letter);
        plain.push_str(rest);
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_is_read_back() {
        let mut metadata = Metadata {
            title: Some("Düne <1> & \"2\"".into()),
            field: Some("height".into()),
            unit: Some("m³".into()),
            spacing_m: Some(0.1),
            seed: Some(u64::MAX),
            ..Metadata::default()
        };
        metadata.notes.insert("a\nb".into(), "line 1\nline 2".into());
        let encoding = Encoding { scale: 0.25, offset: -3.5, no_data: None };
        let text = xml(&metadata, &encoding);
        assert!(text.is_ascii());
        assert_eq!(parse(&text), (metadata, [0.25, -3.5]));
    }

    #[test]
    fn foreign_text_does_no_harm() {
        let (metadata, scaling) = parse("<Item name=\"x\">a&foo;b</Item><Item><Item name=");
        assert_eq!(metadata.notes["x"], "ab");
        assert_eq!(scaling, [1.0, 0.0]);
    }
}
