"""Which cases an implementation gets wrong, beyond the golden ones, made simple.

    moves      from one case to others that are harder: walks to where the exact answer changes
    look       is an answer wrong on the level asked; what tells two failures apart
    session    a target that stays open for batch after batch, whatever it does
    unit       a piece of work: so many cases of a seed, by its number alone; the ledger of results
    pursuit    how a unit searches: cases moved to where errors are larger; Hypothesis
    executors  where units run: here, in processes, on a cluster
    shrink     what simpler means; from a failing case to the simplest that fails in the same way
    search     the whole: units out, failures in, shrunk and told apart
    keep       findings as golden rows in a directory that `certify --golden` replays

The oracle's answers are the truth throughout; the search may use any number it likes.
"""
