"""The oracle's rounded answers for arrays of rays: each lane proved, or answered in integers.

Rungs, and what each may decide: float64 topology; double-double values and their rounding;
rational exact ties, zeros and touches; integers the scalar oracle, for whatever is left. Every
step carries a bound on its error, derived in `bounds`; what a bound cannot decide climbs on.
"""
