"""Which levels an implementation reaches, on which solids, and the evidence for it.

run          from a plan to a result: greet, select, ask, grade
selection    which rows are sent
grading      one row, one outcome: the levels it passes, and how far off the answer is
measured     the errors that are shown of every failure, on all cores where they are many
widest       the widest domain in which a level would be granted
verdict      levels by type of solid, conventions, and whether what was asked is granted
certificate  all of it as JSON, with the case table and the worst answers
again        failing rows asked again, each alone: whether an answer depends on those before
habits       what is done to degenerate inputs, in words
diagnosis    what the failures have in common, and where the answers belie the hello
cover        the fewest faults that explain the most failures, and what chance would explain
alike        answers compared: whether two are one but for roundings, and of what kind one is
signatures   what failing answers may have in common without a known fault
naming       how well faults are named: subjects whose faults are known, diagnosed
known        a file of known failures, and how a run compares with it
entrants     the targets of a gradebook
environment  the tool to the byte, versions and machine
"""
