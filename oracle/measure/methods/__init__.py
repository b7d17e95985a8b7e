"""Ways to answer the same rays, exact and not: what error is set against run time and stiffness.

    method         what a way to answer is: a name, a sentence, a function from cases to lists
    scalar         formulas over any arithmetic, one ray at a time, and the trees above them
    formulas       the quadratics: textbook, seed, local frame, determinant, q-root, shift
    arithmetics    doubles, mpmath, its intervals, SymPy
    vector         the textbook formula in arrays: float32, float64, long double, double-double
    casters        prisms of n sides under trimesh's own caster and under Embree
    programs       the oracle, the reference tracer and clients, scalar and batched
    catalog        all of them by name

None of it is ever a truth, and the libraries are loaded when a method is first asked.
"""
