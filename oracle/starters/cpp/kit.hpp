// What most adapters need between raycert and a library: take what yours asks for.
//
//   frame, local, turned   its coordinates: p at the origin, the axis along z
//   shifted                the origin in the middle of the axis, for half heights
//   unit, rescaled         its direction and |v|, and t = s / |v| of distances s along it
//   far_end                its segment, past the solid: a fraction f of it is s = f length
//   paired                 its crossings, with its test of a point, as intervals
//   clipped                its intervals of a whole line, from 0 on
//
// Nothing here has a tolerance, and what it rounds is as little as a few roundings of the input.
#pragma once

#include "tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kit {

// Coordinates in which p is the origin and q is (0, 0, height).
struct Frame { Vector p, x, y, z; double height; };

struct Unit { Vector d; double length; };
struct End { Vector point; double length; };

inline double length(Vector v) { return std::hypot(v.x, v.y, v.z); }

// v / |v|, and |v|; for the zero direction, which has no unit, itself and 0.
inline Unit unit(Vector v)
{
    double l = length(v), by = l > 0 ? l : 1;
    return {{v.x / by, v.y / by, v.z / by}, l};
}

// The frame of an axis: of one along a coordinate axis it is exact.
inline Frame frame(Vector p, Vector q)
{
    auto [z, height] = unit({q.x - p.x, q.y - p.y, q.z - p.z});
    double a = z.x, b = z.y, c = z.z, s = c < 0 ? -1 : 1, k = -1 / (s + c);
    Vector x = {1 + s * a * a * k, s * a * b * k, -s * a}, y = {a * b * k, s + b * b * k, -b};
    return {p, x, y, z, height};
}

// A direction in the coordinates of the frame.
inline Vector turned(const Frame& f, Vector v)
{
    auto dot = [v](Vector a) { return a.x * v.x + a.y * v.y + a.z * v.z; };
    return {dot(f.x), dot(f.y), dot(f.z)};
}

// A point in the coordinates of the frame: from p first, then turned.
inline Vector local(const Frame& f, Vector point)
{
    return turned(f, {point.x - f.p.x, point.y - f.p.y, point.z - f.p.z});
}

// A local point seen from the middle of the axis; the half height is height / 2.
inline Vector shifted(const Frame& f, Vector point)
{
    return {point.x, point.y, point.z - f.height / 2};
}

inline Vector along(Vector start, Vector d, double s)
{
    return {start.x + s * d.x, start.y + s * d.y, start.z + s * d.z};
}

// The end of a segment from start along the unit d, and its length. It ends beyond a solid
// within `size` of the origin; the length is a power of two: no fraction of it rounds.
inline End far_end(Vector start, Vector d, double size)
{
    int e;
    std::frexp(length(start) + size, &e);
    double far = std::ldexp(2, e);
    return {along(start, d, far), far};
}

// The intervals within [0, far] that crossings bound, in any order, doubled or not.
//
// Crossings that bound nothing do no harm: those of all the planes and walls of a solid will do.
// Whether the ray is inside between two is asked of two points there, as one may be where it
// grazes; before the first and after the last of the start and the far end too. What is inside up
// to `far` is endless; a crossing that is inside, with nothing inside on either side, is a touch.
// `inside` has to take what is within a rounding of the boundary for inside, or a chord that
// grazes falls apart.
template <class Inside>
Pairs paired(const std::vector<double>& crossings, double far, Inside inside)
{
    std::vector<double> knots = {0};
    for (double s : crossings)
        if (0 <= s && s < far)
            knots.push_back(s);
    std::sort(knots.begin(), knots.end());
    bool before = false, crossed = knots.size() > 1 && knots[1] == 0;   // is a knot a crossing
    knots.push_back(far);
    Pairs found;
    for (std::size_t i = 0; i + 1 < knots.size(); i++, crossed = true) {
        double a = knots[i], b = knots[i + 1];
        if (a == b)
            continue;
        bool now = inside(a + 0.375 * (b - a)) && inside(a + 0.625 * (b - a))
            && (a > 0 || inside(a)) && (b < far || inside(b));
        if (now && !before)
            found.push_back({a, b});
        if (now)
            found.back().leave = b < far ? b : std::numeric_limits<double>::infinity();
        else if (!before && crossed && inside(a))
            found.push_back({a, a});
        before = now;
    }
    return found;
}

// The part with t >= 0 of intervals of a whole line.
inline Pairs clipped(const Pairs& pairs)
{
    Pairs found;
    for (auto [enter, leave] : pairs)
        if (leave >= 0)
            found.push_back({std::max(enter, 0.0), leave});
    return found;
}

// Distances along a unit direction, as the t of a direction of this length.
inline Pairs rescaled(Pairs pairs, double length)
{
    for (auto& [enter, leave] : pairs) {
        enter /= length;
        leave /= length;
    }
    return pairs;
}

}  // namespace kit
