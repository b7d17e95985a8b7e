"""The picture around a case: two directions in the space of its inputs, sampled cell by cell.

inputs    inputs by their paths, directions of them, the case with other numbers
plan      what the cells are: how far each one moves, on the grid of the numbers or in units
topology  the form of an exact answer, and what lies between two of them
cells     every cell answered, exactly and by an implementation, and compared
legend    what is shown of a map: classes, curves, and the words for it
data      a map as JSON and as CSV
"""
