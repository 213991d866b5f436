//! Every constant of the method, with its reason. A free end costs 1: that is the unit.
//!
//! They were fitted on one half of the generated cases of `benchmarks/accuracy`, never on the other.

/// The constants that were fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// What a curve pays at a point where it turns back: nearly an end, so that a corner is better than a gap.
    pub turn: f64,
    /// What a change of step by a factor of e costs at a point.
    pub step: f64,
    /// What an isolated point costs: above an end, so that lone points do not pair up.
    pub alone: f64,
    /// By how much that falls when the point is e times as far from others as its surroundings are: a likely outlier.
    pub alone_slope: f64,
    /// It never falls below this part of itself: leaving a point out is never free.
    pub alone_least: f64,
    /// Nor rises above this multiple.
    pub alone_most: f64,
    /// How much of it is taken off where all points that lie as far from others as this one were isolated.
    pub alone_share: f64,
    /// Points count as lying as far out as another from this part of its relative distance.
    pub alone_alike: f64,
    /// What an edge pays for each 180° of its two opposite angles together.
    pub sight: f64,
    /// As many half turns of them are free; on a straight and even curve they are near 0.
    pub sight_free: f64,
    /// What an edge e times as long as the nearest neighbors of its ends pays.
    pub near: f64,
    /// What an edge e times as long as the spacing around it pays beside.
    pub long: f64,
    /// Neighbors nearer than this part of the spacing around do not set the scale.
    pub close: f64,
    /// Neighbors farther than this multiple of the second nearest do not tell the spacing: they are across, not along.
    pub reach: f64,
    /// What a gap e times as long as gaps begin pays: steep, for a gap is one or is none.
    pub gap: f64,
    /// The logarithm of the ratio to the usual steps at which gaps begin.
    pub gap_free: f64,
    /// The usual steps end where the next longer one is this many times as long: above 2, which one lost sample makes.
    pub gap_jump: f64,
    /// Where the curve found first turns by this part of a half turn at most points, turning weighs half: about 25°.
    pub rough_turn: f64,
    /// Nowhere is it taken to turn by more than this multiple of what it turns at most points of all …
    pub rough_excess: f64,
    /// … and this part of a half turn.
    pub rough_least: f64,
    /// Where steps change by this logarithm at most points, lengths weigh half: nearly twofold.
    pub rough_step: f64,
    /// Components are outliers in a row if their median step, as a part of the median distance of isolated points, …
    pub stray: f64,
    /// … is at least `stray` (less for few points) over this and what steps and directions change from one to the next.
    pub stray_base: f64,
}

/// The constants in use.
pub const CONSTANTS: Constants = Constants {
    turn: 0.9,
    step: 0.12,
    alone: 1.2,
    alone_slope: 0.16,
    alone_least: 0.1,
    alone_most: 3.0,
    alone_share: 0.5,
    alone_alike: 0.8,
    sight: 0.75,
    sight_free: 0.1,
    near: 0.3,
    long: 0.18,
    close: 0.21,
    reach: 4.0,
    gap: 8.0,
    gap_free: 0.85,
    gap_jump: 2.5,
    rough_turn: 0.14,
    rough_excess: 2.0,
    rough_least: 0.02,
    rough_step: 0.64,
    stray: 0.6,
    stray_base: 0.3,
};

/// Edges that cost more than this are no candidates: to leave one out costs at most two ends, which is 2.
pub const HOPELESS: f32 = 2.0;
/// The price of what is not to be: more than all that the points could say against it at one place.
pub const FORCED: f32 = 64.0;
/// What an end costs where all curves are rings: more than any one edge, so that few are left to be mended.
pub const CLOSED: f32 = 6.0;
/// How many times as much an isolated point costs there: as it cannot end nearby, nothing else keeps a curve from being left out.
pub const CLOSED_ALONE: f32 = 3.0;
/// What mending pays for a point that it leaves out.
pub const DROPPED: f32 = 3.6;
/// How many points mending looks at around one that has too few edges.
pub const MOST_MENDED: usize = 1 << 14;
/// What a third or fourth edge at a point costs: less than the end that it saves, if it goes straight on.
pub const JUNCTION: f32 = 0.3;
/// At a vertex of more edges than this pairs are made among the shortest only, so that hubs stay cheap.
pub const MOST_PAIRED: usize = 14;
/// Rings of neighbors whose medians smooth the local spacing: enough to vote down small clusters of outliers.
pub const SPACING_RINGS: usize = 4;
/// Rings whose medians smooth what the first round found.
pub const ROUGHNESS_RINGS: usize = 3;
/// Edges along the curve, on each side of a point, that tell its usual steps.
pub const GAP_WINDOW: usize = 20;
/// Of fewer steps than this nothing is told …
pub const GAP_FEWEST: usize = 4;
/// … and from as many on it is told in full.
pub const GAP_SURE: f32 = 10.0;
/// Where the longest usual step is e to this power times the lower quartile, that is trusted half.
pub const GAP_SPREAD: f32 = 1.5;
/// A step is no gap if random samples have one as long in e to this power windows like that.
pub const GAP_RARE: f64 = 7.0;
/// The most sweeps of messages in each round: a message goes as many edges far. The first is to tell how rough curves are.
pub const SWEEPS: [usize; 2] = [5, 8];
/// How much of its change a message makes: less than all, so that none swings to and fro.
pub const DAMPING: f32 = 0.6;
/// Messages that change by no more than this have converged; an end costs 1.
pub const CONVERGED: f32 = 3e-2;
/// The crust leads over a gap if it turns by no more than this at each point: 75°, in half turns.
pub const BRIDGE_TURN: f32 = 5.0 / 12.0;
/// It leads on from a free end to its own end if so many steps before each are longer than the one before.
pub const BRIDGE_STEPS: usize = 5;
/// Components of fewer points than this are dropped where points are isolated: outliers pair up.
pub const FEWEST: usize = 4;
/// How many isolated points it takes to prune at all.
pub const PRUNE_FROM: usize = 3;
/// The sampling ratio at which the crust is proven (paper, §8).
pub const PROVEN: f64 = 0.252;
/// By how much the estimate of that ratio may be too small.
pub const MARGIN: f64 = 0.15;
