"""What the oracle rounds for arrays of rays: each lane proved, or answered in integers.

Rungs, and what each may decide: float64 topology; double-double values and their rounding;
rational exact ties, zeros and touches; integers the scalar oracle, for whatever is left. Every
step carries a bound on its error, derived in `formulas`; what a bound cannot decide climbs on.

    arithmetic  double-double arithmetic without branches, each operation with its bound
    formulas    what decides a lane, and the bounds on every rounding error
    decide      from the formulas to a lane's state and endpoints
    constants   a leaf prepared: its constants, exact or bounded
    lanes       rays in the units of a leaf, and the two fast rungs in NumPy
    chunks      the same rungs as loops for a compiler
    compiled    the loops through numba, kept in the user's cache
    engines     which engine answers, and whether its floating point can be trusted
    rational    the rung of exact zeros
    booleans    trees of rounded lists, and binary32 without rounding twice
    blocks      `trace_batch`: all rungs, block by block
"""
