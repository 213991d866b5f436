//! Where things are: rectangles, boxes over points, a tree of segments, and the order of points along a curve.

pub mod bounds;
pub mod boxes;
pub mod order;
pub mod segment;
pub mod tree;
