//! Shapes as the text of an SVG file.

use std::fmt::Write;

use super::base64::base64;
use super::drawing::{Anchor, Colour, Drawing, Frame, INK, Place, Shape, Words};
use crate::Image;
use crate::text::{EM, FOOT};

impl Drawing {
    /// The page as SVG 1.1.
    pub fn svg(&self) -> String {
        let [width, height] = self.size;
        let mut page = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" \
             xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        );
        let clips = self.clips();
        for (number, [left, top, right, bottom]) in clips.iter().enumerate() {
            let (width, height) = (right - left, bottom - top);
            page += &format!(
                "<clipPath id=\"panel{number}\"><rect x=\"{left:.2}\" y=\"{top:.2}\" \
                 width=\"{width:.2}\" height=\"{height:.2}\"/></clipPath>\n"
            );
        }
        for (shape, clip) in &self.shapes {
            let number = clip.and_then(|clip| clips.iter().position(|known| *known == clip));
            let clip = number.map_or(String::new(), |n| format!(" clip-path=\"url(#panel{n})\""));
            page += &element(shape, &clip);
        }
        page + "</svg>\n"
    }

    /// The rectangles that cut shapes, each once.
    fn clips(&self) -> Vec<Frame> {
        let mut clips: Vec<Frame> = self.shapes.iter().filter_map(|(_, clip)| *clip).collect();
        clips.dedup();
        clips
    }
}

fn element(shape: &Shape, clip: &str) -> String {
    match shape {
        Shape::Stroke { places, width, dashes, colour } => {
            let dashes = match dashes {
                [] => String::new(),
                dashes => {
                    let lengths: Vec<String> = dashes.iter().map(f32::to_string).collect();
                    format!(" stroke-dasharray=\"{}\"", lengths.join(" "))
                }
            };
            let (points, colour) = (points(places), hex(*colour));
            format!(
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" \
                 stroke-width=\"{width}\" stroke-linejoin=\"round\"{dashes}{clip}/>\n"
            )
        }
        Shape::Fill { corners, colour } => {
            let (points, colour) = (points(corners), hex(*colour));
            format!("<polygon points=\"{points}\" fill=\"{colour}\"{clip}/>\n")
        }
        Shape::Picture { image, frame } => picture(image, *frame, clip),
        Shape::Words(words) => text(words),
    }
}

/// A picture as part of the file: nothing lies beside it that could be lost.
fn picture(image: &Image, [left, top, right, bottom]: Frame, clip: &str) -> String {
    let (width, height) = (right - left, bottom - top);
    let mut bytes = Vec::new();
    if let Err(error) = image.encode_png(&mut bytes, &[]) {
        return format!(
            "<!-- the picture cannot be encoded: {} -->\n",
            escaped(&error.to_string())
        );
    }
    format!(
        "<image x=\"{left:.2}\" y=\"{top:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
         preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{}\"{clip}/>\n",
        base64(&bytes)
    )
}

fn text(words: &Words) -> String {
    let anchor = match words.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let [x, y] = words.at;
    let base = FOOT * words.size;
    let place = match words.upward {
        false => format!("x=\"{x:.2}\" y=\"{:.2}\"", y + base),
        true => format!("transform=\"translate({:.2} {y:.2}) rotate(-90)\"", x + base),
    };
    let (size, colour, text) = (EM * words.size, hex(INK), escaped(&words.text));
    format!(
        "<text {place} font-size=\"{size:.2}\" text-anchor=\"{anchor}\" fill=\"{colour}\">{text}</text>\n"
    )
}

fn points(places: &[Place]) -> String {
    let mut points = String::new();
    for [x, y] in places {
        // Writing into a string cannot fail.
        let _ = write!(points, "{x:.2},{y:.2} ");
    }
    points.trim_end().to_owned()
}

fn hex([red, green, blue]: Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// The text with the characters that XML keeps for itself replaced, and those that it forbids
/// left out.
fn escaped(text: &str) -> String {
    let mut safe = String::new();
    for letter in text.chars().filter(|letter| !letter.is_control()) {
        match letter {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '\u{FFFE}' | '\u{FFFF}' => {}
            letter => safe.push(letter),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_become_elements_with_their_cuts() {
        let mut drawing = Drawing { size: [20.0, 10.0], ..Drawing::default() };
        drawing.words("a < b & c\u{7}", [1.0, 5.0], 10.0, Anchor::Start);
        drawing.clip = Some([0.0, 0.0, 10.0, 10.0]);
        drawing.line([0.0, 0.0], [20.0, 10.0], 1.5, [255, 0, 16]);
        let text = drawing.svg();
        assert!(text.contains(">a &lt; b &amp; c</text>"), "{text}");
        assert!(text.contains("<clipPath id=\"panel0\">"), "{text}");
        assert!(text.contains("points=\"0.00,0.00 20.00,10.00\""), "{text}");
        assert!(text.contains("stroke=\"#ff0010\"") && text.contains("url(#panel0)"), "{text}");
        assert_eq!(text.matches('<').count(), text.matches('>').count());
    }
}
