"""Witnesses: other roads to the same interval list, so that nobody has to take the oracle's word.

    definition   membership of points and gaps, straight from the definition of each solid
    enclosure    the seed's published formulas, in interval arithmetic
    symbols      polynomials that SymPy derives, and their isolated real roots
    meshes       inscribed and circumscribed prisms under a mesh caster

A witness shares with the oracle the model of the questions and the type of its answers; never the
row logic, the integer forms of the leaves or the algebra of intervals.
"""
