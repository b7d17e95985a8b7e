package main

// ---- your tracer: replace from here -----------------------------------------------------------
// What you declare, and the function intersect. Leave out the solids you do not have.
//
// What stands here is the reference tracer of raycert. No tolerance anywhere: lengths, axis and
// direction are scaled by powers of two, which is exact, and no formula subtracts what nearly
// cancels. That needs doubles that are rounded one operation at a time. On some processors (arm64)
// Go fuses a product into the sum it goes into, but for one that is converted: float64(a * b).

import (
	"cmp"
	"math"
	"slices"
)

var hello = map[string]any{
	"hello":   1,
	"name":    "reference tracer, in Go",
	"version": "1",
	"solids": []string{
		"half_space", "sphere", "infinite_cylinder", "slab", "cylinder",
		"union", "intersection", "difference",
	},
	"precision":  "binary64",
	"convention": "closed",
	"numbers":    "decimal",
}

// intersect returns the intervals of t >= 0 for which the ray is in the solid.
func intersect(s Solid, ray Ray) []Pair {
	switch s.Type {
	case "half_space":
		return halfSpace(s, ray)
	case "sphere":
		return sphere(s, ray)
	case "infinite_cylinder":
		return axial(s, ray, true, false)
	case "slab":
		return axial(s, ray, false, true)
	case "cylinder":
		return axial(s, ray, true, true)
	case "union":
		return anyOf(s.Of, ray)
	case "intersection":
		return allOf(s.Of, ray)
	case "difference":
		return difference(intersect(s.Of[0], ray), anyOf(s.Of[1:], ray))
	}
	panic("no such solid")
}

func halfSpace(s Solid, ray Ray) []Pair {
	n, _ := scaled(s.Normal)
	v, ve := scaled(ray.Direction)
	y, ye := displacement(s.Point, ray.Origin)
	up, vn := dot(y, n), dot(v, n)
	if vn == 0 || (vn > 0) == (up > 0) {
		return everythingIf(up <= 0) // it never comes to the plane
	}
	t := times(-up/vn, ye-ve)
	if vn > 0 {
		return pair(0, t)
	}
	return pair(t, math.Inf(1))
}

func sphere(s Solid, ray Ray) []Pair {
	v, ve := scaled(ray.Direction)
	y, ye := displacement(s.Center, ray.Origin)
	e := max(ye, exponent(s.Radius))
	return unscale(chord(shift(y, ye-e), v, math.Ldexp(s.Radius, -e)), e-ve)
}

// axial returns where the ray is within the wall around pq, between the caps, or both.
//
// Lengths from p and q are scaled by one power of two, v by another, w = q - p by a third: no
// product overflows, and t only has to be scaled back.
func axial(s Solid, ray Ray, wall, caps bool) []Pair {
	v, ve := scaled(ray.Direction)
	y, ye := displacement(s.P, ray.Origin)
	z, ze := displacement(s.Q, ray.Origin)
	w, _ := displacement(s.P, s.Q)
	e := max(ye, ze, exponent(s.Radius))
	y, z = shift(y, ye-e), shift(z, ze-e)
	pairs := everythingIf(true)
	if wall {
		// Crossed with w, which is not normalised: r is multiplied by |w| instead. So a direction
		// parallel to the axis gives exactly zero, whichever way the axis points.
		pairs = chord(cross(y, w), cross(v, w), float64(math.Ldexp(s.Radius, -e)*norm(w)))
	}
	if caps {
		pairs = both(pairs, slab(y, z, v, w))
	}
	return unscale(pairs, e-ve)
}

// slab returns where the ray is between the planes through p and q square to pq: y and z are the
// start, seen from p and q.
func slab(y, z, v, w Vector) []Pair {
	up, uq, vn := -dot(y, w), -dot(z, w), -dot(v, w)
	tp, tq := -up/vn, -uq/vn
	switch {
	case vn == 0:
		return everythingIf(up <= 0 && 0 <= uq)
	case uq < 0 && vn > 0: // it starts beyond q
		return pair(tq, tp)
	case uq < 0:
		return nil
	case up > 0 && vn < 0: // it starts before p
		return pair(tp, tq)
	case up > 0:
		return nil
	case vn > 0:
		return pair(0, tp)
	}
	return pair(0, tq)
}

// chord returns where |y + t v| <= r: across an axis, or about a center.
func chord(y, v Vector, r float64) []Pair {
	a, b := dot(v, v), dot(v, y)
	if a == 0 {
		return everythingIf(norm(y) <= r)
	}
	reach, offset := float64(r*norm(v)), norm(cross(v, y))
	if reach < offset {
		return nil
	}
	// The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a tangency.
	// Likewise |y|^2 - r^2 near the wall; a start with norm(y) = r gives t = 0 itself.
	half := math.Sqrt((reach - offset) * (reach + offset))
	c := float64((norm(y) - r) * (norm(y) + r))

	// The roots (-b - half) / a and (-b + half) / a. The one whose numerator cancels is c / k, k
	// the numerator of the other. Only where 2 half > |b| does it cancel much; elsewhere c / k is
	// the worse one. Near a tangent start that can even pass the other root: it is stopped there.
	t1, t2 := (-b-half)/a, (-b+half)/a
	if 2*half > math.Abs(b) {
		if b > 0 {
			t2 = max(t1, c/(-b-half))
		} else {
			t1 = min(t2, c/(-b+half))
		}
	}
	if t1 < 0 {
		t1 = 0
	}
	return pair(t1, t2)
}

// ---- lists of closed intervals: only compared, so nothing is rounded here

// pair returns the list of the one interval; one that would end before it begins is none.
func pair(enter, leave float64) []Pair {
	if enter <= leave {
		return []Pair{{enter, leave}}
	}
	return nil
}

func everythingIf(inside bool) []Pair {
	if inside {
		return pair(0, math.Inf(1))
	}
	return nil
}

// merged returns the t in any of the intervals, in whatever order they come.
func merged(all []Pair) (list []Pair) {
	slices.SortFunc(all, func(a, b Pair) int { return cmp.Compare(a.Enter, b.Enter) })
	for _, next := range all {
		if n := len(list); n > 0 && next.Enter <= list[n-1].Leave {
			list[n-1].Leave = max(list[n-1].Leave, next.Leave)
		} else {
			list = append(list, next)
		}
	}
	return list
}

func anyOf(parts []Solid, ray Ray) (all []Pair) {
	for _, part := range parts {
		all = append(all, intersect(part, ray)...)
	}
	return merged(all)
}

func allOf(parts []Solid, ray Ray) []Pair {
	common := everythingIf(true)
	for _, part := range parts {
		common = both(common, intersect(part, ray))
	}
	return common
}

func both(one, other []Pair) (common []Pair) {
	for _, a := range one {
		for _, b := range other {
			common = append(common, pair(max(a.Enter, b.Enter), min(a.Leave, b.Leave))...)
		}
	}
	return common
}

// difference returns the closure of the intervals less the holes: cutting out a single point
// leaves it in.
func difference(left, holes []Pair) []Pair {
	for _, hole := range holes {
		var rest []Pair
		for _, whole := range left {
			if whole.Enter < hole.Enter {
				rest = append(rest, Pair{whole.Enter, min(whole.Leave, hole.Enter)})
			}
			if hole.Leave < whole.Leave {
				rest = append(rest, Pair{max(whole.Enter, hole.Leave), whole.Leave})
			}
		}
		left = rest
	}
	return merged(left)
}

func unscale(pairs []Pair, e int) []Pair {
	for i, t := range pairs {
		pairs[i] = Pair{times(t.Enter, e), times(t.Leave, e)}
	}
	return pairs
}

// ---- vectors, and their exact scaling by powers of two

func dot(a, b Vector) float64 {
	return float64(a[0]*b[0]) + float64(a[1]*b[1]) + float64(a[2]*b[2])
}

// cross is exactly zero for parallel vectors of any length, as equal products round alike.
func cross(a, b Vector) Vector {
	return Vector{
		float64(a[1]*b[2]) - float64(a[2]*b[1]),
		float64(a[2]*b[0]) - float64(a[0]*b[2]),
		float64(a[0]*b[1]) - float64(a[1]*b[0]),
	}
}

// norm returns |a|, exact along a coordinate axis. Not math.Hypot, which is for two numbers and
// divides by the larger: the squares of a scaled vector neither overflow nor lose anything. In the
// last bit it may differ from the hypot of the reference.
func norm(a Vector) float64 {
	m, e := scaled(a)
	return math.Ldexp(math.Sqrt(dot(m, m)), e)
}

// exponent returns the e for which |x| is in [1/2, 1) 2^e; for zero, below that of all others.
func exponent(x float64) int {
	if x == 0 {
		return -1200
	}
	_, e := math.Frexp(x)
	return e
}

func shift(a Vector, e int) Vector {
	return Vector{math.Ldexp(a[0], e), math.Ldexp(a[1], e), math.Ldexp(a[2], e)}
}

// scaled returns (m, e) with a = m 2^e and the largest component of m in [1/2, 1).
func scaled(a Vector) (Vector, int) {
	e := max(exponent(a[0]), exponent(a[1]), exponent(a[2]))
	return shift(a, -e), e
}

// displacement returns end - start, scaled. One that overflows is taken again between the halves.
func displacement(start, end Vector) (Vector, int) {
	var d Vector
	for i := range d {
		d[i] = end[i] - start[i]
		if math.IsInf(d[i], 0) {
			half, e := displacement(shift(start, -1), shift(end, -1))
			return half, e + 1
		}
	}
	return scaled(d)
}

// times returns t 2^e for t >= 0, and never -0.
func times(t float64, e int) float64 { return math.Ldexp(t, e) + 0 }

// ---- to here ----------------------------------------------------------------------------------
