//! Exact decisions: the sign of a polynomial in the coordinates, and what is built on it.

pub mod angle;
pub mod angle_bound;
pub mod angle_pair;
#[cfg(test)]
pub(crate) mod brink_tests;
pub mod circumcenter;
pub mod constant;
pub mod double_double;
pub mod filter;
pub mod integer;
pub mod number;
pub mod pencil;
pub mod predicates;
pub mod sign;
