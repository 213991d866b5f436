//! Triangulations from crates.io as contenders: `rivals spade|delaunator FILE`, with raw pairs of `f64` in the file.
//!
//! Requests come as lines on standard input, answers go as JSON to standard output:
//!
//! - `run K`: do the work K times; mean seconds of wall and processor, without reading or freeing;
//! - `edges PATH`: do it once more, and write the edges as pairs of `i32` rows.

mod delaunator;
mod rival;
mod spade;

use std::{env, error::Error, fs, io, time::Instant};

use cpu_time::ProcessTime;

use crate::rival::{Edges, Rival};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [name, path] = arguments.as_slice() else {
        return Err("usage: rivals spade|delaunator FILE".into());
    };
    match name.as_str() {
        "delaunator" => serve::<delaunator::Delaunator>(path),
        "spade" => serve::<spade::Spade>(path),
        _ => Err(format!("no rival is called {name:?}").into()),
    }
}

fn serve<R: Rival>(path: &str) -> Result<(), Box<dyn Error>> {
    let points: Vec<R::Point> = read(path)?.map(|[x, y]| R::point(x, y)).collect();
    println!("{{\"points\": {}}}", points.len());
    for line in io::stdin().lines() {
        match line?.split_once(' ') {
            Some(("run", repeats)) => run::<R>(&points, repeats.parse()?)?,
            Some(("edges", path)) => write(&R::edges(&points)?, path)?,
            _ => return Err("a request is `run K` or `edges PATH`".into()),
        }
    }
    Ok(())
}

fn read(path: &str) -> io::Result<impl Iterator<Item = [f64; 2]>> {
    let bytes = fs::read(path)?;
    let pairs: Vec<[f64; 2]> = bytes
        .chunks_exact(16)
        .map(|pair| [0, 8].map(|at| f64::from_le_bytes(pair[at..at + 8].try_into().unwrap())))
        .collect();
    Ok(pairs.into_iter())
}

fn run<R: Rival>(points: &[R::Point], repeats: u32) -> Result<(), Box<dyn Error>> {
    let (mut wall, mut processor) = (0.0, 0.0);
    for _ in 0..repeats {
        let (wall_start, processor_start) = (Instant::now(), ProcessTime::now());
        let answer = R::triangulate(points)?;
        wall += wall_start.elapsed().as_secs_f64();
        processor += processor_start.elapsed().as_secs_f64();
        drop(answer);
    }
    let repeats = f64::from(repeats);
    println!("{{\"wall\": {:e}, \"cpu\": {:e}}}", wall / repeats, processor / repeats);
    Ok(())
}

fn write(edges: &Edges, path: &str) -> io::Result<()> {
    let bytes: Vec<u8> = edges.iter().flatten().flat_map(|row| row.to_le_bytes()).collect();
    fs::write(path, bytes)?;
    println!("{{\"edges\": {}}}", edges.len());
    Ok(())
}
