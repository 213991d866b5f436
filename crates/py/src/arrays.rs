//! Between NumPy arrays and the slices of the core.

use crate::errors::{exception, input_error};
use crate::threads::aside;
use crustline_core::Point;
use crustline_core::memory::check;
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

/// Rows that one task writes at a time.
const GRAIN: usize = 1 << 15;
/// Rows that are looked at without a branch.
const RUN: usize = 64;

/// The rows of an (n, 2) array, without a copy.
///
/// `as_points` has made it C-contiguous and finite; the shape is checked here because the slice depends on it.
pub fn rows<'a, T: Element>(
    py: Python<'_>,
    array: &'a PyReadonlyArray2<'_, T>,
) -> PyResult<&'a [[T; 2]]> {
    let slice = array.as_slice()?;
    match slice.as_chunks() {
        (rows, []) if array.as_array().ncols() == 2 => Ok(rows),
        _ => Err(input_error(py, "the array must have two columns".to_owned())),
    }
}

/// Points as a slice of the core.
pub fn points<'a>(py: Python<'_>, array: &'a PyReadonlyArray2<'_, f64>) -> PyResult<&'a [Point]> {
    rows(py, array)
}

/// The first row with a coordinate that is not finite, if there is one.
#[pyfunction]
pub fn first_not_finite(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
) -> PyResult<Option<usize>> {
    let is_finite = |point: &Point| point[0].is_finite() & point[1].is_finite();
    let rows = self::points(py, &points)?;
    let run = |run: &[Point]| !run.iter().fold(true, |all, point| all & is_finite(point));
    Ok(rows.chunks(RUN).position(run).and_then(|k| {
        let start = RUN * k;
        rows[start..].iter().position(|point| !is_finite(point)).map(|row| start + row)
    }))
}

/// Does it hold of each row of the one and its counterpart in the other, as far as both have some?
pub fn all_pairs<A, B>(one: &[A], other: &[B], holds: impl Fn(&A, &B) -> bool) -> bool {
    let mut runs = one.chunks(RUN).zip(other.chunks(RUN));
    runs.all(|(one, other)| one.iter().zip(other).fold(true, |all, (a, b)| all & holds(a, b)))
}

/// Is there memory for so many numbers? NumPy's own failure would be a panic here.
fn room<T>(py: Python<'_>, count: usize) -> PyResult<()> {
    check(count, size_of::<T>()).map_err(|error| exception(py, &error))
}

/// A fresh read-only array of integers, `N` to a row, filled on so many threads.
pub fn integer_rows<'py, const N: usize>(
    py: Python<'py>,
    threads: Option<usize>,
    rows: &[[u32; N]],
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    integer_rows_of(py, threads, rows, |&row| row)
}

/// The same, of the `row` of each item.
pub fn integer_rows_of<'py, S: Sync, const N: usize>(
    py: Python<'py>,
    threads: Option<usize>,
    items: &[S],
    row: impl Fn(&S) -> [u32; N] + Sync + Send,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    room::<i64>(py, N * items.len())?;
    let array = PyArray2::zeros(py, [items.len(), N], false);
    let mut writable = array.readwrite();
    let (rows, _) = writable.as_slice_mut()?.as_chunks_mut::<N>();
    let write = |(rows, items): (&mut [[i64; N]], &[S])| {
        for (target, item) in rows.iter_mut().zip(items) {
            *target = row(item).map(i64::from);
        }
    };
    if items.len() <= GRAIN {
        write((rows, items));
    } else {
        let parts = rows.par_chunks_mut(GRAIN).zip(items.par_chunks(GRAIN));
        aside(py, threads, || parts.for_each(write))?;
    }
    writable.make_nonwriteable();
    Ok(array)
}

/// A fresh read-only array of integers.
pub fn integers(
    py: Python<'_>,
    values: impl ExactSizeIterator<Item = i64>,
) -> Bound<'_, PyArray1<i64>> {
    let array = PyArray1::from_iter(py, values);
    array.readwrite().make_nonwriteable();
    array
}

/// A fresh read-only array of coordinates.
pub fn coordinates(py: Python<'_>, points: Vec<Point>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let rows = points.len();
    let array = PyArray1::from_vec(py, points.into_flattened()).reshape([rows, 2])?;
    array.readwrite().make_nonwriteable();
    Ok(array)
}

/// Any values as a fresh read-only array.
pub fn values<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyArray1<T>> {
    let array = PyArray1::from_vec(py, values);
    array.readwrite().make_nonwriteable();
    array
}
