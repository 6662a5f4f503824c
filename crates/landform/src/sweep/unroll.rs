//! From a sweep to its runs.

use std::collections::BTreeSet;

use landform_sim::parameters::Problem;

use super::draw;
use super::file::{Listed, Sampled, Seeds, Sweep, Vary};

/// Most runs of a sweep: more folders than that no file system and no reader likes.
const MOST_RUNS: u128 = 100_000;

/// A parameter that differs between runs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Varied {
    /// Name in the table.
    pub name: String,
    /// Path in the scenario.
    pub path: String,
    /// Path of its entry in the sweep file.
    pub place: String,
}

/// A run: the values of the parameters and a seed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Run {
    /// Number of the point; runs at one point differ in their seed only.
    pub point: usize,
    /// Seed.
    pub seed: u64,
    /// A value for each parameter, as RON.
    pub values: Vec<String>,
}

/// The parameters and the runs of a sweep: points in the order of the file, the last parameter of
/// the last block first, and at each point its seeds.
///
/// # Errors
/// The [`Problem`] holds the path of its place in the sweep file.
pub(crate) fn runs(sweep: &Sweep) -> Result<(Vec<Varied>, Vec<Run>), Problem> {
    let parameters = parameters(sweep)?;
    check_counts(sweep)?;
    let mut points = vec![Vec::new()];
    for (index, block) in sweep.vary.iter().enumerate() {
        points = combined(&points, &block_points(block, sweep.seed, index));
    }
    let mut taken = BTreeSet::new();
    let mut runs = Vec::new();
    for (point, values) in points.into_iter().enumerate() {
        for seed in seeds(sweep, point, &mut taken) {
            runs.push(Run { point, seed, values: values.clone() });
        }
    }
    Ok((parameters, runs))
}

/// Every point of one list with every point of another, the second running faster.
fn combined(first: &[Vec<String>], second: &[Vec<String>]) -> Vec<Vec<String>> {
    let pairs = first.iter().flat_map(|one| second.iter().map(move |two| (one, two)));
    pairs.map(|(one, two)| [one.as_slice(), two].concat()).collect()
}

/// The values of the parameters of a block at each of its points.
fn block_points(block: &Vary, seed: u64, index: usize) -> Vec<Vec<String>> {
    let texts = |listed: &Listed| -> Vec<String> {
        listed.values.iter().map(|value| value.trim().get_ron().to_owned()).collect()
    };
    match block {
        Vary::Grid(list) => list.iter().fold(vec![Vec::new()], |points, listed| {
            let own: Vec<Vec<String>> = texts(listed).into_iter().map(|text| vec![text]).collect();
            combined(&points, &own)
        }),
        Vary::Zip(list) => transposed(&list.iter().map(texts).collect::<Vec<_>>()),
        Vary::Random { samples, parameters } => {
            let column = |(number, parameter): (usize, &Sampled)| -> Vec<String> {
                let share = |sample| draw::random(seed, index, sample, number);
                (0..*samples).map(|sample| parameter.from.at(share(sample))).collect()
            };
            transposed(&parameters.iter().enumerate().map(column).collect::<Vec<_>>())
        }
        Vary::LatinHypercube { samples, parameters } => {
            let column = |(number, parameter): (usize, &Sampled)| -> Vec<String> {
                let shares = draw::stratified(seed, index, *samples, number);
                shares.into_iter().map(|share| parameter.from.at(share)).collect()
            };
            transposed(&parameters.iter().enumerate().map(column).collect::<Vec<_>>())
        }
    }
}

/// Rows from columns of one length.
fn transposed(columns: &[Vec<String>]) -> Vec<Vec<String>> {
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows).map(|row| columns.iter().map(|column| column[row].clone()).collect()).collect()
}

/// The seeds of a point. Those that the sweep gives are told apart from all before.
fn seeds(sweep: &Sweep, point: usize, taken: &mut BTreeSet<u64>) -> Vec<u64> {
    match &sweep.seeds {
        Seeds::List(list) => list.clone(),
        Seeds::Count(count) => {
            let own = |replicate: u64| {
                let candidates = |attempt| draw::seed(sweep.seed, point, replicate as u32, attempt);
                (0..).map(candidates).find(|&seed| taken.insert(seed)).unwrap_or_default()
            };
            (0..*count).map(own).collect()
        }
    }
}

/// The parameters of all blocks in the order of the file, with names of their own.
fn parameters(sweep: &Sweep) -> Result<Vec<Varied>, Problem> {
    let mut parameters: Vec<Varied> = Vec::new();
    for (block, vary) in sweep.vary.iter().enumerate() {
        let (entries, inner): (Vec<(&str, &str)>, _) = match vary {
            Vary::Grid(list) | Vary::Zip(list) => {
                (list.iter().map(|listed| (&*listed.path, &*listed.name)).collect(), "")
            }
            Vary::Random { parameters, .. } | Vary::LatinHypercube { parameters, .. } => (
                parameters.iter().map(|sampled| (&*sampled.path, &*sampled.name)).collect(),
                ".parameters",
            ),
        };
        for (index, (path, name)) in entries.into_iter().enumerate() {
            let place = format!("vary[{block}]{inner}[{index}]");
            let name = if name.is_empty() { last_part(path) } else { name }.to_owned();
            check_parameter(sweep, &parameters, path, &name, &place)?;
            parameters.push(Varied { name, path: path.to_owned(), place });
        }
    }
    Ok(parameters)
}

/// The end of a path: `slab_m` of `stages[0].processes.Dunes.slab_m`.
fn last_part(path: &str) -> &str {
    let end = path.rsplit('.').next().unwrap_or(path);
    end.split('[').next().filter(|name| !name.is_empty()).unwrap_or(path)
}

fn check_parameter(
    sweep: &Sweep,
    before: &[Varied],
    path: &str,
    name: &str,
    place: &str,
) -> Result<(), Problem> {
    /// Columns that the table has in any case.
    const OWN: [&str; 5] = ["run", "seed", "status", "reason", "iterations"];
    let path_place = format!("{place}.path");
    if path.trim() == "seed" {
        return Err(Problem::new(path_place, "seeds are no parameter", "an entry in `seeds`")
            .help("write seeds: Count(5), or seeds: List([1, 2, 3])"));
    }
    let fixed = sweep.set.iter().any(|change| change.path == path);
    if fixed || before.iter().any(|other| other.path == path) {
        let message = format!("`{path}` is set twice");
        return Err(Problem::new(path_place, message, "each path once"));
    }
    if OWN.contains(&name) || before.iter().any(|other| other.name == name) {
        let message = format!("a column of the table is called `{name}` already");
        return Err(Problem::new(place, message, "a name of its own")
            .help("add name: \"...\" to the entry"));
    }
    Ok(())
}

/// Checks lists, ranges and seeds, and that there are not too many runs, before any are made.
fn check_counts(sweep: &Sweep) -> Result<(), Problem> {
    let seeds = match &sweep.seeds {
        Seeds::Count(count) => u128::from(*count),
        Seeds::List(list) => {
            let distinct: BTreeSet<&u64> = list.iter().collect();
            if distinct.len() < list.len() {
                let message = "a seed stands twice, so two runs would be the same";
                return Err(Problem::new("seeds", message, "each seed once"));
            }
            list.len() as u128
        }
    };
    if seeds == 0 {
        return Err(Problem::new("seeds", "zero seeds make no run", "at least one"));
    }
    let mut count = seeds;
    for (block, vary) in sweep.vary.iter().enumerate() {
        count = count.saturating_mul(check_block(vary, &format!("vary[{block}]"))?);
    }
    if count > MOST_RUNS {
        let expected = format!("at most {MOST_RUNS}");
        let message = format!("the sweep has {count} runs");
        return Err(Problem::new("vary", message, expected).help(
            "vary fewer parameters, give them fewer values, or take samples: \
             LatinHypercube(samples: 200, parameters: [...])",
        ));
    }
    Ok(())
}

/// Checks a block and returns the number of its points.
fn check_block(block: &Vary, place: &str) -> Result<u128, Problem> {
    let (list, sampled, samples) = match block {
        Vary::Grid(list) | Vary::Zip(list) => (list.as_slice(), &[][..], 1),
        Vary::Random { samples, parameters } | Vary::LatinHypercube { samples, parameters } => {
            (&[][..], parameters.as_slice(), *samples)
        }
    };
    if list.is_empty() && sampled.is_empty() {
        return Err(Problem::new(place, "the block varies nothing", "at least one parameter"));
    }
    if samples == 0 {
        let place = format!("{place}.samples");
        return Err(Problem::new(place, "zero samples make no run", "at least one"));
    }
    if let Some(index) = list.iter().position(|listed| listed.values.is_empty()) {
        let place = format!("{place}[{index}].values");
        return Err(Problem::new(place, "the list is empty", "at least one value"));
    }
    for (index, parameter) in sampled.iter().enumerate() {
        if let Some(expected) = parameter.from.problem() {
            let place = format!("{place}.parameters[{index}].from");
            return Err(Problem::new(place, "nothing can be drawn from this range", expected));
        }
    }
    let lengths = list.iter().map(|listed| listed.values.len() as u128);
    match block {
        Vary::Grid(_) => Ok(lengths.fold(1, u128::saturating_mul)),
        Vary::Zip(_) => {
            match lengths.clone().position(|length| Some(length) != lengths.clone().next()) {
                None => Ok(lengths.max().unwrap_or(0)),
                Some(index) => {
                    let (first, other) = (list[0].values.len(), list[index].values.len());
                    let message = format!("the first list has {first} values and this one {other}");
                    let place = format!("{place}[{index}].values");
                    Err(Problem::new(place, message, "lists of one length").help(
                        "Zip takes first values together, then second ones; Grid combines all",
                    ))
                }
            }
        }
        _ => Ok(samples as u128),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::SweepSource;
    use super::*;

    fn sweep(text: &str) -> Sweep {
        let source = SweepSource::from_text(text, Path::new(""));
        source.parse(Path::new("test.sweep.ron")).unwrap_or_else(|error| panic!("{error}"))
    }

    fn points(vary: &str) -> Vec<Vec<String>> {
        let (_, runs) = runs(&sweep(&format!("(scenario: \"s.ron\", vary: [{vary}])"))).unwrap();
        runs.into_iter().map(|run| run.values).collect()
    }

    #[test]
    fn grids_combine_lists_go_together_and_blocks_multiply() {
        let grid =
            "Grid([(path: \"a.x\", values: [1, 2.5]), (path: \"b\", values: [\"u\", A(k: 1)])])";
        assert_eq!(
            points(grid),
            [["1", "\"u\""], ["1", "A(k: 1)"], ["2.5", "\"u\""], ["2.5", "A(k: 1)"]]
        );
        let zip = "Zip([(path: \"c\", values: [1, 2]), (path: \"d\", values: [3, 4])])";
        assert_eq!(points(zip), [["1", "3"], ["2", "4"]]);
        let both = points(&format!("{grid}, {zip}"));
        assert_eq!((both.len(), both[1].join(" ")), (8, "1 \"u\" 2 4".to_owned()));
    }

    #[test]
    fn samples_depend_on_the_seed_alone() {
        let text = |seed: u64| {
            format!(
                "(scenario: \"s\", seed: {seed}, vary: [LatinHypercube(samples: 5, parameters: [\
                (path: \"a\", from: Uniform(0.0, 1.0)), (path: \"b\", from: Integer(1, 5))])])"
            )
        };
        let first = runs(&sweep(&text(1))).unwrap();
        assert_eq!(first, runs(&sweep(&text(1))).unwrap());
        assert_ne!(first, runs(&sweep(&text(2))).unwrap());
        let mut whole: Vec<&str> = first.1.iter().map(|run| run.values[1].as_str()).collect();
        whole.sort_unstable();
        assert_eq!(whole, ["1", "2", "3", "4", "5"]);
    }

    #[test]
    fn no_two_runs_share_a_seed_unless_they_are_told_to() {
        let (_, all) = runs(&sweep(
            "(scenario: \"s\", seeds: Count(20), vary: [Random(samples: 100, parameters: [(path: \"a\", from: Uniform(0.0, 1.0))])])",
        )).unwrap();
        let seeds: BTreeSet<u64> = all.iter().map(|run| run.seed).collect();
        assert_eq!((all.len(), seeds.len()), (2000, 2000));
        assert!(seeds.iter().all(|&seed| seed < 1 << 53));
        let (_, shared) = runs(&sweep(
            "(scenario: \"s\", seeds: List([4, 9]), vary: [Grid([(path: \"a\", values: [1, 2])])])",
        ))
        .unwrap();
        assert_eq!(shared.iter().map(|run| run.seed).collect::<Vec<_>>(), [4, 9, 4, 9]);
        assert_eq!(shared.iter().map(|run| run.point).collect::<Vec<_>>(), [0, 0, 1, 1]);
    }

    #[test]
    fn what_makes_no_sense_is_refused_with_its_place() {
        let many: String = (0..9)
            .map(|index| format!("(path: \"p{index}\", values: [1,2,3,4,5,6,7,8,9,10]),"))
            .collect();
        for (rest, place, part) in [
            (format!("vary: [Grid([{many}])]"), "vary", "1000000000 runs"),
            ("vary: [Random(samples: 4000000000, parameters: [(path: \"a\", from: Integer(1, 2))])]".into(), "vary", "4000000000 runs"),
            ("seeds: Count(18446744073709551615)".into(), "vary", "18446744073709551615 runs"),
            ("seeds: Count(0)".into(), "seeds", "zero seeds"),
            ("seeds: List([1, 1])".into(), "seeds", "stands twice"),
            ("vary: [Grid([])]".into(), "vary[0]", "varies nothing"),
            ("vary: [Grid([(path: \"a\", values: [])])]".into(), "vary[0][0].values", "empty"),
            ("vary: [Zip([(path: \"a\", values: [1]), (path: \"b\", values: [1, 2])])]".into(), "vary[0][1].values", "one 2"),
            ("vary: [LatinHypercube(samples: 0, parameters: [(path: \"a\", from: Integer(1, 2))])]".into(), "vary[0].samples", "zero samples"),
            ("vary: [Random(samples: 1, parameters: [(path: \"a\", from: LogUniform(0.0, 2.0))])]".into(), "vary[0].parameters[0].from", "drawn"),
            ("vary: [Grid([(path: \"seed\", values: [1])])]".into(), "vary[0][0].path", "no parameter"),
            ("vary: [Grid([(path: \"x.a\", values: [1]), (path: \"y.a\", values: [1])])]".into(), "vary[0][1]", "`a` already"),
            ("set: [(path: \"a\", value: 1)], vary: [Grid([(path: \"a\", values: [1])])]".into(), "vary[0][0].path", "twice"),
        ] {
            let problem = runs(&sweep(&format!("(scenario: \"s\", {rest})"))).unwrap_err();
            assert_eq!(problem.parameter, place, "{rest}");
            assert!(problem.message.contains(part), "{rest}: {problem}");
        }
    }
}
