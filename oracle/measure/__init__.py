"""How fast and how far: ways to answer the same rays, their error against time and stiffness.

A *way* answers rays, a *set* of rays is asked, an *error* is judged, a *time* is clocked. `bench`
races ways over sets, `stress` runs ways along a sweep.

way         what a way is; the oracle, functions and clients as ways
quadratics  one quadratic in six ways, over any arithmetic
digits      mpmath, its intervals, SymPy, arb
arrays      the textbook formula in arrays of NumPy; batches
facets      prisms of n sides in place of the cylinder
catalog     all ways by name
rays        all sets of rays by name
errors      how far each answer is from the exact one, forward and backward
clock       passes in turn, the least time of each
race        ways over sets: what each costs, how wrong it is
sections    the other tables of `bench`
casters     ray casters that people use
pictures    what a scene costs the batched reference
files       rows as JSON and CSV; the machine
sweeps      one parameter by decades, and the rays of every step
ranges      what a way does at a step, and how far it holds
causes      why a way breaks
curves      ways along sweeps
"""
