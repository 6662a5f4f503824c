//! What `--resume` does with folders and checkpoints that are not those of the run.

use std::borrow::Cow;
use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use landform::io::IfExists;
use landform::io::npz::{self, Content, Member};
use landform_tests::{Ended, Program, Scratch};

const SCENARIO: &str = r#"(
    title: "A run to resume",
    domain: Grid(size: (32, 24)),
    initial: [(field: "sand", from: WhiteNoise(mean_m: 20.0, amplitude_m: 5.0))],
    stages: [(processes: [Smoothing()], stop: Iterations(1000000000))],
    metrics: [FieldStatistic(field: "sand")],
    measure_every: 1000,
    outputs: [Animation(file: "run.gif", every: 1000)],
)
"#;

/// A folder with a run that was killed after its first checkpoint, in `o`.
fn killed() -> Scratch {
    let scratch = Scratch::new("resume_refused");
    scratch.write("run.ron", SCENARIO);
    let call = Program::within(scratch.folder()).line("run run.ron -o o --checkpoint-every 10it");
    let mut child = call.start();
    while !state(&scratch).exists() {
        sleep(Duration::from_millis(5));
        assert!(child.try_wait().expect("a state").is_none(), "it runs long enough");
    }
    child.kill().expect("it can be killed");
    child.wait().expect("it ends");
    scratch
}

fn state(scratch: &Scratch) -> std::path::PathBuf {
    scratch.path("o/checkpoint/state.npz")
}

fn call(scratch: &Scratch, line: &str) -> Ended {
    Program::within(scratch.folder()).line(line).run()
}

#[track_caller]
fn refused(scratch: &Scratch, line: &str, parts: &[&str]) {
    let message = call(scratch, line).refused();
    for part in parts {
        assert!(message.contains(part), "{part} in {message}");
    }
}

#[test]
fn a_checkpoint_of_another_run_is_refused_with_the_difference() {
    let scratch = killed();
    let resume = "run run.ron -o o --resume";
    refused(&scratch, &format!("{resume} --seed 9"), &["its seed is 1, this run's is 9"]);
    refused(
        &scratch,
        &format!("{resume} --set domain.size=(32,25)"),
        &["another scenario", "line 3", "(32, 24)", "(32,25)", "another folder"],
    );
    refused(&scratch, &format!("{resume} --force"), &["--force", "--resume"]);
    refused(&scratch, "run run.ron --resume", &["--output"]);
    refused(&scratch, "run run.ron -o run.ron --resume", &["run.ron"]);
    fs::create_dir(scratch.path("mine")).expect("a folder");
    scratch.write("mine/notes.txt", "mine");
    refused(
        &scratch,
        "run run.ron -o mine --resume",
        &["no checkpoint in mine", "without --resume"],
    );
    for interval in ["ten", "5", "-1s", "1e400s", "0.5it", "it", "5 parsecs", "infs"] {
        let interval = format!("--checkpoint-every={interval}");
        let line = ["run", "run.ron", &interval];
        let message = Program::within(scratch.folder()).args(line).run().refused();
        assert!(message.contains("10min"), "{message}");
    }
}

#[test]
fn a_checkpoint_of_another_version_or_ground_is_refused() {
    let scratch = killed();
    let changes = [
        ("\"format\": 1", "\"format\": 2", "its format is 2, this run's is 1"),
        ("\"version\": \"", "\"version\": \"9", "version of Landform is 9"),
        ("\"start\": \"", "\"start\": \"0", "ground at the start"),
        ("\"Smoothing\"", "\"Dunes\"", "list of stages is Dunes"),
        ("\"stage\": 0", "\"stage\": 7", "stages do not fit"),
        ("\"tick\":", "\"tock\":", "missing field `tick`"),
    ];
    for (from, to, message) in changes {
        with_member(
            &state(&scratch),
            "manifest.json",
            |content| {
                let Content::Text(text) = content else { panic!("a text") };
                assert!(text.contains(from), "{from} in {text}");
                Some(Content::Text(Cow::Owned(text.replacen(from, to, 1))))
            },
            || refused(&scratch, "run run.ron -o o --resume", &[message]),
        );
    }
}

#[test]
fn a_checkpoint_whose_parts_do_not_fit_is_refused() {
    let scratch = killed();
    let short = |content: &Content<'static>| match content {
        Content::Array { kind, shape, bytes } => {
            let size = bytes.len().checked_div(shape.iter().product())?;
            let (shape, bytes) = (vec![bytes.len() / size - 1], bytes[size..].to_vec().into());
            Some(Content::Array { kind: kind.clone(), shape, bytes })
        }
        Content::Text(text) => Some(Content::Text(text[..text.len() / 2].to_owned().into())),
    };
    let names: Vec<String> = npz::read(&state(&scratch))
        .expect("a checkpoint")
        .into_iter()
        .map(|member| member.name)
        .collect();
    assert!(names.iter().any(|name| name == "fields/sand.npy"), "{names:?}");
    for name in names {
        let resume = || {
            let message = call(&scratch, "run run.ron -o o --resume").refused();
            assert!(message.contains("state.npz") || message.contains("scenario"), "{message}");
        };
        with_member(&state(&scratch), &name, |_| None, resume);
        with_member(&state(&scratch), &name, short, resume);
    }
}

/// Calls `look` while a member of an archive is changed, or gone.
fn with_member(
    path: &Path,
    name: &str,
    change: impl Fn(&Content<'static>) -> Option<Content<'static>>,
    look: impl Fn(),
) {
    let good = fs::read(path).expect("a checkpoint");
    let members = npz::read(path).expect("a checkpoint").into_iter();
    let members: Vec<Member<'_>> = members
        .filter_map(|member| match member.name == name {
            true => Some(Member { content: change(&member.content)?, ..member }),
            false => Some(member),
        })
        .collect();
    npz::write(path, &members, IfExists::Replace).expect("it can be written");
    look();
    fs::write(path, good).expect("it can be written");
}

#[test]
fn a_damaged_checkpoint_is_refused_and_left_as_it_is() {
    let scratch = killed();
    let good = fs::read(state(&scratch)).expect("a checkpoint");
    let cuts = (0..12).map(|part| good[..part * good.len() / 12].to_vec());
    let flips = (0..12).map(|part| {
        let mut bytes = good.clone();
        let byte = (2 * part + 1) * bytes.len() / 24;
        bytes[byte] ^= 1 << (part % 8);
        bytes
    });
    for damaged in cuts.chain(flips) {
        fs::write(state(&scratch), &damaged).expect("it can be written");
        refused(&scratch, "run run.ron -o o --resume", &["state.npz", "damaged"]);
        assert_eq!(fs::read(state(&scratch)).expect("it is there"), damaged);
    }
    fs::write(state(&scratch), &good).expect("it can be written");
    let frames = scratch.path("o/checkpoint/run.gif");
    let whole = fs::read(&frames).expect("frames");
    fs::write(&frames, &whole[..whole.len() / 2]).expect("it can be written");
    refused(&scratch, "run run.ron -o o --resume", &["outputs/0/frames", "run.gif"]);
    fs::remove_file(&frames).expect("it can go");
    refused(&scratch, "run run.ron -o o --resume", &["outputs/0/frames", "run.gif"]);
}

#[test]
fn a_finished_run_says_so_and_stays() {
    let scratch = Scratch::new("resume_finished");
    scratch.write("run.ron", SCENARIO.replace("1000000000", "5"));
    call(&scratch, "run run.ron -o o --resume").good();
    assert!(!scratch.path("o/checkpoint").exists(), "nothing is left to resume from");
    let before = fs::read(scratch.path("o/report.json")).expect("a report");
    let ended = call(&scratch, "run run.ron -o o --resume");
    assert_eq!((ended.status, ended.stdout.as_str()), (Some(0), ""));
    assert!(ended.stderr.contains("the run in o is over"), "{ended:?}");
    assert_eq!(fs::read(scratch.path("o/report.json")).expect("a report"), before);
    refused(&scratch, "run run.ron -o o --resume --set title=\"Other\"", &["line 2"]);
}

/// A process that is killed while it tries out the folder leaves a file there.
#[test]
fn a_run_that_was_killed_before_it_began_begins_again() {
    let scratch = Scratch::new("resume_refused");
    scratch.write("run.ron", SCENARIO.replace("1000000000", "3"));
    for options in ["--resume", ""] {
        let folder = scratch.path("o");
        std::fs::create_dir(&folder).expect("a folder");
        std::fs::write(folder.join(".landform-probe.tmp"), "").expect("a file");
        call(&scratch, &format!("run run.ron -o o {options}")).good();
        assert!(!folder.join(".landform-probe.tmp").exists());
        std::fs::remove_dir_all(folder).expect("the folder can go");
    }
}

#[test]
fn two_processes_do_not_work_in_one_folder() {
    let scratch = Scratch::new("resume_claim");
    scratch.write("run.ron", SCENARIO);
    let call = Program::within(scratch.folder()).line("run run.ron -o o --checkpoint-every 10it");
    let mut child = call.start();
    while !state(&scratch).exists() {
        sleep(Duration::from_millis(5));
    }
    for way in ["--resume", "--force"] {
        refused(&scratch, &format!("run run.ron -o o {way}"), &["another run is at work in o"]);
    }
    child.kill().expect("it can be killed");
    child.wait().expect("it ends");
}

#[test]
fn a_new_run_by_force_forgets_the_checkpoint_of_the_old_one() {
    let scratch = killed();
    scratch.write("run.ron", SCENARIO.replace("1000000000", "5"));
    call(&scratch, "run run.ron -o o --force").good();
    assert!(!scratch.path("o/checkpoint").exists());
}
