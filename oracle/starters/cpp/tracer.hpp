// What is asked and what is answered: client.cpp speaks the protocol, tracer.cpp is yours.
#pragma once

#include <vector>

struct Vector { double x = 0, y = 0, z = 0; };

// origin + t direction, t >= 0
struct Ray { Vector origin, direction; };

enum class Type {
    half_space, sphere, infinite_cylinder, slab, cylinder, union_, intersection, difference
};

// A solid has the fields of its type; the others are zero.
struct Solid {
    Type type = Type::half_space;
    Vector point, normal;   // half_space: (x - point) . normal <= 0
    Vector center;          // sphere
    Vector p, q;            // infinite_cylinder, slab, cylinder
    double radius = 0;      // sphere, infinite_cylinder, cylinder
    std::vector<Solid> of;  // union, intersection, difference: one part or more
};

// Sorted and disjoint, enter <= leave; the last leave may be infinity.
struct Pair { double enter, leave; };
using Pairs = std::vector<Pair>;

// Yours, in tracer.cpp: what you declare, and where the ray is in the solid.
extern const char* const hello;
Pairs intersect(const Solid& solid, const Ray& ray);
