"""Other roads to the same interval list, so that nobody has to take the oracle's word.

    testimony   what a witness is, what it says, and which there are
    algebra     what they share: vectors over any numbers, and sets of t as bits
    definition  witness: membership of points and gaps, straight from the definition of each solid
    enclosure   witness: the derivation's formulas, in interval arithmetic
    symbols     witness: polynomials that SymPy derives, and their isolated real roots
    proofs      what SymPy proves of the formulas and of the case tables
    meshes      witness: inscribed and circumscribed prisms under a mesh caster
    placement   the ray in the coordinates of a leaf, where the leaf is a unit body
    bodies      prisms and balls of triangles, and one cast at them
    sandwich    two lists around the true one
    manifold    the bodies themselves, combined by Manifold
    crosscheck  the oracle against its witnesses: the loop over cases, and the count

A witness shares with the oracle the model of the questions and the type of its answers; never the
row logic, the integer forms of the leaves or the algebra of intervals.
"""
