//! Python bindings of `crustline-core`: arrays in, arrays out, the interpreter lock released in between.

mod arrays;
mod call;
mod connect;
mod curve;
mod delaunay;
mod edges;
mod errors;
mod groups;
mod interpolant;
mod medial_axis;
mod methods;
mod nesting;
mod ridge;
mod threads;
mod tiles;
mod trace;
mod tree;

use pyo3::prelude::*;

/// The Python module `crustline._core`.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::arrays::first_not_finite;
    #[pymodule_export]
    use crate::connect::{connect, connection};
    #[pymodule_export]
    use crate::curve::Curve;
    #[pymodule_export]
    use crate::delaunay::Delaunay;
    #[pymodule_export]
    use crate::edges::is_canonical;
    #[pymodule_export]
    use crate::groups::select_by_group;
    #[pymodule_export]
    use crate::interpolant::Interpolant;
    #[pymodule_export]
    use crate::medial_axis::medial_axis;
    #[pymodule_export]
    use crate::methods::{select, select_among};
    #[pymodule_export]
    use crate::nesting::shells;
    #[pymodule_export]
    use crate::ridge::ridge;
    #[pymodule_export]
    use crate::tiles::{candidates, decide, join_chains, stars, trace_tile, z_order};
    #[pymodule_export]
    use crate::trace::trace;
    #[pymodule_export]
    use crate::tree::Tree;
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
