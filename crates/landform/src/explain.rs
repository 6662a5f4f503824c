//! What the numbers of messages mean: one text for the book and for `landform explain`.

use landform_io::IoError;
use landform_sim::code::Code;
use landform_sim::parameters::Problem;

/// A page of the book.
macro_rules! page {
    ($code:literal) => {
        include_str!(concat!("../../../docs/src/errors/", $code, ".md"))
    };
}

/// The page of a code, as Markdown: what it means, a small input that causes it, why it is
/// refused, and what to do. Its first line is `# L0201: ` and the title.
pub fn page(code: Code) -> &'static str {
    match code {
        Code::Arguments => page!("L0001"),
        Code::UnknownSubject => page!("L0002"),
        Code::Notation => page!("L0101"),
        Code::UnknownName => page!("L0102"),
        Code::MissingField => page!("L0103"),
        Code::RepeatedField => page!("L0104"),
        Code::WrongType => page!("L0105"),
        Code::Edit => page!("L0106"),
        Code::UnreadableScenario => page!("L0107"),
        Code::OutOfRange => page!("L0201"),
        Code::Unsuitable => page!("L0202"),
        Code::Stage => page!("L0203"),
        Code::Never => page!("L0204"),
        Code::Memory => page!("L0301"),
        Code::NotInRun => page!("L0302"),
        Code::NotProvided => page!("L0303"),
        Code::Contradiction => page!("L0304"),
        Code::InitialValues => page!("L0305"),
        Code::UnreadableFile => page!("L0401"),
        Code::DamagedFile => page!("L0402"),
        Code::LargeFile => page!("L0403"),
        Code::UnknownFormat => page!("L0404"),
        Code::NoSpacing => page!("L0405"),
        Code::Gaps => page!("L0406"),
        Code::OtherSize => page!("L0407"),
        Code::NoRun => page!("L0408"),
        Code::NoCheckpoint => page!("L0501"),
        Code::OtherScenario => page!("L0502"),
        Code::DamagedCheckpoint => page!("L0503"),
        Code::Busy => page!("L0504"),
        Code::NotFinite => page!("L0601"),
        Code::Budget => page!("L0602"),
        Code::Fault => page!("L0603"),
        Code::Plugin => page!("L0604"),
        Code::Recording => page!("L0605"),
        Code::Interrupted => page!("L0606"),
        Code::Rulers => page!("L0701"),
        Code::Sweep => page!("L0801"),
        Code::SweptRun => page!("L0802"),
        Code::Disk => page!("L0803"),
        Code::OtherSweep => page!("L0804"),
        Code::FailedRuns => page!("L0805"),
        Code::Figure => page!("L0901"),
        Code::FailedFigure => page!("L0902"),
        Code::FolderInUse => page!("L1001"),
        Code::Unwritable => page!("L1002"),
        Code::FileExists => page!("L1003"),
        Code::OutputFile => page!("L1004"),
        Code::Picture => page!("L1005"),
        Code::OtherFormat => page!("L1006"),
    }
}

/// The title of a code's page.
pub fn title(code: Code) -> &'static str {
    let line = page(code).lines().next().unwrap_or_default();
    line.split_once(": ").map_or(line, |(_, title)| title)
}

/// The code of a file that cannot be read or written.
pub fn code_of_file(error: &IoError) -> Code {
    Code::named(error.code()).unwrap_or_default()
}

/// A file that cannot be read or written, as a problem with the parameter that names it.
pub(crate) fn file_problem(parameter: &str, error: &IoError) -> Problem {
    Problem::new(parameter, error.to_string(), "").code(code_of_file(error))
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::path::{Path, PathBuf};

    use landform_io::Fault;

    use super::*;

    #[test]
    fn every_page_begins_with_its_code_and_a_title() {
        for code in Code::ALL {
            assert!(page(code).starts_with(&format!("# {code}: ")), "{code}");
            assert!(!title(code).is_empty() && !title(code).ends_with('.'), "{code}");
        }
    }

    #[test]
    fn files_have_codes_that_exist() {
        let path = PathBuf::from("a.tif");
        let system = |doing| IoError::system(Path::new("a.tif"), doing, io::Error::other("no"));
        let fault = || Fault::new("a", "b", "c");
        let cases = [
            (system("read"), Code::UnreadableFile),
            (system("open"), Code::UnreadableFile),
            (system("write"), Code::Unwritable),
            (fault().reading(&path), Code::DamagedFile),
            (fault().writing(&path), Code::OtherFormat),
            (
                IoError::TooLarge { path: path.clone(), size: String::new(), limit: 1 },
                Code::LargeFile,
            ),
            (IoError::Exists { path: path.clone() }, Code::FileExists),
            (
                IoError::UnknownFormat { path, extension: String::new(), known: "tif" },
                Code::UnknownFormat,
            ),
        ];
        for (error, code) in cases {
            assert_eq!(code_of_file(&error), code, "{error}");
        }
    }
}
