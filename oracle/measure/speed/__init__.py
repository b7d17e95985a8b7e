"""What speed there is, as ratios of one run: processor seconds, one thread, the same rays.

clock       ways taken in turn, the least time of each
certified   the batch oracle beside the naive formula in NumPy
scalar      the scalar oracle beside SymPy, mpmath and arb, a ray at a time
arb         a ladder of arb's balls, for that
libraries   the batched reference tracer beside ray casters that people use
casting     what they are asked: solids, rays, the exact hits
casters     how each of them is asked
scenes      the cost of a ray against the number of solids
run         all of it, interruptible
tables      all of it, on a terminal

No way is timed without its answers being looked at: speed with wrong answers is not speed.
"""
