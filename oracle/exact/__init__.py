"""Where a ray is inside a solid, exactly: in integers, and no float decides anything.

grid        a scene in integers: one unit for lengths, another for the direction
leaf        each leaf as conditions on t, with integer coefficients
surd        the numbers (x + y sqrt(d)) / z: their total order, roundings and decimals
intervals   lists of intervals and their algebra; the list in numbers of a format
trace       the answer: leaves by the rows of the case table, Booleans by the algebra
faces       where an endpoint lies, and whether an interval only touches
condition   how far an endpoint moves when the inputs do
"""
