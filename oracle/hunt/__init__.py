"""Which cases an implementation gets wrong, beyond the golden ones, made simple.

    moves      from one case to harder ones, toward where the exact answer changes, or simpler ones
    look       is an answer wrong on the level asked; what tells two failures apart
    unit       so many cases of a seed, by a number alone; the target that stays open for them
    pursuit    how a unit searches: cases moved to where errors are larger; Hypothesis
    executors  where units run: here, in processes, on a cluster
    search     the whole: units out, failures in, shrunk and told apart
    keep       findings as golden rows in a directory that `certify --golden` replays

The oracle's answers are the truth throughout; the search may use any number it likes.
"""
