//! The triangulation as an object that keeps its work.

use crate::arrays::{edges, flat, points, run};
use crate::certificate::Certificate;
use crate::connection::Connection;
use crate::curves::Curves;
use crate::medial_axis::MedialAxis;
use crate::methods::select;
use crustline_core::edges::{self as pairs, Edges};
use crustline_core::interpolant::Interpolant;
use crustline_core::{self as core, Adjacency, Point, methods};
use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// A Delaunay triangulation, made once and read by many. `free` gives its memory back.
#[wasm_bindgen]
pub struct Delaunay {
    points: Vec<Point>,
    inner: core::Delaunay,
    smooth: RefCell<Option<(Edges, Rc<Interpolant>)>>,
}

type Thrown<T> = Result<T, JsError>;

#[wasm_bindgen]
impl Delaunay {
    /// Triangulate points, given as x, y, x, y, …
    ///
    /// # Errors
    /// Coordinates that are not finite, or that span too many orders of magnitude.
    #[wasm_bindgen(constructor)]
    pub fn new(coordinates: &[f64]) -> Thrown<Self> {
        let points = points(coordinates)?;
        let inner = run(|progress| core::Delaunay::new(&points, progress))?;
        Ok(Self { points, inner, smooth: RefCell::default() })
    }

    /// The triangles, three rows each, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> Vec<u32> {
        flat(self.inner.row_triangles())
    }

    /// The twin of each half-edge, −1 outside.
    #[must_use]
    pub fn halfedges(&self) -> Vec<i32> {
        let twins = self.inner.twins().into_iter();
        twins.map(|twin| twin.map_or(-1, |half_edge| half_edge as i32)).collect()
    }

    /// The rows of the convex hull, counter-clockwise.
    #[must_use]
    pub fn hull(&self) -> Vec<u32> {
        self.inner.hull().iter().map(|&v| self.inner.rows()[v as usize]).collect()
    }

    /// The Voronoi vertices, one a triangle: x, y, x, y, …
    #[must_use]
    pub fn circumcenters(&self) -> Vec<f64> {
        flat(self.inner.circumcenters())
    }

    /// The distance from each Voronoi vertex to the corners of its triangle.
    #[must_use]
    pub fn circumradii(&self) -> Vec<f64> {
        self.inner.circumradii()
    }

    /// The edges: i, j, i, j, … with i < j, sorted.
    #[must_use]
    pub fn edges(&self) -> Vec<u32> {
        flat(pairs::all(&self.inner))
    }

    /// A repeated row, and the first row with the same coordinates; and so on.
    #[must_use]
    pub fn duplicates(&self) -> Vec<u32> {
        flat(self.inner.duplicates().to_vec())
    }

    /// The rows next to a row, counter-clockwise.
    #[must_use]
    pub fn star(&self, row: u32) -> Vec<u32> {
        let rows = self.inner.rows();
        let vertex = rows.iter().position(|&own| own == row);
        let star = vertex.map(|v| self.inner.star(v as u32).neighbors);
        star.unwrap_or_default().iter().map(|&v| rows[v as usize]).collect()
    }

    /// The edges of a method, by its name, such as "crust", "connect" or "beta-skeleton", with its parameters in order.
    ///
    /// # Errors
    /// No such method, or parameters that it does not take.
    pub fn select(&self, method: &str, parameters: &[f64]) -> Thrown<Vec<u32>> {
        Ok(flat(run(|progress| select(&self.inner, method, parameters, progress))?))
    }

    /// The edges of `connect`, how sure they are, and why they are not the crust's.
    ///
    /// # Errors
    /// Those of the core.
    pub fn connection(&self) -> Thrown<Connection> {
        Connection::new(&self.inner)
    }

    /// Edges joined into rings and polylines.
    ///
    /// # Errors
    /// Edges that join no two different rows.
    pub fn trace(&self, edges: &[u32]) -> Thrown<Curves> {
        let edges = self.edges_of(edges)?;
        let curves = run(|progress| core::trace::trace(&self.points, &edges, progress))?;
        let shells = run(|progress| core::nesting::shells(&self.points, &curves, progress))?;
        Ok(Curves::new(curves, shells))
    }

    /// The medial axis of the points and edges (the anti-crust).
    ///
    /// # Errors
    /// Edges that join no two different rows.
    #[wasm_bindgen(js_name = medialAxis)]
    pub fn medial_axis(&self, edges: &[u32]) -> Thrown<MedialAxis> {
        let edges = self.edges_of(edges)?;
        let axis = run(|progress| {
            let curve = Adjacency::new(&self.inner, &edges)?;
            core::medial_axis::medial_axis(&self.inner, &curve, progress)
        })?;
        Ok(axis.into())
    }

    /// The local feature size at each row: not a number at isolated points, 0 at branches.
    ///
    /// # Errors
    /// Edges that join no two different rows.
    #[wasm_bindgen(js_name = localFeatureSize)]
    pub fn local_feature_size(&self, edges: &[u32]) -> Thrown<Vec<f64>> {
        let smooth = self.interpolant(&self.edges_of(edges)?)?;
        Ok(smooth.at_rows(&self.inner))
    }

    /// The unit tangents of the smooth interpolant: x, y for each row; not numbers where there is none.
    ///
    /// # Errors
    /// Edges that join no two different rows.
    pub fn tangents(&self, edges: &[u32]) -> Thrown<Vec<f64>> {
        let smooth = self.interpolant(&self.edges_of(edges)?)?;
        let mut tangents = vec![[f64::NAN; 2]; self.points.len()];
        for (bend, &row) in smooth.bends().iter().zip(self.inner.rows()) {
            if let Some(bend) = bend {
                tangents[row as usize] = bend.tangent;
            }
        }
        Ok(flat(tangents))
    }

    /// Where a theorem applies to edges, and where and why not.
    ///
    /// `theorems` are β, the sampling ratios that the theorems of its skeleton and of the crust ask for, and the margin.
    ///
    /// # Errors
    /// Edges that join no two different rows, or other than four `theorems`.
    pub fn certify(&self, edges: &[u32], theorems: &[f64]) -> Thrown<Certificate> {
        let edges = self.edges_of(edges)?;
        let smooth = self.interpolant(&edges)?;
        Certificate::new(&self.inner, &edges, &smooth, theorems)
    }

    /// The smallest disk that proves the edge between rows i and j to be in the crust: x, y and the radius.
    #[wasm_bindgen(js_name = emptyDisk)]
    #[must_use]
    pub fn empty_disk(&self, i: u32, j: u32) -> Option<Vec<f64>> {
        methods::empty_disk(&self.inner, [i, j]).map(|([x, y], radius)| vec![x, y, radius])
    }
}

impl Delaunay {
    fn edges_of(&self, rows: &[u32]) -> Thrown<Edges> {
        edges(rows, self.points.len())
    }

    /// The interpolant of edges: the one kept, if it is of the same.
    fn interpolant(&self, edges: &Edges) -> Thrown<Rc<Interpolant>> {
        if let Some((own, smooth)) = &*self.smooth.borrow()
            && own == edges
        {
            return Ok(Rc::clone(smooth));
        }
        let smooth = Rc::new(run(|progress| {
            let curve = Arc::new(Adjacency::new(&self.inner, edges)?);
            Interpolant::new(&self.inner, curve, progress)
        })?);
        *self.smooth.borrow_mut() = Some((edges.clone(), Rc::clone(&smooth)));
        Ok(smooth)
    }
}
