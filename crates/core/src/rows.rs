//! What the vertices of a triangulation have, put in the order of the rows.
//!
//! Vertices are near each other in memory where they are in the plane, so all is made in their order; rows need not be, so it is moved once.
//! The places of many are looked up before any is read, so that the processor waits for many of them at a time.

use crate::adjacency::vertices_of_rows;
use crate::delaunay::{Delaunay, NONE};
use crate::error::Result;
use crate::parts::{in_parts, try_each};
use crate::progress::Progress;

/// Vertices, or rows, that one task takes at a time.
const GRAIN: usize = 1 << 13;

/// Some items of each vertex.
#[derive(Debug)]
pub struct OfVertices<T> {
    parts: Vec<Part<T>>,
}

/// Those of `GRAIN` successive vertices.
#[derive(Debug)]
struct Part<T> {
    items: Vec<T>,
    /// Where those of each vertex start, and where the last end.
    starts: Vec<u32>,
}

/// Where the items of a row are: the part, and the first and the last but one in it.
type Place = [u32; 3];

impl<T: Copy + Send + Sync> OfVertices<T> {
    /// Of `count` vertices: `append` puts those of a vertex, about `each`, behind what is there.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn new(
        count: usize,
        each: usize,
        progress: &Progress,
        append: impl Fn(u32, &mut Vec<T>) + Sync,
    ) -> Result<Self> {
        let parts = in_parts(count, GRAIN, progress, |vertices| {
            let mut items = Vec::with_capacity(each * vertices.len());
            let mut starts = Vec::with_capacity(vertices.len() + 1);
            starts.push(0);
            for v in vertices {
                append(v as u32, &mut items);
                starts.push(items.len() as u32);
            }
            Part { items, starts }
        })?;
        Ok(Self { parts })
    }

    /// Hand out the items of all rows in their order, those of some successive rows at a time.
    ///
    /// `targets` makes of the numbers of items what each call of `write` is given. A row that repeats another has none.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn by_rows<S: Send>(
        &self,
        delaunay: &Delaunay,
        progress: &Progress,
        targets: impl FnOnce(&[usize]) -> Vec<S>,
        write: impl Fn(S, &[T]) + Sync + Send,
    ) -> Result<()> {
        let places = self.places(delaunay, progress)?;
        let count = |places: &Vec<Place>| {
            places.iter().map(|[_, start, end]| (end - start) as usize).sum::<usize>()
        };
        let counts: Vec<usize> = places.iter().map(count).collect();
        let runs: Vec<_> = places.iter().zip(targets(&counts)).collect();
        try_each(runs, |k, (places, target)| {
            let mut items = Vec::with_capacity(counts[k]);
            for &[part, start, end] in places {
                // One by one: there are too few for a call that copies.
                for &item in &self.parts[part as usize].items[start as usize..end as usize] {
                    items.push(item);
                }
            }
            write(target, &items);
            progress.advance(places.len())
        })
    }

    fn places(&self, delaunay: &Delaunay, progress: &Progress) -> Result<Vec<Vec<Place>>> {
        let mut vertex = vertices_of_rows(delaunay);
        for &[row, _] in delaunay.duplicates() {
            vertex[row as usize] = NONE;
        }
        let place = |&v: &u32| {
            if v == NONE {
                return [0; 3];
            }
            let (part, k) = (v as usize / GRAIN, v as usize % GRAIN);
            let starts = &self.parts[part].starts;
            [part as u32, starts[k], starts[k + 1]]
        };
        in_parts(vertex.len(), GRAIN, progress, |rows| vertex[rows].iter().map(place).collect())
    }
}
