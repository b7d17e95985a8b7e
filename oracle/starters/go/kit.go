package main

// What most adapters need between raycert and a library: take what yours asks for.
//
//	frameOf, local, turned   its coordinates: p at the origin, the axis along z
//	shifted                  the origin in the middle of the axis, for half heights
//	unit, rescaled           its direction and |v|, and t = s / |v| of distances s along it
//	farEnd                   its segment, past the solid: a fraction f of it is s = f length
//	paired                   its crossings, with its test of a point, as intervals
//	clipped                  its intervals of a whole line, from 0 on
//
// Nothing here has a tolerance, and what it rounds is as little as a few roundings of the input.

import (
	"math"
	"slices"
)

// Frame is coordinates in which P is the origin and Q is (0, 0, Height).
type Frame struct {
	P, X, Y, Z Vector
	Height     float64
}

func minus(a, b Vector) Vector { return Vector{a[0] - b[0], a[1] - b[1], a[2] - b[2]} }

func length(v Vector) float64 { return math.Hypot(math.Hypot(v[0], v[1]), v[2]) }

// unit returns v / |v| and |v|; for the zero direction, which has no unit, itself and 0.
func unit(v Vector) (Vector, float64) {
	l := length(v)
	if l == 0 {
		return v, 0
	}
	return Vector{v[0] / l, v[1] / l, v[2] / l}, l
}

// frameOf returns the frame of an axis: of one along a coordinate axis it is exact.
func frameOf(p, q Vector) Frame {
	z, height := unit(minus(q, p))
	a, b, c := z[0], z[1], z[2]
	s := math.Copysign(1, c)
	k := -1 / (s + c)
	x := Vector{1 + float64(s*a*a*k), s * a * b * k, -s * a}
	return Frame{p, x, Vector{a * b * k, s + float64(b*b*k), -b}, z, height}
}

// turned returns a direction in the coordinates of the frame.
func turned(f Frame, v Vector) Vector { return Vector{dot(f.X, v), dot(f.Y, v), dot(f.Z, v)} }

// local returns a point in the coordinates of the frame: from p first, then turned.
func local(f Frame, point Vector) Vector { return turned(f, minus(point, f.P)) }

// shifted returns a local point seen from the middle of the axis; the half height is Height / 2.
func shifted(f Frame, point Vector) Vector {
	return Vector{point[0], point[1], point[2] - f.Height/2}
}

func along(start, d Vector, s float64) Vector {
	return Vector{
		start[0] + float64(s*d[0]), start[1] + float64(s*d[1]), start[2] + float64(s*d[2]),
	}
}

// farEnd returns the end of a segment from start along the unit d, and its length. It ends beyond a
// solid within size of the origin; the length is a power of two: no fraction of it rounds.
func farEnd(start, d Vector, size float64) (Vector, float64) {
	_, e := math.Frexp(length(start) + size)
	far := math.Ldexp(2, e)
	return along(start, d, far), far
}

// paired returns the intervals within [0, far] that crossings bound, in any order, doubled or not.
//
// Crossings that bound nothing do no harm: those of all the planes and walls of a solid will do.
// Whether the ray is inside between two is asked of two points there, as one may be where it
// grazes; before the first and after the last of the start and the far end too. What is inside up
// to far is endless; a crossing that is inside, with nothing inside on either side, is a touch.
// inside has to take what is within a rounding of the boundary for inside, or a chord that grazes
// falls apart.
func paired(crossings []float64, far float64, inside func(s float64) bool) (found []Pair) {
	knots := []float64{0, far}
	for _, s := range crossings {
		if 0 <= s && s < far {
			knots = append(knots, s)
		}
	}
	slices.Sort(knots)
	crossed := knots[1] == 0 // whether a knot is a crossing
	before := false
	for i, b := range knots[1:] {
		a := knots[i]
		if a == b {
			continue
		}
		now := inside(a+0.375*(b-a)) && inside(a+0.625*(b-a)) &&
			(a > 0 || inside(a)) && (b < far || inside(b))
		if now && !before {
			found = append(found, Pair{a, b})
		}
		if now {
			if b == far {
				b = math.Inf(1)
			}
			found[len(found)-1].Leave = b
		} else if !before && (a > 0 || crossed) && inside(a) {
			found = append(found, Pair{a, a})
		}
		before = now
	}
	return found
}

// clipped returns the part with t >= 0 of intervals of a whole line.
func clipped(pairs []Pair) (found []Pair) {
	for _, pair := range pairs {
		if pair.Leave >= 0 {
			found = append(found, Pair{max(pair.Enter, 0), pair.Leave})
		}
	}
	return found
}

// rescaled returns distances along a unit direction as the t of a direction of this length.
func rescaled(pairs []Pair, length float64) []Pair {
	for i, pair := range pairs {
		pairs[i] = Pair{pair.Enter / length, pair.Leave / length}
	}
	return pairs
}
