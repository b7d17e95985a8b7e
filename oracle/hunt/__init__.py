"""The search for cases that an implementation gets wrong: beyond the golden ones, and made simple.

    probe      a case as a row of numbers: neighbours, what lies between two, what is usual
    look       is an answer wrong on the level asked; cheap for the many that are right
    session    a target that stays open for batch after batch, whatever it does
    placed     the same probe elsewhere, and in another size
    moves      from one case to others that are harder: walks to where the exact answer changes
    directed   the search that moves cases and keeps those with the largest errors
    drawn      the search that Hypothesis drives
    unit       a piece of work: so many cases of a seed, by its number alone
    ledger     the results of units, each counted once, in the order of their numbers
    executors  where units run: here, in processes, on a cluster (cluster)
    simple     what simpler means, and the simpler cases next to one
    shrink     from a failing case to the simplest that fails in the same way
    cause      what tells two failures apart
    search     the whole: units out, failures in, shrunk and told apart
    keep       findings as golden rows in a directory that `certify --golden` replays
    campaign   the hunt tried on every planted fault of the zoo (served)

The oracle's answers are the truth throughout; the search may use any number it likes.
"""
