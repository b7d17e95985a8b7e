"""The golden case families: one module for each theme, listed in `catalog`.

A family is a function from a number format to cases. Scenes are drawn in exact numbers with the
axis along z (`sketch`), put somewhere by a frame that is exact too (`frames`), and rounded to
the format only where the numbers have no exact place in it.
"""
