//! Many sets of points at once, each for itself: a task takes a set, which is quick where sets are small and many.

use crate::delaunay::Delaunay;
use crate::edges::{Edges, sort};
use crate::error::{Error, Result};
use crate::point::Point;
use crate::progress::{Progress, Stage};
use rayon::prelude::*;

/// The edges that `method` selects within each group of `points`, all in one canonical list.
///
/// `rows` lists the rows of the groups one after another, in ascending order within each; group k ends before `ends[k]`.
///
/// # Errors
/// Those of a triangulation, which name the row, or of `method`; a cancelled `progress`.
pub fn select_by_group(
    points: &[Point],
    rows: &[u32],
    ends: &[usize],
    progress: &Progress,
    method: impl Fn(&Delaunay, &Progress) -> Result<Edges> + Sync,
) -> Result<Edges> {
    progress.enter(Stage::Select, rows.len())?;
    let within = |k: usize| {
        let start = if k == 0 { 0 } else { ends[k - 1] };
        let rows = &rows[start..ends[k]];
        let edges = edges_within(points, rows, &progress.quiet(), &method)?;
        progress.advance(rows.len())?;
        Ok(edges)
    };
    let parts = (0..ends.len()).into_par_iter().map(within).collect::<Result<Vec<_>>>()?;
    Ok(sort(&parts, points.len()))
}

/// The edges within one group.
fn edges_within(
    points: &[Point],
    rows: &[u32],
    progress: &Progress,
    method: impl Fn(&Delaunay, &Progress) -> Result<Edges>,
) -> Result<Edges> {
    let group: Vec<Point> = rows.iter().map(|&row| points[row as usize]).collect();
    let in_all = |error| match error {
        Error::Range { row, value, largest } => {
            Error::Range { row: rows[row] as usize, value, largest }
        }
        other => other,
    };
    let mut edges = method(&Delaunay::new(&group, progress).map_err(in_all)?, progress)?;
    for row in edges.as_flattened_mut() {
        *row = rows[*row as usize];
    }
    Ok(edges)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::crust;

    #[test]
    fn edges_by_group_are_those_of_each_group_alone() {
        let at = |k: u32| [f64::from(k * 7919 % 1009), f64::from(k * 104_729 % 997)];
        let points: Vec<Point> = (0..400).map(at).collect();
        // Groups of 1, 2, 3, … rows, interleaved, and an empty one.
        let mut groups: Vec<Vec<u32>> =
            (0..13).map(|g| (0..400).filter(|k| k % 13 == g).collect()).collect();
        groups[3].truncate(1);
        groups[5].clear();
        let rows = groups.concat();
        let ends: Vec<usize> = groups
            .iter()
            .scan(0, |end, group| {
                *end += group.len();
                Some(*end)
            })
            .collect();
        let progress = Progress::default();
        let edges = select_by_group(&points, &rows, &ends, &progress, crust).expect("it is quick");
        let mut expected = Edges::new();
        for group in groups {
            let alone: Vec<Point> = group.iter().map(|&row| points[row as usize]).collect();
            let delaunay = Delaunay::new(&alone, &progress).expect("finite points");
            let edges = crust(&delaunay, &progress).expect("no one cancels");
            expected.extend(edges.iter().map(|edge| edge.map(|row| group[row as usize])));
        }
        expected.sort_unstable();
        assert_eq!(edges, expected);
    }

    #[test]
    fn an_error_names_the_row_among_all_points() {
        let points = [[0.0, 0.0], [1e300, 1.0], [0.0, 5.0], [1e-300, 1.0]];
        let result = select_by_group(&points, &[0, 2, 1, 3], &[2, 4], &Progress::default(), crust);
        assert!(matches!(result, Err(Error::Range { row: 3, .. })), "{result:?}");
    }
}
