"""What surrounds a case: two directions in the space of its inputs, sampled cell by cell.

raster    inputs by their paths, directions of them; how far each cell moves, on which grid
sampling  every cell answered, exactly and by an implementation; what lies between two forms
legend    what is said of a map: classes, curves, the words for them; JSON and CSV
"""
