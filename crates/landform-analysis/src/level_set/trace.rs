//! Joins pieces of lines end to end.

/// Joins `pieces` (start, end), of which at most one starts and at most one ends at a place,
/// to lines. The last place of a closed line is its first.
pub(super) fn lines(pieces: &[[u64; 2]]) -> Vec<Vec<u64>> {
    let mut by_start = pieces.to_vec();
    by_start.sort_unstable();
    let mut ends: Vec<u64> = pieces.iter().map(|piece| piece[1]).collect();
    ends.sort_unstable();
    let is_loose = |piece: &[u64; 2]| ends.binary_search(&piece[0]).is_err();
    let mut used = vec![false; by_start.len()];
    let mut lines = Vec::new();
    let loose = (0..by_start.len()).filter(|&index| is_loose(&by_start[index]));
    // Once the open lines are gone, whatever is left belongs to a closed one.
    for first in loose.chain(0..by_start.len()) {
        if !used[first] {
            lines.push(follow(&by_start, first, &mut used));
        }
    }
    lines
}

/// The line that starts with the piece `first`.
fn follow(by_start: &[[u64; 2]], first: usize, used: &mut [bool]) -> Vec<u64> {
    let mut line = vec![by_start[first][0]];
    let mut next = Some(first);
    while let Some(index) = next.filter(|&index| !used[index]) {
        used[index] = true;
        line.push(by_start[index][1]);
        next = by_start.binary_search_by_key(&by_start[index][1], |piece| piece[0]).ok();
    }
    line
}
