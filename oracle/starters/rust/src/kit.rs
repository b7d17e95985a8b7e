//! What most adapters need between raycert and a library: take what yours asks for.
//!
//!     Frame, local, turned   its coordinates: p at the origin, the axis along z
//!     shifted                the origin in the middle of the axis, for half heights
//!     unit, rescaled         its direction and |v|, and t = s / |v| of distances s along it
//!     far_end                its segment, past the solid: a fraction f of it is s = f length
//!     paired                 its crossings, with its test of a point, as intervals
//!     clipped                its intervals of a whole line, from 0 on
//!
//! Nothing here has a tolerance, and what it rounds is as little as a few roundings of the input.
#![allow(dead_code)] // nobody needs all of it

use crate::{Pair, Vector};

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn along(start: Vector, d: Vector, s: f64) -> Vector {
    [
        start[0] + s * d[0],
        start[1] + s * d[1],
        start[2] + s * d[2],
    ]
}

fn length(v: Vector) -> f64 {
    v[0].hypot(v[1]).hypot(v[2])
}

/// v / |v|, and |v|; for the zero direction, which has no unit, itself and 0.
pub fn unit(v: Vector) -> (Vector, f64) {
    match length(v) {
        0.0 => (v, 0.0),
        l => (v.map(|x| x / l), l),
    }
}

/// Coordinates in which p is the origin and q is (0, 0, height).
pub struct Frame {
    p: Vector,
    x: Vector,
    y: Vector,
    z: Vector,
    pub height: f64,
}

impl Frame {
    /// The frame of an axis: of one along a coordinate axis it is exact.
    pub fn new(p: Vector, q: Vector) -> Frame {
        let (z, height) = unit(minus(q, p));
        let [a, b, c] = z;
        let s = if c < 0.0 { -1.0 } else { 1.0 };
        let k = -1.0 / (s + c);
        let x = [1.0 + s * a * a * k, s * a * b * k, -s * a];
        let y = [a * b * k, s + b * b * k, -b];
        Frame { p, x, y, z, height }
    }

    /// A direction in these coordinates.
    pub fn turned(&self, v: Vector) -> Vector {
        [dot(self.x, v), dot(self.y, v), dot(self.z, v)]
    }

    /// A point in these coordinates: from p first, then turned.
    pub fn local(&self, point: Vector) -> Vector {
        self.turned(minus(point, self.p))
    }

    /// A local point seen from the middle of the axis; the half height is height / 2.
    pub fn shifted(&self, point: Vector) -> Vector {
        [point[0], point[1], point[2] - self.height / 2.0]
    }
}

/// The end of a segment from start along the unit d, and its length. It ends beyond a solid within
/// `size` of the origin; the length is a power of two: no fraction of it rounds.
pub fn far_end(start: Vector, d: Vector, size: f64) -> (Vector, f64) {
    let reach = length(start) + size;
    let far = 4.0 * f64::from_bits(reach.to_bits() >> 52 << 52); // reach, less its digits
    (along(start, d, far), far)
}

/// The intervals within [0, far] that crossings bound, in any order, doubled or not.
///
/// Crossings that bound nothing do no harm: those of all the planes and walls of a solid will do.
/// Whether the ray is inside between two is asked of two points there, as one may be where it
/// grazes; before the first and after the last of the start and the far end too. What is inside up
/// to `far` is endless; a crossing that is inside, with nothing inside on either side, is a touch.
/// `inside` has to take what is within a rounding of the boundary for inside, or a chord that
/// grazes falls apart.
pub fn paired(crossings: &[f64], far: f64, inside: impl Fn(f64) -> bool) -> Vec<Pair> {
    let mut knots = vec![0.0, far];
    knots.extend(crossings.iter().filter(|&&s| 0.0 <= s && s < far));
    knots.sort_by(f64::total_cmp);
    let mut crossed = knots.len() > 2 && knots[1] == 0.0; // whether a knot is a crossing
    knots.dedup();
    let (mut found, mut before) = (Vec::<Pair>::new(), false);
    for (&a, &b) in knots.iter().zip(&knots[1..]) {
        let now = inside(a + 0.375 * (b - a))
            && inside(a + 0.625 * (b - a))
            && (a > 0.0 || inside(a))
            && (b < far || inside(b));
        let leave = if b < far { b } else { f64::INFINITY };
        match found.last_mut() {
            Some(last) if now && before => last.1 = leave,
            _ if now => found.push((a, leave)),
            _ if !before && crossed && inside(a) => found.push((a, a)),
            _ => (),
        }
        before = now;
        crossed = true;
    }
    found
}

/// The part with t >= 0 of intervals of a whole line.
pub fn clipped(pairs: &[Pair]) -> Vec<Pair> {
    let ahead = pairs.iter().filter(|(_, leave)| *leave >= 0.0);
    ahead
        .map(|&(enter, leave)| (enter.max(0.0), leave))
        .collect()
}

/// Distances along a unit direction, as the t of a direction of this length.
pub fn rescaled(pairs: &[Pair], length: f64) -> Vec<Pair> {
    pairs
        .iter()
        .map(|&(a, b)| (a / length, b / length))
        .collect()
}
