#include "tracer.h"

/* ---- your tracer: replace from here ------------------------------------------------------------
 * What you declare, and the function `intersect`. Leave out the solids you do not have.
 *
 * What stands here is the reference tracer of raycert. No tolerance anywhere: lengths, axis and
 * direction are scaled by powers of two, which is exact, and no formula subtracts what nearly
 * cancels. That needs doubles that are rounded one operation at a time:
 * compile with -ffp-contract=off and without -ffast-math.
 */
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#if FLT_EVAL_METHOD != 0 || defined(__FAST_MATH__)
#error "doubles have to be rounded as doubles, and with no -ffast-math"
#endif

const char HELLO[] =
    "{\"hello\": 1, \"name\": \"reference tracer, in C\", \"version\": \"1\", "
    "\"solids\": [\"half_space\", \"sphere\", \"infinite_cylinder\", \"slab\", \"cylinder\", "
    "\"union\", \"intersection\", \"difference\"], "
    "\"precision\": \"binary64\", \"convention\": \"closed\", \"numbers\": \"bits\"}";

/* ---- lists of closed intervals: only compared, so nothing is rounded here */

static double larger(double a, double b) { return b > a ? b : a; }
static double smaller(double a, double b) { return b < a ? b : a; }

static Pairs room(size_t count) { return (Pairs){0, keep(count * sizeof(Pair))}; }

/* An interval that would end before it begins is none. */
static void add(Pairs *pairs, double enter, double leave)
{
    if (enter <= leave)
        pairs->at[pairs->count++] = (Pair){enter, leave};
}

static Pairs pair(double enter, double leave)
{
    Pairs pairs = room(1);
    add(&pairs, enter, leave);
    return pairs;
}

static Pairs nothing(void) { return (Pairs){0, NULL}; }
static Pairs everything(void) { return pair(0, INFINITY); }

static int by_enter(const void *first, const void *second)
{
    const Pair *a = first, *b = second;
    return (a->enter > b->enter) - (a->enter < b->enter);
}

/* The t in any of the intervals, in whatever order they come. Those that touch merge. */
static Pairs merged(Pairs all)
{
    Pairs list = room(all.count);
    if (all.count)
        qsort(all.at, all.count, sizeof *all.at, by_enter);
    for (size_t i = 0; i < all.count; i++) {
        Pair next = all.at[i], *last = list.at + list.count - 1;
        if (list.count && next.enter <= last->leave)
            last->leave = larger(last->leave, next.leave);
        else
            list.at[list.count++] = next;
    }
    return list;
}

static Pairs union_of(const Pairs *lists, size_t count)
{
    size_t total = 0;
    for (size_t i = 0; i < count; i++)
        total += lists[i].count;
    Pairs all = room(total);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < lists[i].count; j++)
            all.at[all.count++] = lists[i].at[j];
    return merged(all);
}

static Pairs both(Pairs one, Pairs other)
{
    Pairs common = room(one.count + other.count);   /* each piece begins where one of them does */
    for (size_t i = 0; i < one.count; i++)
        for (size_t j = 0; j < other.count; j++)
            add(&common, larger(one.at[i].enter, other.at[j].enter),
                smaller(one.at[i].leave, other.at[j].leave));
    return common;
}

/* The closure of the first without the holes: cutting out a single point leaves it in. */
static Pairs difference(Pairs left, Pairs holes)
{
    for (size_t i = 0; i < holes.count; i++) {
        Pair hole = holes.at[i];
        Pairs rest = room(2 * left.count);
        for (size_t j = 0; j < left.count; j++) {
            Pair whole = left.at[j];
            if (whole.enter < hole.enter)
                add(&rest, whole.enter, smaller(whole.leave, hole.enter));
            if (hole.leave < whole.leave)
                add(&rest, larger(whole.enter, hole.leave), whole.leave);
        }
        left = rest;
    }
    return merged(left);
}

/* ---- vectors, and their exact scaling by powers of two */

static double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* Exactly zero for parallel vectors of any length, as equal products round alike. */
static Vector cross(Vector a, Vector b)
{
    return (Vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The e for which |x| is in [1/2, 1) 2^e; for zero, below that of every double. */
static int exponent(double x)
{
    int e = -1200;
    if (x != 0)
        frexp(x, &e);
    return e;
}

static int largest(int a, int b) { return a > b ? a : b; }

static int size(Vector a)
{
    return largest(exponent(a.x), largest(exponent(a.y), exponent(a.z)));
}

static Vector shift(Vector a, int e)
{
    return (Vector){ldexp(a.x, e), ldexp(a.y, e), ldexp(a.z, e)};
}

/* |a|, exact along a coordinate axis. Not hypot: C has it for two numbers only, and the squares
 * of a scaled vector neither overflow nor lose anything. In the last bit it may differ from the
 * hypot of the reference. */
static double norm(Vector a)
{
    int e = size(a);
    Vector m = shift(a, -e);
    return ldexp(sqrt(dot(m, m)), e);
}

/* A vector as m 2^e, the largest component of m in [1/2, 1). */
typedef struct { Vector m; int e; } Scaled;

static Scaled scaled(Vector a)
{
    int e = size(a);
    return (Scaled){shift(a, -e), e};
}

/* end - start. One that overflows is taken again between the halves. */
static Scaled displacement(Vector start, Vector end)
{
    Vector d = {end.x - start.x, end.y - start.y, end.z - start.z};
    if (isinf(d.x) || isinf(d.y) || isinf(d.z)) {
        Scaled half = displacement(shift(start, -1), shift(end, -1));
        return (Scaled){half.m, half.e + 1};
    }
    return scaled(d);
}

/* t 2^e for t >= 0, and never -0. */
static double times(double t, int e) { return ldexp(t, e) + 0.0; }

static Pairs unscale(Pairs pairs, int e)
{
    for (size_t i = 0; i < pairs.count; i++) {
        pairs.at[i].enter = times(pairs.at[i].enter, e);
        pairs.at[i].leave = times(pairs.at[i].leave, e);
    }
    return pairs;
}

/* ---- the solids */

/* Where |y + t v| <= r: across an axis, or about a center. */
static Pairs chord(Vector y, Vector v, double r)
{
    double a = dot(v, v), b = dot(v, y);
    if (a == 0)
        return norm(y) <= r ? everything() : nothing();
    double reach = r * norm(v), offset = norm(cross(v, y));
    if (reach < offset)
        return nothing();
    /* The root of r^2 v.v - |v x y|^2, as a product: the squares would cancel near a tangency.
     * Likewise |y|^2 - r^2 near the wall; a start with norm(y) = r gives t = 0 itself. */
    double half = sqrt((reach - offset) * (reach + offset));
    double c = (norm(y) - r) * (norm(y) + r);

    /* The roots (-b - half) / a and (-b + half) / a. The one whose numerator cancels is c / k, k
     * the numerator of the other. Only where 2 half > |b| does it cancel much; elsewhere c / k is
     * the worse one. Near a tangent start it can even pass the other root, and is stopped there. */
    double t1 = (-b - half) / a, t2 = (-b + half) / a;
    if (2 * half > fabs(b)) {
        if (b > 0)
            t2 = larger(t1, c / (-b - half));
        else
            t1 = smaller(t2, c / (-b + half));
    }
    return pair(t1 < 0 ? 0 : t1, t2);
}

/* Between the planes through p and q square to pq: y and z are the start, seen from p and q. */
static Pairs slab(Vector y, Vector z, Vector v, Vector w)
{
    double up = -dot(y, w), uq = -dot(z, w), vn = -dot(v, w);
    if (vn == 0)
        return up <= 0 && 0 <= uq ? everything() : nothing();
    double tp = -up / vn, tq = -uq / vn;
    if (uq < 0)
        return vn > 0 ? pair(tq, tp) : nothing();   /* it starts beyond q */
    if (up > 0)
        return vn < 0 ? pair(tp, tq) : nothing();   /* it starts before p */
    return pair(0, vn > 0 ? tp : tq);
}

/* The three solids with an axis. Lengths from p and q are scaled by one power of two, v by
 * another, w = q - p by a third: no product overflows, and t only has to be scaled back. */
static Pairs axial(const Solid *s, const Ray *ray, bool wall, bool caps)
{
    Scaled v = scaled(ray->direction), w = displacement(s->p, s->q);
    Scaled y = displacement(s->p, ray->origin), z = displacement(s->q, ray->origin);
    int e = largest(largest(y.e, z.e), exponent(s->radius));
    y.m = shift(y.m, y.e - e);
    z.m = shift(z.m, z.e - e);
    Pairs pairs = caps ? slab(y.m, z.m, v.m, w.m) : everything();
    if (wall) {
        /* Crossed with w, which is not normalised: r is multiplied by |w| instead. So a direction
         * parallel to the axis gives exactly zero, whichever way the axis points. */
        double r = ldexp(s->radius, -e) * norm(w.m);
        pairs = both(chord(cross(y.m, w.m), cross(v.m, w.m), r), pairs);
    }
    return unscale(pairs, e - v.e);
}

static Pairs half_space(const Solid *s, const Ray *ray)
{
    Scaled n = scaled(s->normal), v = scaled(ray->direction);
    Scaled y = displacement(s->point, ray->origin);
    double up = dot(y.m, n.m), vn = dot(v.m, n.m);
    if (vn == 0 || (vn > 0) == (up > 0))
        return up <= 0 ? everything() : nothing();  /* it never comes to the plane */
    double t = times(-up / vn, y.e - v.e);
    return vn > 0 ? pair(0, t) : pair(t, INFINITY);
}

static Pairs sphere(const Solid *s, const Ray *ray)
{
    Scaled v = scaled(ray->direction), y = displacement(s->center, ray->origin);
    int e = largest(y.e, exponent(s->radius));
    return unscale(chord(shift(y.m, y.e - e), v.m, ldexp(s->radius, -e)), e - v.e);
}

static Pairs tree(const Solid *s, const Ray *ray)
{
    Pairs *lists = keep(s->parts * sizeof *lists);
    for (size_t i = 0; i < s->parts; i++)
        lists[i] = intersect(&s->of[i], ray);
    if (s->type == UNION)
        return union_of(lists, s->parts);
    if (s->type == DIFFERENCE)
        return difference(lists[0], union_of(lists + 1, s->parts - 1));
    for (size_t i = 1; i < s->parts; i++)
        lists[0] = both(lists[0], lists[i]);
    return lists[0];
}

Pairs intersect(const Solid *solid, const Ray *ray)
{
    switch (solid->type) {
    case HALF_SPACE: return half_space(solid, ray);
    case SPHERE: return sphere(solid, ray);
    case INFINITE_CYLINDER: return axial(solid, ray, true, false);
    case SLAB: return axial(solid, ray, false, true);
    case CYLINDER: return axial(solid, ray, true, true);
    default: return tree(solid, ray);
    }
}

/* ---- to here --------------------------------------------------------------------------------- */
