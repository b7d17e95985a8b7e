/* A tracer as a shared library: what raycert calls, with no text, no JSON and no pipe between.
 *
 * A ray is origin + t direction, t >= 0; the direction is not normalised, and t is in its units.
 * A solid is a closed set. It comes in prefix order as two flat arrays, codes and numbers:
 *
 *   code of the solid            in `solid`            in `numbers`
 *   RAYCERT_HALF_SPACE           code                  point[3] normal[3]
 *   RAYCERT_SPHERE               code                  center[3] radius
 *   RAYCERT_INFINITE_CYLINDER    code                  p[3] q[3] radius
 *   RAYCERT_SLAB                 code                  p[3] q[3]
 *   RAYCERT_CYLINDER             code                  p[3] q[3] radius
 *   RAYCERT_UNION                code n, then n solids
 *   RAYCERT_INTERSECTION         code n, then n solids
 *   RAYCERT_DIFFERENCE           code n, then n solids: the first, less all the others
 *
 * The difference of a sphere and a slab is {8, 2, 2, 4} and the 4 + 6 numbers of the two. All
 * numbers are finite. A tracer in binary32 says so in its hello: then each is exactly a float.
 * The arrays are the caller's, and are gone after the call. Calls come one at a time, from one
 * thread. What is printed to standard output does no harm.
 */
#ifndef RAYCERT_H
#define RAYCERT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifdef _WIN32
#define RAYCERT_EXPORT __declspec(dllexport)
#else
#define RAYCERT_EXPORT __attribute__((visibility("default")))
#endif

enum {
    RAYCERT_HALF_SPACE = 1,         /* (x - point) . normal <= 0 */
    RAYCERT_SPHERE = 2,             /* |x - center| <= radius */
    RAYCERT_INFINITE_CYLINDER = 3,  /* distance from the line pq <= radius */
    RAYCERT_SLAB = 4,               /* between the planes through p and q square to pq */
    RAYCERT_CYLINDER = 5,           /* in both */
    RAYCERT_UNION = 6,
    RAYCERT_INTERSECTION = 7,
    RAYCERT_DIFFERENCE = 8
};

enum {
    RAYCERT_UNSUPPORTED = -1,       /* the solid is of a type that it does not have */
    RAYCERT_ERROR = -2              /* it cannot answer */
};

/* Writes where the ray is in the solid, and returns how many pairs that are.
 *
 *   solid, words         the codes, and how many int32 they are
 *   numbers, count       the numbers, and how many doubles they are
 *   out, capacity        room for `capacity` pairs: 2 * capacity doubles
 *
 * Pairs enter, leave are sorted and disjoint, 0 <= enter <= leave; the last leave may be INFINITY.
 * No intersection is 0 pairs. Where there are more pairs than room, nothing beyond the room is
 * written, and the number of all is returned: the same question is then asked again with as much
 * room; more than 16, and 4 for each leaf of the solid, are refused. Or it returns
 * RAYCERT_UNSUPPORTED or RAYCERT_ERROR.
 *
 * A tracer whose hello says "answers": "first" writes the one number t to out[0] and returns 1, or
 * returns 0 for a miss. With "answers": "any" it returns 1 for a hit and 0 for none, and writes
 * nothing.
 */
RAYCERT_EXPORT int raycert_intersect(const int32_t *solid, int32_t words, const double *numbers,
                                     int32_t count, const double origin[3],
                                     const double direction[3], double *out, int32_t capacity);

/* Optional: what the tracer declares, the hello of the line protocol, such as
 * {"hello": 1, "name": "my tracer", "solids": ["sphere", "cylinder"], "precision": "binary32"}.
 * `numbers` has no meaning here. Without it, it is a closed binary64 tracer of every solid that
 * answers with pairs. The text has to stay where it is. */
RAYCERT_EXPORT const char *raycert_hello(void);

#ifdef __cplusplus
}
#endif

#endif
