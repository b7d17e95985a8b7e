// What most adapters need between raycert and a library: take what yours asks for.
//
//   frame, local, turned   its coordinates: p at the origin, the axis along z
//   shifted                the origin in the middle of the axis, for half heights
//   unit, rescaled         its direction and |v|, and t = s / |v| of distances s along it
//   farEnd                 its segment, past the solid: a fraction f of it is s = f length
//   paired                 its crossings, with its test of a point, as intervals
//   clipped                its intervals of a whole line, from 0 on
//
// Nothing here has a tolerance, and what it rounds is as little as a few roundings of the input.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const along = (start, d, s) => start.map((x, i) => x + s * d[i]);

// [v / |v|, |v|]; for the zero direction, which has no unit, itself and 0.
export function unit(v) {
  const length = Math.hypot(...v);
  return [length > 0 ? v.map((x) => x / length) : v, length];
}

// Coordinates in which p is the origin and q is [0, 0, height]: of an axis along a coordinate axis
// they are exact.
export function frame(p, q) {
  const [z, height] = unit(minus(q, p));
  const [a, b, c] = z;
  const s = c < 0 ? -1 : 1, k = -1 / (s + c);
  const x = [1 + s * a * a * k, s * a * b * k, -s * a], y = [a * b * k, s + b * b * k, -b];
  return { p, x, y, z, height };
}

// A direction in the coordinates of the frame.
export const turned = ({ x, y, z }, v) => [dot(x, v), dot(y, v), dot(z, v)];

// A point in the coordinates of the frame: from p first, then turned.
export const local = (f, point) => turned(f, minus(point, f.p));

// A local point seen from the middle of the axis; the half height is height / 2.
export const shifted = (f, [x, y, z]) => [x, y, z - f.height / 2];

// [end, length] of a segment from start along the unit d. It ends beyond a solid within `size` of
// the origin; the length is a power of two: no fraction of it rounds.
export function farEnd(start, d, size) {
  const length = 2 ** (Math.ceil(Math.log2(Math.hypot(...start) + size || 1)) + 2);
  return [along(start, d, length), length];
}

// The intervals within [0, far] that crossings bound, in any order, doubled or not.
//
// <p>Crossings that bound nothing do no harm: those of all the planes and walls of a solid will
// do. Whether the ray is inside between two is asked of two points there, as one may be where it
// grazes; before the first and after the last of the start and the far end too. What is inside up
// to `far` is endless; a crossing that is inside, with nothing inside on either side, is a touch.
// `inside` has to take what is within a rounding of the boundary for inside, or a chord that
// grazes falls apart.
export function paired(crossings, far, inside) {
  const ends = new Set(crossings.filter((s) => 0 <= s && s < far));
  const knots = [...new Set([0, ...ends, far])].sort((a, b) => a - b);
  const found = [];
  let before = false;
  for (let i = 0; i + 1 < knots.length; i++) {
    const a = knots[i], b = knots[i + 1];
    const now = inside(a + 0.375 * (b - a)) && inside(a + 0.625 * (b - a))
      && (a > 0 || inside(a)) && (b < far || inside(b));
    if (now && !before) found.push([a, b]);
    if (now) found.at(-1)[1] = b < far ? b : Infinity;
    else if (!before && ends.has(a) && inside(a)) found.push([a, a]);
    before = now;
  }
  return found;
}

// The part with t >= 0 of intervals of a whole line.
export const clipped = (pairs) =>
  pairs.filter(([, leave]) => leave >= 0).map(([enter, leave]) => [Math.max(enter, 0), leave]);

// Distances along a unit direction, as the t of a direction of this length.
export const rescaled = (pairs, length) => pairs.map((pair) => pair.map((s) => s / length));
