"""The compact tracer for arrays of rays: the same operations in the same order, the same bits.

Lane by lane an answer is that of `reference.tracer.intersect`, to the bit, infinities and touches
included; what may differ inside is only the sign of a zero. So whatever is promised of the scalar
tracer holds here, and the scalar one is the one to read.

    vectors     three arrays; an array of length 1 stands for all lanes, None for a zero
    norms       |a| as `math.hypot` has it
    lists       interval lists of many lanes, and their algebra
    quadratic   Problem 1, textbook the same as schoolbooks have it
    solids      every leaf, and trees
    rays        the rays of a camera, in tiles
    bounds      which tile cannot meet which part
    plan        what a scene lets leave out, by name, each to be switched off
    tracer      rays in, lists out: blocks, so memory is bounded
    picture     depth, normal, thickness and count of each pixel
    measure     what each item of a plan is worth; cost against the number of solids

`python -m raycert.reference.arrays` renders a scene given on standard input.
"""
