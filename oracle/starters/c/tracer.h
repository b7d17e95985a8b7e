/* What is asked and what is answered: client.c speaks the protocol, tracer.c is yours. */
#ifndef TRACER_H
#define TRACER_H

#include <stddef.h>

typedef struct { double x, y, z; } Vector;

/* origin + t direction, t >= 0 */
typedef struct { Vector origin, direction; } Ray;

typedef enum {
    HALF_SPACE, SPHERE, INFINITE_CYLINDER, SLAB, CYLINDER, UNION, INTERSECTION, DIFFERENCE
} Type;

/* A solid has the fields of its type; the others are zero. */
typedef struct Solid {
    Type type;
    Vector point, normal;   /* half_space: (x - point) . normal <= 0 */
    Vector center;          /* sphere */
    Vector p, q;            /* infinite_cylinder, slab, cylinder */
    double radius;          /* sphere, infinite_cylinder, cylinder */
    struct Solid *of;       /* union, intersection, difference: one part or more */
    size_t parts;
} Solid;

typedef struct { double enter, leave; } Pair;

/* Sorted and disjoint, enter <= leave; the last leave may be INFINITY. */
typedef struct { size_t count; Pair *at; } Pairs;

/* Yours, in tracer.c: what you declare, and where the ray is in the solid. */
extern const char HELLO[];
Pairs intersect(const Solid *solid, const Ray *ray);

/* Memory that is freed after the answer; never NULL. Use it, or your own. */
void *keep(size_t bytes);

#endif
