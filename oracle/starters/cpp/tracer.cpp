#include "tracer.hpp"

// ---- your tracer: replace from here ------------------------------------------------------------
// What you declare, and the function `intersect`. Leave out the solids you do not have.
//
// What stands here is the reference tracer of raycert. No tolerance anywhere: lengths, axis and
// direction are scaled by powers of two, which is exact, and no formula subtracts what nearly
// cancels. That needs doubles that are rounded one operation at a time:
// compile with -ffp-contract=off and without -ffast-math.

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#if FLT_EVAL_METHOD != 0 || defined(__FAST_MATH__)
#error "doubles have to be rounded as doubles, and with no -ffast-math"
#endif

const char* const hello = R"({"hello": 1, "name": "reference tracer, in C++", "version": "1", )"
    R"("solids": ["half_space", "sphere", "infinite_cylinder", "slab", "cylinder", )"
    R"("union", "intersection", "difference"], )"
    R"("precision": "binary64", "convention": "closed", "numbers": "bits"})";

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const Pairs nothing, everything = {{0, infinity}};

// ---- lists of closed intervals: only compared, so nothing is rounded here

// An interval that would end before it begins is none.
void add(Pairs& pairs, double enter, double leave)
{
    if (enter <= leave)
        pairs.push_back({enter, leave});
}

Pairs pair(double enter, double leave)
{
    Pairs pairs;
    add(pairs, enter, leave);
    return pairs;
}

// The t in any of the intervals, in whatever order they come. Those that touch merge.
Pairs merged(Pairs all)
{
    std::sort(all.begin(), all.end(), [](Pair a, Pair b) { return a.enter < b.enter; });
    Pairs list;
    for (Pair next : all) {
        if (!list.empty() && next.enter <= list.back().leave)
            list.back().leave = std::max(list.back().leave, next.leave);
        else
            list.push_back(next);
    }
    return list;
}

Pairs both(const Pairs& one, const Pairs& other)
{
    Pairs common;
    for (auto [a, b] : one)
        for (auto [c, d] : other)
            add(common, std::max(a, c), std::min(b, d));
    return common;
}

// The closure of the first without the holes: cutting out a single point leaves it in.
Pairs difference(Pairs left, const Pairs& holes)
{
    for (auto [c, d] : holes) {
        Pairs rest;
        for (auto [a, b] : left) {
            if (a < c)
                add(rest, a, std::min(b, c));
            if (d < b)
                add(rest, std::max(a, d), b);
        }
        left = std::move(rest);
    }
    return merged(left);
}

// ---- vectors, and their exact scaling by powers of two

Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Exactly zero for parallel vectors of any length, as equal products round alike.
Vector cross(Vector a, Vector b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The e for which |x| is in [1/2, 1) 2^e; for zero, below that of every double.
int exponent(double x)
{
    int e = -1200;
    if (x != 0)
        std::frexp(x, &e);
    return e;
}

int exponent(Vector a) { return std::max({exponent(a.x), exponent(a.y), exponent(a.z)}); }

Vector shift(Vector a, int e)
{
    return {std::ldexp(a.x, e), std::ldexp(a.y, e), std::ldexp(a.z, e)};
}

// |a|, exact along a coordinate axis. Not std::hypot, which divides by the largest component: the
// squares of a scaled vector neither overflow nor lose anything. In the last bit it may differ
// from the hypot of the reference.
double norm(Vector a)
{
    int e = exponent(a);
    Vector m = shift(a, -e);
    return std::ldexp(std::sqrt(dot(m, m)), e);
}

// A vector as m 2^e, the largest component of m in [1/2, 1).
struct Scaled { Vector m; int e; };

Scaled scaled(Vector a)
{
    int e = exponent(a);
    return {shift(a, -e), e};
}

// end - start. One that overflows is taken again between the halves.
Scaled displacement(Vector start, Vector end)
{
    Vector d = end - start;
    if (std::isinf(d.x) || std::isinf(d.y) || std::isinf(d.z)) {
        Scaled half = displacement(shift(start, -1), shift(end, -1));
        return {half.m, half.e + 1};
    }
    return scaled(d);
}

// t 2^e for t >= 0, and never -0.
double times(double t, int e) { return std::ldexp(t, e) + 0.0; }

Pairs unscale(Pairs pairs, int e)
{
    for (auto& [enter, leave] : pairs) {
        enter = times(enter, e);
        leave = times(leave, e);
    }
    return pairs;
}

// ---- the solids

// Where |y + t v| <= r: across an axis, or about a center.
Pairs chord(Vector y, Vector v, double r)
{
    double a = dot(v, v), b = dot(v, y);
    if (a == 0)
        return norm(y) <= r ? everything : nothing;
    double reach = r * norm(v), offset = norm(cross(v, y));
    if (reach < offset)
        return nothing;
    // The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a tangency.
    // Likewise |y|^2 - r^2 near the wall; a start with norm(y) = r gives t = 0 itself.
    double half = std::sqrt((reach - offset) * (reach + offset));
    double c = (norm(y) - r) * (norm(y) + r);

    // The roots (-b - half) / a and (-b + half) / a. The one whose numerator cancels is c / k, k
    // the numerator of the other. Only where 2 half > |b| does it cancel much; elsewhere c / k is
    // the worse one. Near a tangent start that can even pass the other root: it is stopped there.
    double t1 = (-b - half) / a, t2 = (-b + half) / a;
    if (2 * half > std::abs(b)) {
        if (b > 0)
            t2 = std::max(t1, c / (-b - half));
        else
            t1 = std::min(t2, c / (-b + half));
    }
    return pair(t1 < 0 ? 0 : t1, t2);
}

// Between the planes through p and q square to pq: y and z are the start, seen from p and q.
Pairs slab(Vector y, Vector z, Vector v, Vector w)
{
    double up = -dot(y, w), uq = -dot(z, w), vn = -dot(v, w);
    if (vn == 0)
        return up <= 0 && 0 <= uq ? everything : nothing;
    double tp = -up / vn, tq = -uq / vn;
    if (uq < 0)
        return vn > 0 ? pair(tq, tp) : nothing;     // it starts beyond q
    if (up > 0)
        return vn < 0 ? pair(tp, tq) : nothing;     // it starts before p
    return pair(0, vn > 0 ? tp : tq);
}

// The three solids with an axis. Lengths from p and q are scaled by one power of two, v by
// another, w = q - p by a third: no product overflows, and t only has to be scaled back.
Pairs axial(const Solid& s, const Ray& ray, bool wall, bool caps)
{
    Scaled v = scaled(ray.direction), w = displacement(s.p, s.q);
    Scaled y = displacement(s.p, ray.origin), z = displacement(s.q, ray.origin);
    int e = std::max({y.e, z.e, exponent(s.radius)});
    y.m = shift(y.m, y.e - e);
    z.m = shift(z.m, z.e - e);
    Pairs pairs = caps ? slab(y.m, z.m, v.m, w.m) : everything;
    if (wall) {
        // Crossed with w, which is not normalised: r is multiplied by |w| instead. So a direction
        // parallel to the axis gives exactly zero, whichever way the axis points.
        double r = std::ldexp(s.radius, -e) * norm(w.m);
        pairs = both(chord(cross(y.m, w.m), cross(v.m, w.m), r), pairs);
    }
    return unscale(pairs, e - v.e);
}

Pairs half_space(const Solid& s, const Ray& ray)
{
    Scaled n = scaled(s.normal), v = scaled(ray.direction);
    Scaled y = displacement(s.point, ray.origin);
    double up = dot(y.m, n.m), vn = dot(v.m, n.m);
    if (vn == 0 || (vn > 0) == (up > 0))
        return up <= 0 ? everything : nothing;      // it never comes to the plane
    double t = times(-up / vn, y.e - v.e);
    return vn > 0 ? pair(0, t) : pair(t, infinity);
}

Pairs sphere(const Solid& s, const Ray& ray)
{
    Scaled v = scaled(ray.direction), y = displacement(s.center, ray.origin);
    int e = std::max(y.e, exponent(s.radius));
    return unscale(chord(shift(y.m, y.e - e), v.m, std::ldexp(s.radius, -e)), e - v.e);
}

Pairs all_of(const Solid* part, const Solid* end, const Ray& ray)
{
    Pairs common = everything;
    for (; part != end; part++)
        common = both(common, intersect(*part, ray));
    return common;
}

Pairs any_of(const Solid* part, const Solid* end, const Ray& ray)
{
    Pairs all;
    for (; part != end; part++)
        for (Pair found : intersect(*part, ray))
            all.push_back(found);
    return merged(all);
}

}  // namespace

Pairs intersect(const Solid& solid, const Ray& ray)
{
    const Solid *first = solid.of.data(), *end = first + solid.of.size();
    switch (solid.type) {
    case Type::half_space: return half_space(solid, ray);
    case Type::sphere: return sphere(solid, ray);
    case Type::infinite_cylinder: return axial(solid, ray, true, false);
    case Type::slab: return axial(solid, ray, false, true);
    case Type::cylinder: return axial(solid, ray, true, true);
    case Type::union_: return any_of(first, end, ray);
    case Type::intersection: return all_of(first, end, ray);
    case Type::difference: return difference(intersect(*first, ray), any_of(first + 1, end, ray));
    }
    return nothing;
}

// ---- to here -----------------------------------------------------------------------------------
