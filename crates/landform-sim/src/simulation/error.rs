//! Why a run stopped before its end.

use thiserror::Error;

use crate::checkpoint::Damage;
use crate::code::Code;
use crate::parameters::Problem;

/// Why a run stopped before its end.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RunError {
    /// A value became infinite or NaN.
    #[error(
        "field `{field}` became {value} at node {node} (column {column}, row {row}, layer {layer}) \
         in iteration {iteration}, in the turn of `{process}`; a rate or a step is probably too \
         large for the spacing"
    )]
    NotFinite {
        /// The process whose turn it was.
        process: String,
        /// The field.
        field: String,
        /// The value.
        value: f64,
        /// Index of the node.
        node: usize,
        /// Its column.
        column: usize,
        /// Its row.
        row: usize,
        /// Its layer.
        layer: usize,
        /// Iteration of the run, from zero.
        iteration: u64,
    },
    /// A budget did not close.
    #[error(
        "`{process}` lost or made {account} in iteration {iteration}: {expected:e} {unit} should \
         be there and {measured:e} {unit} are; this is a defect of the process"
    )]
    Budget {
        /// The process whose turn it was.
        process: String,
        /// The account.
        account: String,
        /// Unit of the amounts.
        unit: String,
        /// Amount by the books.
        expected: f64,
        /// Amount that is there.
        measured: f64,
        /// Iteration of the run, from zero.
        iteration: u64,
    },
    /// A process could not go on.
    #[error("`{process}` stopped in iteration {iteration}: {message}")]
    Fault {
        /// The process whose turn it was.
        process: String,
        /// What it said.
        message: String,
        /// Iteration of the run, from zero.
        iteration: u64,
    },
    /// The plugin of a process is wrong: systems without an order, say.
    #[error("the plugin of `{process}` cannot run: {message}")]
    Plugin {
        /// The process.
        process: String,
        /// What is wrong.
        message: String,
    },
    /// A metric or an output failed.
    #[error("{name}: {problem}")]
    Recording {
        /// Name of the metric or output.
        name: String,
        /// Why.
        problem: Box<Problem>,
    },
    /// A checkpoint does not fit what the processes keep.
    #[error("the run cannot go on: {0}")]
    Damaged(#[from] Damage),
    /// The progress hook asked for the end.
    #[error("interrupted after {iterations} iterations")]
    Interrupted {
        /// Whether a checkpoint was kept, from which the run can go on.
        kept: bool,
        /// Iterations that were finished.
        iterations: u64,
    },
}

impl RunError {
    /// Its number.
    pub fn code(&self) -> Code {
        match self {
            Self::NotFinite { .. } => Code::NotFinite,
            Self::Budget { .. } => Code::Budget,
            Self::Fault { .. } => Code::Fault,
            Self::Plugin { .. } => Code::Plugin,
            Self::Recording { problem, .. } => match problem.code {
                Code::Unsuitable | Code::Picture => Code::Recording,
                code => code,
            },
            Self::Damaged(damage) => damage.code(),
            Self::Interrupted { .. } => Code::Interrupted,
        }
    }
}
