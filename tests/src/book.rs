//! What the pages of the book hold: blocks of code, and links.

/// A fenced block of a page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Line of the opening fence, from one.
    pub line: usize,
    /// What stands after the opening fence: `ron`, `sh`, `ron,ignore`.
    pub language: String,
    /// The text between the fences.
    pub text: String,
}

/// The fenced blocks of a Markdown text.
pub fn blocks(markdown: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for (index, line) in markdown.lines().enumerate() {
        match (line.trim().strip_prefix("```"), open.take()) {
            (Some(_), Some(block)) => blocks.push(block),
            (None, Some(mut block)) => {
                block.text += line;
                block.text.push('\n');
                open = Some(block);
            }
            (Some(language), None) => {
                let language = language.trim().to_owned();
                open = Some(Block { line: index + 1, language, text: String::new() });
            }
            (None, None) => {}
        }
    }
    assert_eq!(open, None, "a block without an end");
    blocks
}

/// The targets of the links and pictures of a Markdown text, outside blocks of code.
pub fn links(markdown: &str) -> Vec<String> {
    let mut inside = false;
    let prose = markdown.lines().filter(|line| {
        let fence = line.trim().starts_with("```");
        inside ^= fence;
        !inside && !fence
    });
    let mut links = Vec::new();
    for line in prose {
        for rest in line.split("](").skip(1) {
            if let Some((target, _)) = rest.split_once(')') {
                links.push(target.split_whitespace().next().unwrap_or_default().to_owned());
            }
        }
        for rest in line.split("src=\"").skip(1) {
            links.extend(rest.split_once('"').map(|(target, _)| target.to_owned()));
        }
    }
    links
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# A [page](a.md#x)\n![b](b.png \"B\") `c`\n\n```ron\n(a: [](n))\n```\nend\n\
        <img src=\"d.png\">\n  ```sh\n  ls\n  ```\n";

    #[test]
    fn blocks_know_their_line_and_language() {
        let found = blocks(PAGE);
        let seen: Vec<_> = found.iter().map(|b| (b.line, b.language.as_str(), &*b.text)).collect();
        assert_eq!(seen, [(4, "ron", "(a: [](n))\n"), (9, "sh", "  ls\n")]);
    }

    #[test]
    fn links_are_those_of_the_prose() {
        assert_eq!(links(PAGE), ["a.md#x", "b.png", "d.png"]);
    }
}
