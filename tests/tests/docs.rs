//! The book and the README say what is true: their links lead somewhere, the paths they name
//! exist, their scenarios are read, and their commands run.
//!
//! Blocks of a page belong together, in their order. A `ron` block that is a whole scenario is
//! checked. The lines of `sh` blocks that call the program are run in one folder for the page,
//! with runs cut to a small size; a scenario file that they name and that is not in the
//! repository is the whole scenario that stands above. `ignore` after the language leaves a
//! block out.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::Limits;
use landform_tests::{Block, blocks, files_below, links, repository, shown};

/// The pages: the README and the book.
fn pages() -> Vec<(PathBuf, String)> {
    let mut files = files_below("docs/src", "md");
    files.push(repository().join("README.md"));
    files.retain(|file| file.is_file());
    assert!(!files.is_empty(), "there are pages");
    let text = |file: &PathBuf| fs::read_to_string(file).expect("a page is text");
    files.into_iter().map(|file| (file.clone(), text(&file))).collect()
}

/// Whether a block is a scenario from its first to its last bracket.
fn is_scenario(block: &Block) -> bool {
    let whole = block.text.contains("stages:") && block.text.contains("domain:");
    says(block, "ron") && !says(block, "ignore") && whole
}

/// Whether the words after the opening fence of a block have this one among them.
fn says(block: &Block, word: &str) -> bool {
    block.language.split([' ', ',']).any(|part| part == word)
}

#[test]
fn links_and_pictures_lead_somewhere() {
    let mut lost = Vec::new();
    for (page, text) in pages() {
        let folder = page.parent().expect("a page lies in a folder");
        for link in links(&text) {
            let target = link.split('#').next().unwrap_or_default();
            let elsewhere = target.contains("://") || target.starts_with("mailto:");
            if !target.is_empty() && !elsewhere && !folder.join(target).exists() {
                lost.push(format!("{}: {link}", shown(&page)));
            }
        }
    }
    assert!(lost.is_empty(), "links that lead nowhere:\n{}", lost.join("\n"));
}

#[test]
fn paths_that_are_named_exist() {
    const FOLDERS: [&str; 5] = ["scenarios/", "docs/", "crates/", "tests/", ".ci/"];
    let mut lost = Vec::new();
    for (page, text) in pages() {
        for word in
            text.split(|letter: char| letter.is_whitespace() || "`\"'()<>,;".contains(letter))
        {
            let word = word.trim_end_matches(['.', ':', '!', '?']);
            let pattern = word.contains(['*', '{', '$']) || word.contains("NAME");
            if FOLDERS.iter().any(|folder| word.starts_with(folder)) && !pattern {
                let path = word.split(['#', '=', ':']).next().unwrap_or_default();
                if !repository().join(path).exists() {
                    lost.push(format!("{}: {word}", shown(&page)));
                }
            }
        }
    }
    assert!(lost.is_empty(), "paths that are not there:\n{}", lost.join("\n"));
}

#[test]
fn the_readme_and_the_architecture_name_every_crate() {
    for folder in fs::read_dir(repository().join("crates")).expect("crates") {
        let name = folder.expect("a folder").file_name().to_string_lossy().into_owned();
        for page in ["README.md", "docs/src/architecture.md"] {
            let text = fs::read_to_string(repository().join(page)).expect("a page");
            assert!(text.contains(&name), "{page} does not name {name}");
        }
    }
}

#[test]
fn sources_that_are_cited_are_in_the_bibliography() {
    let read = |path: &str| fs::read_to_string(repository().join(path)).expect("a text");
    let (page, sources) = (read("docs/src/cite.md"), read("docs/references.bib"));
    let rows = page.lines().filter(|line| line.starts_with('|'));
    let cells = rows.filter_map(|row| row.trim_end_matches('|').rsplit('|').next());
    let keys: Vec<&str> = cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).collect();
    assert!(keys.len() > 20, "{keys:?}");
    for key in keys {
        assert!(sources.contains(&format!("{{{key},")), "no source is called {key}");
    }
}

#[test]
fn scenarios_in_the_text_are_good() {
    let registry = Arc::new(landform::registry());
    for (page, text) in pages() {
        for block in blocks(&text) {
            if !is_scenario(&block) {
                continue;
            }
            let name = format!("{}:{}", shown(&page), block.line);
            let source = ScenarioSource::from_text(&name, &block.text, Path::new(""));
            let checked = source.parse(&registry).and_then(|scenario| {
                scenario
                    .check(source.folder(), Limits::default())
                    .map_err(|problem| source.render(&problem))
            });
            if let Err(message) = checked {
                panic!("{message}");
            }
        }
    }
}

#[cfg(unix)]
mod commands {
    use super::*;
    use landform_tests::{Ended, Scratch, cuts, executable, write_hills, write_shore};
    use std::process::{Command, Stdio};

    /// Commands that finish at once or can be cut; `reproduce` runs for minutes.
    const RUN: [&str; 12] = [
        "analyze",
        "run",
        "check",
        "list",
        "describe",
        "explain",
        "schema",
        "export",
        "view",
        "sweep",
        "collect",
        "completions",
    ];

    /// The calls of the program in a block, without prompt, continued lines joined.
    fn calls(block: &Block) -> Vec<String> {
        let text = block.text.replace("\\\n", " ");
        let line = |line: &str| line.trim().trim_start_matches("$ ").to_owned();
        let call = |line: String| {
            line.strip_prefix("cargo run --release -- ")
                .or(line.strip_prefix("target/release/landform "))
                .or(line.strip_prefix("landform "))
                .map(|rest| rest.split(" #").next().unwrap_or(rest).trim().to_owned())
        };
        text.lines().map(line).filter_map(call).collect()
    }

    /// The arguments that make a run small, quoted for the shell.
    fn small(scratch: &Scratch, call: &str) -> String {
        let scenario = call.split_whitespace().find(|word| word.ends_with(".ron"));
        let path = scratch.path(scenario.expect("a run has a scenario"));
        let cuts = cuts(&path, &scratch.path("hills.tif"));
        cuts.iter().map(|cut| format!(" '{cut}'")).collect()
    }

    fn run(scratch: &Scratch, call: &str) -> Ended {
        let cut = if call.starts_with("run ") { small(scratch, call) } else { String::new() };
        let mut shell = Command::new("sh");
        shell.current_dir(scratch.folder()).stdin(Stdio::null());
        shell.args(["-c", &format!("\"$0\" {call}{cut}")]).arg(executable());
        Ended::of(shell.output().expect("a shell"))
    }

    /// A folder that looks like the repository, for the commands of one page.
    fn checkout() -> Scratch {
        let scratch = Scratch::new("page");
        std::os::unix::fs::symlink(repository().join("scenarios"), scratch.path("scenarios"))
            .expect("a link");
        write_hills(&scratch.path("hills.tif"), 60, 44);
        // Whoever follows the book has a raster and a shore of his own under these names.
        for name in ["dem.tif", "my_dem.tif"] {
            write_hills(&scratch.path(name), 60, 44);
        }
        for name in ["hills.csv", "iceland.csv"] {
            write_shore(&scratch.path(name));
        }
        scratch.write("coast.csv", coast());
        scratch.write(
            "cave_legs.csv",
            "x1,y1,z1,x2,y2,z2\n0,0,0,9,0,-2\n9,0,-2,9,7,-2\n9,0,-2,15,0,1\n",
        );
        scratch
    }

    /// A round island, 220 km across, with bays.
    fn coast() -> String {
        let place = |index: u32| {
            let angle = f64::from(index % 3000) * std::f64::consts::TAU / 3000.0;
            let radius = 1.0 + 0.1 * (17.0 * angle).sin();
            format!("{},{}\n", radius * angle.cos(), radius * angle.sin())
        };
        (0..=3000).map(place).fold("lon,lat\n".to_owned(), |text, line| text + &line)
    }

    /// Puts the scenario above a call into the file that the call names, if there is none.
    fn provide(scratch: &Scratch, call: &str, above: Option<&Block>) {
        let named = call.split_whitespace().filter(|word| word.ends_with(".ron"));
        for file in named.filter(|file| !scratch.path(file).exists()) {
            let block = above.unwrap_or_else(|| panic!("no scenario stands above `{call}`"));
            scratch.write(file, &block.text);
        }
    }

    fn run_all(name: &str, page: &[Block]) -> usize {
        let scratch = checkout();
        let mut count = 0;
        let mut above = None;
        for block in page {
            if is_scenario(block) {
                above = Some(block);
            }
            let shell = ["sh", "bash", "console", "shell"].iter().any(|shell| says(block, shell));
            for call in calls(block).iter().filter(|_| shell && !says(block, "ignore")) {
                let command = call.split_whitespace().next().unwrap_or_default();
                if RUN.contains(&command) || command.starts_with('-') {
                    provide(&scratch, call, above);
                    let ended = run(&scratch, call);
                    assert_eq!(ended.status, Some(0), "{name}:{}: {call}: {ended:?}", block.line);
                    count += 1;
                }
            }
        }
        count
    }

    #[test]
    fn commands_of_the_pages_run() {
        let mut total = 0;
        for (page, text) in pages() {
            let count = run_all(&shown(&page), &blocks(&text));
            println!("{}: {count} commands", shown(&page));
            total += count;
        }
        assert!(total > 10, "{total} commands were found");
    }

    #[test]
    fn examples_of_the_help_run() {
        let scratch = Scratch::new("help");
        let mut count = 0;
        for command in ["", "run", "export", "view", "analyze", "completions"] {
            let help = run(
                &scratch,
                &format!("{command} --help").trim_start().replace("run --", "help run --"),
            );
            let text = if help.status == Some(0) { help.stdout } else { String::new() };
            let examples = text.split("Example").nth(1).unwrap_or_default();
            let block =
                |text: &str| Block { line: 0, language: "sh".to_owned(), text: text.to_owned() };
            // A run to draw and to export, for the examples that begin with one.
            let before = "landform run scenarios/gallery/dunes.ron -o out/dunes --force\n";
            let own = examples.replace("> ~/.local/share/bash-completion/completions/", "> ");
            let page = [block(before), block(&own)];
            count += run_all(&format!("landform {command} --help"), &page) - 1;
        }
        assert!(count >= 7, "{count} examples were found");
    }
}
