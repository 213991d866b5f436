//! The graphs on points: each takes a triangulation and gives edges, exactly by its definition.

use crate::{Delaunay, Error, Progress, Result, edges::Edges};

mod a_shape;
mod alpha_shape;
mod beta_skeleton;
mod compatible_crust;
mod conservative_crust;
mod crawl;
mod crossing_angle;
mod crust;
mod empty_disk;
mod gabriel;
mod gamma_graph;
mod gathan;
mod hnn_crust;
mod length;
mod minimum_spanning_tree;
mod neighborhood;
mod nn_crust;
mod one_step_crust;
mod peel;
mod rcgh;
mod relative_neighborhood;
mod search;
mod sig_delaunay;
mod visit;

pub(crate) use crossing_angle::Crossing;
pub(crate) use gamma_graph::has_angles;
pub(crate) use one_step_crust::is_in as is_in_one_step_crust;
pub(crate) use search::{Verdict, find_disk, find_late};
pub(crate) use visit::Visit;

pub use a_shape::a_shape;
pub use alpha_shape::alpha_shape;
pub use beta_skeleton::{Kind, beta_skeleton, is_beta_skeleton};
pub use compatible_crust::compatible_crust;
pub use conservative_crust::conservative_crust;
pub use crawl::crawl;
pub use crossing_angle::crossing_angle_graph;
pub use crust::crust;
pub use empty_disk::empty_disk;
pub use gabriel::gabriel;
pub use gamma_graph::gamma_graph;
pub use gathan::gathan;
pub use hnn_crust::hnn_crust;
pub use minimum_spanning_tree::minimum_spanning_tree;
pub use nn_crust::nn_crust;
pub use one_step_crust::one_step_crust;
pub use peel::peel;
pub use rcgh::rcgh;
pub use relative_neighborhood::relative_neighborhood;
pub use sig_delaunay::sig_delaunay;

/// The edges of the method called `name`, with its parameters in order: what bindings call.
///
/// # Errors
/// That there is no such method, or those of the method.
pub fn select(
    delaunay: &Delaunay,
    name: &str,
    parameters: &[f64],
    progress: &Progress,
) -> Result<Edges> {
    let kind = |lune| if lune == 0.0 { Kind::Circle } else { Kind::Lune };
    match (name, parameters) {
        ("a-shape", &[own]) => a_shape(delaunay, own as usize, progress),
        ("alpha-shape", &[radius]) => alpha_shape(delaunay, radius, progress),
        ("beta-skeleton", &[beta, lune]) => beta_skeleton(delaunay, beta, kind(lune), progress),
        ("compatible-crust", &[cotangent]) => compatible_crust(delaunay, cotangent, progress),
        ("conservative-crust", &[ratio]) => conservative_crust(delaunay, ratio, progress),
        ("crawl", []) => crawl(delaunay, progress),
        ("crossing-angle-graph", &[cotangent]) => {
            crossing_angle_graph(delaunay, cotangent, progress)
        }
        ("crust", []) => crust(delaunay, progress),
        ("gabriel", []) => gabriel(delaunay, progress),
        ("gamma-graph", &[c0, c1]) => gamma_graph(delaunay, [c0, c1], progress),
        ("gathan", &[sine, ratio]) => gathan(delaunay, sine, ratio, progress),
        ("hnn-crust", []) => hnn_crust(delaunay, progress),
        ("minimum-spanning-tree", []) => minimum_spanning_tree(delaunay, progress),
        ("nn-crust", []) => nn_crust(delaunay, progress),
        ("one-step-crust", []) => one_step_crust(delaunay, progress),
        ("peel", []) => peel(delaunay, progress),
        ("rcgh", []) => rcgh(delaunay, progress),
        ("relative-neighborhood", []) => relative_neighborhood(delaunay, progress),
        ("sig-delaunay", []) => sig_delaunay(delaunay, progress),
        _ => Err(Error::Argument {
            message: format!("no method {name} has {} parameters", parameters.len()),
        }),
    }
}
