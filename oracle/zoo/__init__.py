"""Planted wrong tracers, and sound ones that differ: what the judge and the corpus are tried on.

    numbers   vectors over doubles, binary32 numbers or fractions
    lists     the algebra of lists of intervals
    tracer    the base tracer, a frozen dataclass of steps; every inhabitant replaces some of them
    fault     what is said of each inhabitant: what it does, where that is from, who must notice
    walls ... the faults, by the part of a tracer that they are in
    sound     tracers that are right in other ways, and what they deserve
    catalog   all of them, and the faults that need a process of their own
    matrix    which family refuses which fault, and why

Nothing here is shared with `reference`, and nothing here is ever a truth.
"""
