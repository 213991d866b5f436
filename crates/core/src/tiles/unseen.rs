//! Where points may be that a tile has not seen.

use super::disk::Disk;
use crate::point::Point;
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;

/// Rectangles around all points that have not been seen.
#[derive(Debug)]
pub struct Unseen {
    pieces: Vec<Bounds>,
    /// Were the points in this piece seen when the partners of own points were last sought?
    known: Vec<bool>,
    boxes: Boxes,
    clear: Bounds,
}

impl Unseen {
    /// The `pieces`, none of which meets the rectangle `clear`, all in the unit of the input; `scale` is the triangulation's.
    ///
    /// `known` marks pieces whose points no own point needs as partners: they have been decided on before.
    #[must_use]
    pub fn new(pieces: &[Bounds], known: &[bool], clear: Bounds, scale: f64) -> Self {
        let pieces: Vec<Bounds> = pieces.iter().map(|piece| piece.scaled(scale)).collect();
        let boxes = Boxes::new(&pieces, |&piece| piece);
        Self { pieces, known: known.to_vec(), boxes, clear: clear.scaled(scale) }
    }

    /// Around `p` no unseen point is nearer than this.
    #[inline]
    pub(super) fn clearance(&self, p: Point) -> f64 {
        let Bounds { low, high } = self.clear;
        (p[0] - low[0]).min(high[0] - p[0]).min((p[1] - low[1]).min(high[1] - p[1])).max(0.0)
    }

    /// May a point in `disk` be unseen?
    #[inline]
    pub(super) fn hides(&self, disk: &Disk) -> bool {
        disk.radius >= self.clearance(disk.center)
            && self.boxes.any(&mut |b, _| disk.meets(b), &mut |k| disk.meets(self.piece(k)))
    }

    /// The pieces that meet `disk`.
    pub(super) fn in_disk(&self, disk: &Disk) -> Vec<u32> {
        self.all(|bounds| disk.meets(bounds))
    }

    /// The pieces not known that `admits` admits, as it does all boxes around them.
    pub(super) fn unknown(&self, admits: impl Fn(&Bounds) -> bool) -> Vec<u32> {
        let mut found = self.all(admits);
        found.retain(|&k| !self.known[k as usize]);
        found
    }

    fn all(&self, admits: impl Fn(&Bounds) -> bool) -> Vec<u32> {
        let mut found = Vec::new();
        self.boxes.any(&mut |bounds, _| admits(bounds), &mut |k| {
            if admits(&self.pieces[k as usize]) {
                found.push(k);
            }
            false
        });
        found
    }

    /// The rectangle of a piece.
    pub(super) fn piece(&self, k: u32) -> &Bounds {
        &self.pieces[k as usize]
    }

    /// The number of pieces.
    pub(super) fn len(&self) -> usize {
        self.pieces.len()
    }
}
