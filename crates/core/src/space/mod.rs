//! Where things are: rectangles, boxes over points, a tree of segments, and orders in which near things follow each other.

pub mod bounds;
pub mod boxes;
pub mod halves;
pub mod order;
pub mod oriented;
pub mod region;
pub mod segment;
pub mod strips;
pub mod tree;
