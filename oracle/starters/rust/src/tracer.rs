use crate::{Pair, Ray, Solid, Vector};

// ---- your tracer: replace from here ------------------------------------------------------------
// What you declare, and the function `intersect`. Leave out the solids you do not have.
//
// What stands here is the reference tracer of raycert. No tolerance anywhere: lengths, axis and
// direction are scaled by powers of two, which is exact, and no formula subtracts what nearly
// cancels. Rust rounds every operation as it is written; leave `mul_add` out of it.

pub const HELLO: &str = concat!(
    r#"{"hello": 1, "name": "reference tracer, in Rust", "version": "1", "#,
    r#""solids": ["half_space", "sphere", "infinite_cylinder", "slab", "cylinder", "#,
    r#""union", "intersection", "difference"], "#,
    r#""precision": "binary64", "convention": "closed", "numbers": "decimal"}"#,
);

type Pairs = Vec<Pair>;

/// The intervals of t >= 0 for which the ray is in the solid.
pub fn intersect(solid: &Solid, ray: &Ray) -> Pairs {
    let each = |of: &[Solid]| {
        of.iter()
            .map(|part| intersect(part, ray))
            .collect::<Vec<_>>()
    };
    match solid {
        Solid::HalfSpace { point, normal } => half_space(*point, *normal, ray),
        Solid::Sphere { center, radius } => sphere(*center, *radius, ray),
        Solid::InfiniteCylinder { p, q, radius } => axial(*p, *q, Some(*radius), false, ray),
        Solid::Slab { p, q } => axial(*p, *q, None, true, ray),
        Solid::Cylinder { p, q, radius } => axial(*p, *q, Some(*radius), true, ray),
        Solid::Union(of) => union(each(of)),
        Solid::Intersection(of) => each(of).iter().fold(everything(), |a, b| both(&a, b)),
        Solid::Difference(of) => difference(intersect(&of[0], ray), union(each(&of[1..]))),
    }
}

fn half_space(point: Vector, normal: Vector, ray: &Ray) -> Pairs {
    let (n, _) = scaled(normal);
    let (v, ve) = scaled(ray.direction);
    let (y, ye) = displacement(point, ray.origin);
    let (up, vn) = (dot(y, n), dot(v, n));
    if vn == 0.0 || (vn > 0.0) == (up > 0.0) {
        return if up <= 0.0 { everything() } else { vec![] }; // it never comes to the plane
    }
    let t = times(-up / vn, ye - ve);
    if vn > 0.0 {
        pair(0.0, t)
    } else {
        pair(t, f64::INFINITY)
    }
}

fn sphere(center: Vector, radius: f64, ray: &Ray) -> Pairs {
    let (v, ve) = scaled(ray.direction);
    let (y, ye) = displacement(center, ray.origin);
    let e = ye.max(exponent(radius));
    unscale(chord(shift(y, ye - e), v, ldexp(radius, -e)), e - ve)
}

/// The three solids with an axis: within the wall, if there is a radius, and between the caps.
///
/// Lengths from p and q are scaled by one power of two, v by another, w = q - p by a third: no
/// product overflows, and t only has to be scaled back.
fn axial(p: Vector, q: Vector, radius: Option<f64>, caps: bool, ray: &Ray) -> Pairs {
    let (v, ve) = scaled(ray.direction);
    let (y, ye) = displacement(p, ray.origin);
    let (z, ze) = displacement(q, ray.origin);
    let (w, _) = displacement(p, q);
    let e = ye.max(ze).max(exponent(radius.unwrap_or(0.0)));
    let (y, z) = (shift(y, ye - e), shift(z, ze - e));
    let mut pairs = if caps { slab(y, z, v, w) } else { everything() };
    if let Some(radius) = radius {
        // Crossed with w, which is not normalised: r is multiplied by |w| instead. So a direction
        // parallel to the axis gives exactly zero, whichever way the axis points.
        let r = ldexp(radius, -e) * norm(w);
        pairs = both(&chord(cross(y, w), cross(v, w), r), &pairs);
    }
    unscale(pairs, e - ve)
}

/// Between the planes through p and q square to pq: y and z are the start, seen from p and q.
fn slab(y: Vector, z: Vector, v: Vector, w: Vector) -> Pairs {
    let (up, uq, vn) = (-dot(y, w), -dot(z, w), -dot(v, w));
    if vn == 0.0 {
        return if up <= 0.0 && 0.0 <= uq {
            everything()
        } else {
            vec![]
        };
    }
    let (tp, tq) = (-up / vn, -uq / vn);
    if uq < 0.0 {
        return if vn > 0.0 { pair(tq, tp) } else { vec![] }; // it starts beyond q
    }
    if up > 0.0 {
        return if vn < 0.0 { pair(tp, tq) } else { vec![] }; // it starts before p
    }
    pair(0.0, if vn > 0.0 { tp } else { tq })
}

/// Where |y + t v| <= r: across an axis, or about a center.
fn chord(y: Vector, v: Vector, r: f64) -> Pairs {
    let (a, b) = (dot(v, v), dot(v, y));
    if a == 0.0 {
        return if norm(y) <= r { everything() } else { vec![] };
    }
    let (reach, offset) = (r * norm(v), norm(cross(v, y)));
    if reach < offset {
        return vec![];
    }
    // The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a tangency.
    // Likewise |y|^2 - r^2 near the wall; a start with norm(y) = r gives t = 0 itself.
    let half = ((reach - offset) * (reach + offset)).sqrt();
    let c = (norm(y) - r) * (norm(y) + r);

    // The roots (-b - half) / a and (-b + half) / a. The one whose numerator cancels is c / k, k
    // the numerator of the other. Only where 2 half > |b| does it cancel much; elsewhere c / k is
    // the worse one. Near a tangent start that can even pass the other root: it is stopped there.
    let (mut t1, mut t2) = ((-b - half) / a, (-b + half) / a);
    if 2.0 * half > b.abs() {
        if b > 0.0 {
            t2 = t1.max(c / (-b - half));
        } else {
            t1 = t2.min(c / (-b + half));
        }
    }
    pair(if t1 < 0.0 { 0.0 } else { t1 }, t2)
}

// ---- lists of closed intervals: only compared, so nothing is rounded here

fn everything() -> Pairs {
    vec![(0.0, f64::INFINITY)]
}

/// An interval that would end before it begins is none.
fn pair(enter: f64, leave: f64) -> Pairs {
    if enter <= leave {
        vec![(enter, leave)]
    } else {
        vec![]
    }
}

/// The t in any of the lists. Intervals that touch merge.
fn union(lists: Vec<Pairs>) -> Pairs {
    let mut all: Pairs = lists.into_iter().flatten().collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut merged: Pairs = vec![];
    for (enter, leave) in all {
        match merged.last_mut() {
            Some(last) if enter <= last.1 => last.1 = last.1.max(leave),
            _ => merged.push((enter, leave)),
        }
    }
    merged
}

fn both(one: &Pairs, other: &Pairs) -> Pairs {
    let meet = |&(a, b): &Pair| {
        other
            .iter()
            .flat_map(move |&(c, d)| pair(a.max(c), b.min(d)))
    };
    one.iter().flat_map(meet).collect()
}

/// The closure of the first without the holes: cutting out a single point leaves it in.
fn difference(mut left: Pairs, holes: Pairs) -> Pairs {
    for (c, d) in holes {
        let before = left
            .iter()
            .filter(|(a, _)| *a < c)
            .map(|&(a, b)| (a, b.min(c)));
        let after = left
            .iter()
            .filter(|(_, b)| d < *b)
            .map(|&(a, b)| (a.max(d), b));
        left = before.chain(after).collect();
    }
    union(vec![left])
}

fn unscale(pairs: Pairs, e: i32) -> Pairs {
    pairs
        .into_iter()
        .map(|(enter, leave)| (times(enter, e), times(leave, e)))
        .collect()
}

// ---- vectors, and their exact scaling by powers of two

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Exactly zero for parallel vectors of any length, as equal products round alike.
fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// |a|, exact along a coordinate axis. Not `hypot`: Rust has it for two numbers only, and the
/// squares of a scaled vector neither overflow nor lose anything. In the last bit it may differ
/// from the hypot of the reference.
fn norm(a: Vector) -> f64 {
    let (m, e) = scaled(a);
    ldexp(dot(m, m).sqrt(), e)
}

/// (m, e) with a = m 2^e and the largest component of m in [1/2, 1).
fn scaled(a: Vector) -> (Vector, i32) {
    let e = a.into_iter().map(exponent).fold(NOTHING, i32::max);
    (shift(a, -e), e)
}

/// end - start, scaled. One that overflows is taken again between the halves.
fn displacement(start: Vector, end: Vector) -> (Vector, i32) {
    let d = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
    if d.into_iter().any(f64::is_infinite) {
        let (half, e) = displacement(shift(start, -1), shift(end, -1));
        return (half, e + 1);
    }
    scaled(d)
}

fn shift(a: Vector, e: i32) -> Vector {
    a.map(|x| ldexp(x, e))
}

/// t 2^e for t >= 0, and never -0.
fn times(t: f64, e: i32) -> f64 {
    ldexp(t, e) + 0.0
}

/// The exponent of zero: below that of every double.
const NOTHING: i32 = -1200;

/// The e for which |x| is in [1/2, 1) 2^e: frexp, which the standard library does not have.
fn exponent(x: f64) -> i32 {
    let biased = (x.to_bits() >> 52 & 0x7ff) as i32;
    match biased {
        0 if x == 0.0 => NOTHING,
        0 => exponent(x * power(54)) - 54, // subnormal
        _ => biased - 1022,
    }
}

/// x 2^e, rounded once: ldexp, which the standard library does not have.
///
/// Down, the steps stop 53 places above the subnormals, so that only the last one can round.
fn ldexp(mut x: f64, mut e: i32) -> f64 {
    while e > 1023 && x != 0.0 && x.is_finite() {
        x *= power(1023);
        e -= 1023;
    }
    while e < -1022 && x != 0.0 {
        x *= power(-969);
        e += 969;
    }
    x * power(e.clamp(-1022, 1023))
}

/// 2^e, for a normal double.
fn power(e: i32) -> f64 {
    f64::from_bits(((1023 + e) as u64) << 52)
}

// ---- to here -----------------------------------------------------------------------------------
