//! Tiles: what is final, what is open, and curves across tiles; arrays in, arrays out.

use crate::arrays::{coordinates, integer_rows, integers, points, rows, values};
use crate::call::Call;
use crate::delaunay::Delaunay;
use crate::edges::canonical;
use crate::errors::input_error;
use crate::threads::aside;
use crustline_core::Point;
use crustline_core::tiles::{
    self, Bounds, Candidates, Chain, Decide, Joined, Question, Site, Unseen,
};
use crustline_core::trace::{Curves, trace_between};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

type Integers<'py> = Bound<'py, PyArray1<i64>>;
type Table<'py, T> = Bound<'py, PyArray2<T>>;

/// The name of a method and its parameters, as `select` takes them.
type Rule = (String, Vec<f64>);

/// The rows of distinct points along the Z-order curve, and the duplicates (d, 2): row, and the first row with the same coordinates.
#[pyfunction]
pub fn z_order<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<(Integers<'py>, Table<'py, i64>)> {
    let points = self::points(py, &points)?;
    let call = Call { size: points.len(), threads: Some(1), callback: None };
    let order = call.run(py, |progress| tiles::order(points, progress))?;
    let rows = integers(py, order.rows.into_iter().map(i64::from));
    Ok((rows, integer_rows(py, Some(1), &order.duplicates)?))
}

/// Decide edges for good: `(edges, open edges, open vertices, their reach, pieces asked for, parts of them)`.
///
/// `own` and `fresh` are flags of rows, `pairs` more edges to decide; `pieces` (k, 4), left, bottom, right, top, are where unseen points may
/// be, `known` those of which no own point needs a partner, `clear` (1, 4) a rectangle that none of them meets; `most` pieces are asked
/// for by one edge or vertex.
#[pyfunction]
#[pyo3(signature = (delaunay, rule, own, fresh, pairs, pieces, known, clear, most, threads=None, progress=None))]
#[allow(clippy::too_many_arguments, clippy::type_complexity)] // An argument a part of the question.
pub fn decide<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    rule: Rule,
    own: PyReadonlyArray1<'py, bool>,
    fresh: PyReadonlyArray1<'py, bool>,
    pairs: PyReadonlyArray2<'py, i64>,
    pieces: PyReadonlyArray2<'py, f64>,
    known: PyReadonlyArray1<'py, bool>,
    clear: PyReadonlyArray2<'py, f64>,
    most: usize,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(
    Table<'py, i64>,
    Table<'py, i64>,
    Integers<'py>,
    Bound<'py, PyArray1<f64>>,
    Integers<'py>,
    Table<'py, f64>,
)> {
    let core = delaunay.core();
    let pairs = canonical(py, threads, rows(py, &pairs)?, core.input_len())?;
    let (pieces, clear) = (rectangles(py, &pieces)?, rectangles(py, &clear)?);
    let known = known.as_slice()?;
    let (own, fresh) = (own.as_slice()?, fresh.as_slice()?);
    if [own.len(), fresh.len()] != [core.input_len(); 2] || known.len() != pieces.len() {
        return Err(input_error(py, "there must be one flag a row and a piece".to_owned()));
    }
    let call = Call { size: core.input_len(), threads, callback: progress };
    let decision = call.run(py, |progress| {
        let unseen = Unseen::new(&pieces, known, clear[0], core.scale());
        let question = Question { own, fresh, pairs: &pairs, unseen: &unseen, most };
        tiles::with_rule(&rule.0, &rule.1, Decide(core, question, progress))
    })?;
    let (asked, parts): (Vec<u32>, Vec<Bounds>) = decision.requests.into_iter().unzip();
    let corners = |b: &Bounds| [b.low[0], b.low[1], b.high[0], b.high[1]];
    Ok((
        integer_rows(py, threads, &decision.edges)?,
        integer_rows(py, threads, &decision.open_edges)?,
        integers(py, decision.open_vertices.into_iter().map(i64::from)),
        values(py, decision.reach),
        integers(py, asked.into_iter().map(i64::from)),
        table(py, parts.iter().map(corners).collect())?,
    ))
}

/// The edges of the graph on these points that holds the method's edges between them, whatever other points there are.
#[pyfunction]
#[pyo3(signature = (delaunay, rule, threads=None, progress=None))]
pub fn candidates<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    rule: Rule,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Table<'py, i64>> {
    let core = delaunay.core();
    let call = Call { size: core.input_len(), threads, callback: progress };
    let edges =
        call.run(py, |progress| tiles::with_rule(&rule.0, &rule.1, Candidates(core, progress)))?;
    integer_rows(py, threads, &edges)
}

/// The neighbors of rows in the triangulation, one after another, and where those of each start.
#[pyfunction]
pub fn stars<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    rows: PyReadonlyArray1<'py, i64>,
) -> PyResult<(Integers<'py>, Integers<'py>)> {
    let rows: Vec<u32> = rows.as_slice()?.iter().map(|&row| row as u32).collect();
    let stars = tiles::stars(delaunay.core(), &rows);
    let starts = std::iter::once(0).chain(stars.iter().map(Vec::len)).scan(0, |sum, length| {
        *sum += length as i64;
        Some(*sum)
    });
    let starts: Vec<i64> = starts.collect();
    let neighbors: Vec<i64> = stars.into_iter().flatten().map(i64::from).collect();
    Ok((integers(py, neighbors.into_iter()), integers(py, starts.into_iter())))
}

/// Trace the edges of a tile.
///
/// `cut` are flags of rows where curves may go on, `numbers` the rows in the whole. Returns the edges as such numbers, canonical; the whole curves
/// as `trace` does, in the order of the numbers; the runs between cut vertices as `(rows, offsets)`; and their chains as
/// `(sites (r, 10), places (10 r, 2), edges (r,))`.
#[pyfunction]
#[allow(clippy::type_complexity)] // Three ragged formats, in the order of their documentation.
pub fn trace_tile<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    edges: PyReadonlyArray2<'py, i64>,
    cut: PyReadonlyArray1<'py, bool>,
    numbers: PyReadonlyArray1<'py, i64>,
) -> PyResult<(
    Table<'py, i64>,
    (Integers<'py>, Integers<'py>, Bound<'py, PyArray1<bool>>, Integers<'py>),
    (Integers<'py>, Integers<'py>),
    Chains<'py>,
)> {
    let points = self::points(py, &points)?;
    let edges = canonical(py, None, rows(py, &edges)?, points.len())?;
    let (cut, numbers) = (cut.as_slice()?, numbers.as_slice()?);
    if [cut.len(), numbers.len()] != [points.len(); 2] {
        return Err(input_error(py, "there must be one flag and one number a row".to_owned()));
    }
    let call = Call { size: points.len(), threads: None, callback: None };
    let number = |row: u32| numbers[row as usize];
    let (curves, runs) = call.run(py, |progress| {
        trace_between(points, &edges, |row| cut[row as usize], number, progress)
    })?;
    let pairs = tiles::numbered(&edges, numbers);
    let site = |row: u32| Site { row: number(row), at: points[row as usize] };
    let chains = tiles::chains(&runs, site);
    let mut offsets = vec![0];
    offsets.extend(runs.iter().scan(0, |sum, run| {
        *sum += run.len() as i64;
        Some(*sum)
    }));
    let run_rows: Vec<i64> = runs.into_iter().flatten().map(i64::from).collect();
    let Curves { indices, offsets: starts, closed, isolated } = curves;
    Ok((
        table(py, pairs)?,
        (
            integers(py, indices.into_iter().map(i64::from)),
            integers(py, starts.into_iter().map(|start| start as i64)),
            values(py, closed),
            integers(py, isolated.into_iter().map(i64::from)),
        ),
        (integers(py, run_rows.into_iter()), integers(py, offsets.into_iter())),
        chain_arrays(py, &chains)?,
    ))
}

/// Chains as `(sites (r, 10), places (10 r, 2), edges (r,))`: rows and coordinates of both ends, of their neighbors, and of the two corners, row
/// −1 where there is none.
type Chains<'py> = (Table<'py, i64>, Table<'py, f64>, Integers<'py>);

/// Join chains: for the whole curves, then for those that are open, `((members, backward, offsets), closed, chains)`.
#[pyfunction]
#[allow(clippy::type_complexity)] // Two ragged formats, in the order of their documentation.
pub fn join_chains<'py>(
    py: Python<'py>,
    sites: PyReadonlyArray2<'py, i64>,
    places: PyReadonlyArray2<'py, f64>,
    edges: PyReadonlyArray1<'py, i64>,
    degrees: PyReadonlyArray2<'py, i64>,
) -> PyResult<
    [(
        (Integers<'py>, Bound<'py, PyArray1<bool>>, Integers<'py>),
        Bound<'py, PyArray1<bool>>,
        Chains<'py>,
    ); 2],
> {
    let chains = chains_of(sites.as_slice()?, rows(py, &places)?, edges.as_slice()?);
    let degrees: Vec<(i64, u32)> =
        rows(py, &degrees)?.iter().map(|&[row, degree]| (row, degree as u32)).collect();
    let (whole, open) = aside(py, None, || tiles::join(&chains, &degrees))?;
    Ok([joined_arrays(py, &whole)?, joined_arrays(py, &open)?])
}

#[allow(clippy::type_complexity)] // As above.
fn joined_arrays<'py>(
    py: Python<'py>,
    joined: &[Joined],
) -> PyResult<(
    (Integers<'py>, Bound<'py, PyArray1<bool>>, Integers<'py>),
    Bound<'py, PyArray1<bool>>,
    Chains<'py>,
)> {
    let (members, backward): (Vec<i64>, Vec<bool>) =
        joined.iter().flat_map(|each| &each.members).map(|&(k, b)| (i64::from(k), b)).unzip();
    let mut offsets = vec![0];
    offsets.extend(joined.iter().scan(0, |sum, each| {
        *sum += each.members.len() as i64;
        Some(*sum)
    }));
    let chains: Vec<Chain> = joined.iter().map(|each| each.chain).collect();
    Ok((
        (
            integers(py, members.into_iter()),
            values(py, backward),
            integers(py, offsets.into_iter()),
        ),
        values(py, joined.iter().map(|each| each.closed).collect()),
        chain_arrays(py, &chains)?,
    ))
}

fn chain_arrays<'py>(py: Python<'py>, chains: &[Chain]) -> PyResult<Chains<'py>> {
    let none = Site { row: -1, at: [0.0; 2] };
    let sites = |chain: &Chain| {
        let [[a, b], [c, d]] = [chain.ends, chain.next];
        let [[e, f, g], [h, i, j]] = [chain.least, chain.lowest].map(|c| c.unwrap_or([none; 3]));
        [a, b, c, d, e, f, g, h, i, j]
    };
    let sites: Vec<[Site; 10]> = chains.iter().map(sites).collect();
    Ok((
        table(py, sites.iter().map(|sites| sites.map(|site| site.row)).collect())?,
        coordinates(py, sites.iter().flatten().map(|site| site.at).collect())?,
        integers(py, chains.iter().map(|chain| chain.edges)),
    ))
}

fn chains_of(rows: &[i64], places: &[Point], edges: &[i64]) -> Vec<Chain> {
    let sites: Vec<Site> = rows.iter().zip(places).map(|(&row, &at)| Site { row, at }).collect();
    let corner = |s: &[Site]| (s[0].row >= 0).then(|| [s[0], s[1], s[2]]);
    let chain = |(s, &edges): (&[Site], &i64)| Chain {
        ends: [s[0], s[1]],
        next: [s[2], s[3]],
        least: corner(&s[4..7]),
        lowest: corner(&s[7..10]),
        edges,
    };
    sites.chunks_exact(10).zip(edges).map(chain).collect()
}

/// A fresh read-only array of rows.
fn table<T: numpy::Element, const N: usize>(
    py: Python<'_>,
    rows: Vec<[T; N]>,
) -> PyResult<Table<'_, T>> {
    let shape = [rows.len(), N];
    let array = PyArray1::from_vec(py, rows.into_flattened()).reshape(shape)?;
    array.readwrite().make_nonwriteable();
    Ok(array)
}

/// Rows of left, bottom, right, top.
fn rectangles(py: Python<'_>, array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Bounds>> {
    let (rows, rest) = array.as_slice()?.as_chunks::<4>();
    if !rest.is_empty() {
        return Err(input_error(py, "a rectangle must have four numbers".to_owned()));
    }
    Ok(rows.iter().map(|&[a, b, c, d]| Bounds { low: [a, b], high: [c, d] }).collect())
}
