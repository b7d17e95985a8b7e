"""Planted wrong tracers, and sound ones that differ: whether the corpus tells them apart.

    tracer       the base tracer, a frozen dataclass of steps; and what is said of a fault of it
    surfaces     faults in Problems 1 to 3: walls, spheres, planes, rims; strict comparisons
    limits       faults of reach: starts, self-hits, scales, units, precision
    lists        faults in the algebra of lists, of the reply's form, and of what is remembered
    inhabitants  all of them, the sound tracers, and the faults that need a process of their own
    matrix       which family refuses which fault, and why; the smoke rows, which refuse the same
    textbook     the derivation's formulas as printed, a subject to look at

Nothing here is shared with `reference`, and nothing here is ever a truth.
"""
