"""The compact tracer, to read and to port: doubles and the standard `math`, nothing else.

Promise: `stable` on every tier of the corpus, for every solid. Each interval answered lies in
the solid with its faces moved outward by k u s(t), and covers the solid with its faces moved
inward as far (u = 2^-53, s(t) the size of the numbers that meet at parameter t, k a few). On
the lattice tier every touch is kept as a pair (a, a) and decided exactly: `closed`.

Limits: an endpoint is near the exact one only where the question is well conditioned; a touch
off the lattice may be answered as a near miss, or the other way about. Lengths, axis and
direction are scaled by powers of two, each by its own, so there is no overflow inside; what may
overflow is t itself, which then is infinite, also where it is an `enter`.

To port it (reference/README.md), in this order:

vectors     dot, cross, exact scaling
quadratic   Problem 1
tracer      Problems 2 and 3 and every solid
intervals   the algebra of lists, for trees only
"""
