//! The methods: a triangulation in, edges out.

use crate::arrays::integer_rows;
use crate::call::Call;
use crate::delaunay::Delaunay;
use crustline_core::edges::Edges;
use crustline_core::methods::{self, Kind};
use crustline_core::{Progress, Result};
use numpy::PyArray2;
use pyo3::prelude::*;

type EdgeArray<'py> = Bound<'py, PyArray2<i64>>;

fn select<'py>(
    py: Python<'py>,
    delaunay: &Delaunay,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
    method: impl FnOnce(&crustline_core::Delaunay, &Progress) -> Result<Edges> + Send,
) -> PyResult<EdgeArray<'py>> {
    let core = delaunay.core();
    let call = Call { size: core.input_len(), threads, callback: progress };
    integer_rows(py, &call.run(py, |progress| method(core, progress))?)
}

/// Bind functions of the core that take a triangulation and, some of them, parameters.
macro_rules! bind {
    ($($(#[$doc:meta])* $name:ident($($parameter:ident: $type:ty),*) => $method:expr;)*) => {$(
        $(#[$doc])*
        #[pyfunction]
        #[pyo3(signature = (delaunay, $($parameter,)* threads=None, progress=None))]
        pub fn $name<'py>(
            py: Python<'py>,
            delaunay: &Delaunay,
            $($parameter: $type,)*
            threads: Option<usize>,
            progress: Option<Py<PyAny>>,
        ) -> PyResult<EdgeArray<'py>> {
            select(py, delaunay, threads, progress, $method)
        }
    )*};
}

bind! {
    /// The crust.
    crust() => methods::crust;
    /// The β-skeleton, of lunes or of circles.
    beta_skeleton(beta: f64, lune: bool) => |delaunay, progress| {
        let kind = if lune { Kind::Lune } else { Kind::Circle };
        methods::beta_skeleton(delaunay, beta, kind, progress)
    };
    /// The Gabriel graph.
    gabriel() => methods::gabriel;
    /// The relative neighborhood graph.
    relative_neighborhood() => methods::relative_neighborhood;
    /// The one-step crust.
    one_step_crust() => methods::one_step_crust;
    /// The γ-neighborhood graph.
    gamma_graph(c0: f64, c1: f64) => |delaunay, progress| {
        methods::gamma_graph(delaunay, [c0, c1], progress)
    };
    /// The graph of two empty disks that cross at the angle of `cotangent`.
    crossing_angle_graph(cotangent: f64) => |delaunay, progress| {
        methods::crossing_angle_graph(delaunay, cotangent, progress)
    };
    /// The α-shape.
    alpha_shape(radius: f64) => |delaunay, progress| {
        methods::alpha_shape(delaunay, radius, progress)
    };
    /// The 𝒜-shape: edges between the first `own` rows.
    a_shape(own: usize) => |delaunay, progress| methods::a_shape(delaunay, own, progress);
    /// The rule of Robinson, Colchester, Griffin and Hawkes.
    rcgh() => methods::rcgh;
    /// The NN-crust.
    nn_crust() => methods::nn_crust;
    /// The HNN-crust.
    hnn_crust() => methods::hnn_crust;
    /// The NN-crust whose two edges at a point make at least the angle of `cotangent`.
    compatible_crust(cotangent: f64) => |delaunay, progress| {
        methods::compatible_crust(delaunay, cotangent, progress)
    };
    /// The conservative crust, of disks `ratio` times the smallest.
    conservative_crust(ratio: f64) => |delaunay, progress| {
        methods::conservative_crust(delaunay, ratio, progress)
    };
    /// Gathan: edges at most at the angle of `sine` to the tangent, in cells `ratio` times as long.
    gathan(sine: f64, ratio: f64) => |delaunay, progress| {
        methods::gathan(delaunay, sine, ratio, progress)
    };
    /// Curves that grow from short edges.
    crawl() => methods::crawl;
    /// What is left when the longest edges are peeled off.
    peel() => methods::peel;
    /// The spheres-of-influence graph within the closed Delaunay graph.
    sig_delaunay() => methods::sig_delaunay;
    /// The Euclidean minimum spanning tree.
    minimum_spanning_tree() => methods::minimum_spanning_tree;
}
