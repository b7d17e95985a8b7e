/* What most adapters need between raycert and a library: take what yours asks for.
 *
 *   frame, local, turned   its coordinates: p at the origin, the axis along z
 *   shifted                the origin in the middle of the axis, for half heights
 *   unit, rescaled         its direction and |v|, and t = s / |v| of distances s along it
 *   far_end                its segment, past the solid: a fraction f of it is s = f length
 *   paired                 its crossings, with its test of a point, as intervals
 *   clipped                its intervals of a whole line, from 0 on
 *
 * Nothing here has a tolerance, and what it rounds is as little as a few roundings of the input.
 */
#ifndef KIT_H
#define KIT_H

#include "tracer.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Coordinates in which p is the origin and q is (0, 0, height). */
typedef struct { Vector p, x, y, z; double height; } Frame;

static inline double length_of(Vector v) { return hypot(hypot(v.x, v.y), v.z); }

/* v / |v|, and |v|; for the zero direction, which has no unit, itself and 0. */
static inline Vector unit(Vector v, double *length)
{
    *length = length_of(v);
    double l = *length > 0 ? *length : 1;
    return (Vector){v.x / l, v.y / l, v.z / l};
}

/* The frame of an axis: of one along a coordinate axis it is exact. */
static inline Frame frame(Vector p, Vector q)
{
    Frame f = {.p = p};
    f.z = unit((Vector){q.x - p.x, q.y - p.y, q.z - p.z}, &f.height);
    double a = f.z.x, b = f.z.y, c = f.z.z, s = c < 0 ? -1 : 1, k = -1 / (s + c);
    f.x = (Vector){1 + s * a * a * k, s * a * b * k, -s * a};
    f.y = (Vector){a * b * k, s + b * b * k, -b};
    return f;
}

/* A direction in the coordinates of the frame. */
static inline Vector turned(const Frame *f, Vector v)
{
    return (Vector){
        f->x.x * v.x + f->x.y * v.y + f->x.z * v.z,
        f->y.x * v.x + f->y.y * v.y + f->y.z * v.z,
        f->z.x * v.x + f->z.y * v.y + f->z.z * v.z,
    };
}

/* A point in the coordinates of the frame: from p first, then turned. */
static inline Vector local(const Frame *f, Vector point)
{
    return turned(f, (Vector){point.x - f->p.x, point.y - f->p.y, point.z - f->p.z});
}

/* A local point seen from the middle of the axis; the half height is height / 2. */
static inline Vector shifted(const Frame *f, Vector point)
{
    return (Vector){point.x, point.y, point.z - f->height / 2};
}

static inline Vector along(Vector start, Vector d, double s)
{
    return (Vector){start.x + s * d.x, start.y + s * d.y, start.z + s * d.z};
}

/* The end of a segment from start along the unit d, and its length. It ends beyond a solid
 * within `size` of the origin; the length is a power of two: no fraction of it rounds. */
static inline Vector far_end(Vector start, Vector d, double size, double *length)
{
    int e;
    frexp(length_of(start) + size, &e);
    *length = ldexp(2, e);
    return along(start, d, *length);
}

static inline int by_size(const void *first, const void *second)
{
    double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

/* The intervals within [0, far] that crossings bound, in any order, doubled or not.
 *
 * Crossings that bound nothing do no harm: those of all the planes and walls of a solid will do.
 * Whether the ray is inside between two is asked of two points there, as one may be where it
 * grazes; before the first and after the last of the start and the far end too. What is inside up
 * to `far` is endless; a crossing that is inside, with nothing inside on either side, is a touch.
 * `inside` has to take what is within a rounding of the boundary for inside, or a chord that
 * grazes falls apart. */
static inline Pairs paired(const double *crossings, size_t count, double far,
                           bool (*inside)(double s, const void *context), const void *context)
{
    double *knots = keep((count + 2) * sizeof *knots);
    size_t n = 0;
    knots[n++] = 0;
    for (size_t i = 0; i < count; i++)
        if (0 <= crossings[i] && crossings[i] < far)
            knots[n++] = crossings[i];
    qsort(knots, n, sizeof *knots, by_size);
    knots[n++] = far;
    Pairs found = {0, keep(n * sizeof *found.at)};
    bool before = false, crossed = n > 2 && knots[1] == 0;  /* whether a knot is a crossing */
    for (size_t i = 0; i + 1 < n; i++, crossed = true) {
        double a = knots[i], b = knots[i + 1];
        if (a == b)
            continue;
        bool now = inside(a + 0.375 * (b - a), context)
            && inside(a + 0.625 * (b - a), context) && (a > 0 || inside(a, context))
            && (b < far || inside(b, context));
        if (now && !before)
            found.at[found.count++] = (Pair){a, b};
        if (now)
            found.at[found.count - 1].leave = b < far ? b : INFINITY;
        else if (!before && crossed && inside(a, context))
            found.at[found.count++] = (Pair){a, a};
        before = now;
    }
    return found;
}

/* The part with t >= 0 of intervals of a whole line. */
static inline Pairs clipped(Pairs pairs)
{
    Pairs found = {0, pairs.at};
    for (size_t i = 0; i < pairs.count; i++)
        if (pairs.at[i].leave >= 0)
            found.at[found.count++] = (Pair){fmax(pairs.at[i].enter, 0), pairs.at[i].leave};
    return found;
}

/* Distances along a unit direction, as the t of a direction of this length. */
static inline Pairs rescaled(Pairs pairs, double length)
{
    for (size_t i = 0; i < pairs.count; i++)
        pairs.at[i] = (Pair){pairs.at[i].enter / length, pairs.at[i].leave / length};
    return pairs;
}

#endif
