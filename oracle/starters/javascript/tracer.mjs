// ---- your tracer: replace from here ------------------------------------------------------------
// What you declare, and the function `intersect`. Leave out the solids you do not have.
//
// What stands here is the reference tracer of raycert. No tolerance anywhere: lengths, axis and
// direction are scaled by powers of two, which is exact, and no formula subtracts what nearly
// cancels.

export const hello = {
  hello: 1,
  name: "reference tracer, in JavaScript",
  version: "1",
  solids: [
    ...["half_space", "sphere", "infinite_cylinder", "slab", "cylinder"],
    ...["union", "intersection", "difference"],
  ],
  precision: "binary64",
  convention: "closed",
  numbers: "decimal",
};

// The intervals [enter, leave] of t >= 0 for which the ray is in the solid, sorted and disjoint;
// the last leave may be Infinity. Solid and ray are as in the protocol, vectors arrays of three.
export function intersect(solid, ray) {
  const each = () => solid.of.map((part) => intersect(part, ray));
  switch (solid.type) {
    case "half_space":
      return halfSpace(solid, ray);
    case "sphere":
      return sphere(solid, ray);
    case "infinite_cylinder":
      return axial(solid, ray, { wall: true, caps: false });
    case "slab":
      return axial(solid, ray, { wall: false, caps: true });
    case "cylinder":
      return axial(solid, ray, { wall: true, caps: true });
    case "union":
      return union(each());
    case "intersection":
      return each().reduce(both);
    case "difference": {
      const [first, ...others] = each();
      return difference(first, union(others));
    }
  }
  throw new Error("no such solid");
}

// Where (x - point) . normal <= 0.
function halfSpace({ point, normal }, ray) {
  const [n] = scaled(normal);
  const [v, ve] = scaled(ray.direction);
  const [y, ye] = displacement(point, ray.origin);
  const up = dot(y, n), vn = dot(v, n);
  if (vn === 0 || (vn > 0) === (up > 0)) return up <= 0 ? everything() : []; // never at the plane
  const t = times(-up / vn, ye - ve);
  return vn > 0 ? pair(0, t) : pair(t, Infinity);
}

function sphere({ center, radius }, ray) {
  const [v, ve] = scaled(ray.direction);
  const [y, ye] = displacement(center, ray.origin);
  const e = Math.max(ye, exponent(radius));
  return unscale(chord(shift(y, ye - e), v, ldexp(radius, -e)), e - ve);
}

// Where the ray is within the wall around pq, between the caps, or both.
//
// Lengths from p and q are scaled by one power of two, v by another, w = q - p by a third: no
// product overflows, and t only has to be scaled back.
function axial({ p, q, radius = 0 }, ray, { wall, caps }) {
  const [v, ve] = scaled(ray.direction);
  const [w] = displacement(p, q);
  let [y, ye] = displacement(p, ray.origin);
  let [z, ze] = displacement(q, ray.origin);
  const e = Math.max(ye, ze, exponent(radius));
  [y, z] = [shift(y, ye - e), shift(z, ze - e)];
  let pairs = caps ? slab(y, z, v, w) : everything();
  if (wall) {
    // Crossed with w, which is not normalised: r is multiplied by |w| instead. So a direction
    // parallel to the axis gives exactly zero, whichever way the axis points.
    pairs = both(chord(cross(y, w), cross(v, w), ldexp(radius, -e) * norm(w)), pairs);
  }
  return unscale(pairs, e - ve);
}

// Between the planes through p and q square to pq: y and z are the start, seen from p and q.
function slab(y, z, v, w) {
  const up = -dot(y, w), uq = -dot(z, w), vn = -dot(v, w);
  if (vn === 0) return up <= 0 && 0 <= uq ? everything() : [];
  const tp = -up / vn, tq = -uq / vn;
  if (uq < 0) return vn > 0 ? pair(tq, tp) : []; // it starts beyond q
  if (up > 0) return vn < 0 ? pair(tp, tq) : []; // it starts before p
  return pair(0, vn > 0 ? tp : tq);
}

// Where |y + t v| <= r: across an axis, or about a center.
function chord(y, v, r) {
  const a = dot(v, v), b = dot(v, y);
  if (a === 0) return norm(y) <= r ? everything() : [];
  const reach = r * norm(v), offset = norm(cross(v, y));
  if (reach < offset) return [];
  // The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a tangency.
  // Likewise |y|^2 - r^2 near the wall; a start with norm(y) = r gives t = 0 itself.
  const half = Math.sqrt((reach - offset) * (reach + offset));
  const c = (norm(y) - r) * (norm(y) + r);

  // The roots (-b - half) / a and (-b + half) / a. The one whose numerator cancels is c / k, k
  // the numerator of the other. Only where 2 half > |b| does it cancel much; elsewhere c / k is
  // the worse one. Near a tangent start that can even pass the other root: it is stopped there.
  let t1 = (-b - half) / a, t2 = (-b + half) / a;
  if (2 * half > Math.abs(b)) {
    if (b > 0) t2 = Math.max(t1, c / (-b - half));
    else t1 = Math.min(t2, c / (-b + half));
  }
  return pair(t1 < 0 ? 0 : t1, t2);
}

// ---- lists of closed intervals: only compared, so nothing is rounded here

const everything = () => [[0, Infinity]];

// An interval that would end before it begins is none.
const pair = (enter, leave) => (enter <= leave ? [[enter, leave]] : []);

// The t in any of the lists. Intervals that touch merge.
function union(lists) {
  const merged = [];
  for (const [enter, leave] of lists.flat().sort(([a], [b]) => (a > b) - (a < b))) {
    const last = merged.at(-1);
    if (last && enter <= last[1]) last[1] = Math.max(last[1], leave);
    else merged.push([enter, leave]);
  }
  return merged;
}

function both(one, other) {
  return one.flatMap(([a, b]) => other.flatMap(([c, d]) => pair(Math.max(a, c), Math.min(b, d))));
}

// The closure of the intervals less the holes: cutting out a single point leaves it in.
function difference(left, holes) {
  for (const [c, d] of holes) {
    left = left.flatMap(([a, b]) => [
      ...(a < c ? [[a, Math.min(b, c)]] : []),
      ...(d < b ? [[Math.max(a, d), b]] : []),
    ]);
  }
  return union([left]);
}

const unscale = (pairs, e) => pairs.map((pair) => pair.map((t) => times(t, e)));

// ---- vectors, and their exact scaling by powers of two

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// Exactly zero for parallel vectors of any length, as equal products round alike.
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

// |a|, exact along a coordinate axis. Not Math.hypot, which divides by the largest component: the
// squares of a scaled vector neither overflow nor lose anything. In the last bit it may differ
// from the hypot of the reference.
function norm(a) {
  const [m, e] = scaled(a);
  return ldexp(Math.sqrt(dot(m, m)), e);
}

const shift = (a, e) => a.map((x) => ldexp(x, e));

// [m, e] with a = m 2^e and the largest component of m in [1/2, 1).
function scaled(a) {
  const e = Math.max(...a.map(exponent));
  return [shift(a, -e), e];
}

// end - start, scaled. One that overflows is taken again between the halves.
function displacement(start, end) {
  const d = end.map((x, i) => x - start[i]);
  if (d.every(Number.isFinite)) return scaled(d);
  const [half, e] = displacement(shift(start, -1), shift(end, -1));
  return [half, e + 1];
}

// t 2^e for t >= 0, and never -0.
const times = (t, e) => ldexp(t, e) + 0;

// JavaScript has neither frexp nor ldexp. A double is 1 bit of sign, 11 of exponent, 52 of digits.
const bits = new DataView(new ArrayBuffer(8));

// 2^e, for a normal double.
function power(e) {
  bits.setBigUint64(0, BigInt(1023 + e) << 52n);
  return bits.getFloat64(0);
}

// The e for which |x| is in [1/2, 1) 2^e; for zero, below that of every double.
function exponent(x) {
  if (x === 0) return -1200;
  bits.setFloat64(0, x);
  const biased = (bits.getUint16(0) >> 4) & 0x7ff;
  return biased === 0 ? exponent(x * power(54)) - 54 : biased - 1022; // 0: subnormal
}

// x 2^e, rounded once. Down, the steps stop 53 places above the subnormals, so that only the last
// one can round.
function ldexp(x, e) {
  if (x === 0 || !Number.isFinite(x)) return x;
  for (; e > 1023; e -= 1023) x *= power(1023);
  for (; e < -1022; e += 969) x *= power(-969);
  return x * power(e);
}

// ---- to here -----------------------------------------------------------------------------------
