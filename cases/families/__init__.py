"""The golden case families: what each case is, and why it is asked.

A family is a table of shots: rays at shapes in exact numbers, put somewhere by a frame that is
exact too, and rounded to the format only where the numbers have no exact place in it.

    frames          where a sketch is put
    sketch          solids in exact numbers, known lists, and the pen
    shots           the lines of a table, ladders, and the families made of them
    catalog         every family
    case_table      the rows and cells of the three tables
    touch           tangents, rims, rays in and along faces
    starts          starts inside, on and beside a face; rays at rest; zeros
    far             far, displaced, thin and tilted
    scale           very small, very large, hard to round
    lists           the algebra of lists
    bodies          trees with faces in common, in one another, of many parts
    base_rate       random rays and solids
    reports         faults of leaves reported in public
    reports_solids  faults of spheres and trees reported in public
    adopted         cases found by a search, kept as data
"""
