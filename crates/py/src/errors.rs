//! The one place where errors of the core become Python exceptions.

use crustline_core::Error;
use pyo3::exceptions::{PyKeyboardInterrupt, PyMemoryError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// The Python exception for `error`.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    match error {
        Error::Cancelled => PyKeyboardInterrupt::new_err(()),
        Error::Memory { .. } => PyMemoryError::new_err(error.to_string()),
        _ => input_error(py, error.to_string()),
    }
}

/// `crustline.InputError(message)`.
pub fn input_error(py: Python<'_>, message: String) -> PyErr {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    match CLASS.import(py, "crustline.errors", "InputError") {
        Ok(class) => PyErr::from_type(class.clone(), message),
        Err(error) => error,
    }
}
