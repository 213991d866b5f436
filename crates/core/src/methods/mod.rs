//! The graphs on points: each takes a triangulation and gives edges, exactly by its definition.

mod a_shape;
mod alpha_shape;
mod beta_skeleton;
mod crossing_angle;
mod crust;
mod gabriel;
mod gamma_graph;
mod minimum_spanning_tree;
mod nn_crust;
mod one_step_crust;
mod rcgh;
mod relative_neighborhood;

pub use a_shape::a_shape;
pub use alpha_shape::alpha_shape;
pub use beta_skeleton::{Kind, beta_skeleton, is_beta_skeleton};
pub use crossing_angle::crossing_angle_graph;
pub use crust::crust;
pub use gabriel::gabriel;
pub use gamma_graph::gamma_graph;
pub use minimum_spanning_tree::minimum_spanning_tree;
pub use nn_crust::nn_crust;
pub use one_step_crust::one_step_crust;
pub use rcgh::rcgh;
pub use relative_neighborhood::relative_neighborhood;
