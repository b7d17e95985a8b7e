"""The tracer for arrays of rays, and pictures by it: the scalar tracer's bits, lane by lane.

The promise of `reference` is the four files beside this folder; here the same operations are done
in the same order for many rays. An answer is that of `reference.tracer.intersect`, to the bit,
infinities and touches included; what may differ inside is only the sign of a zero.

    vectors     three arrays; an array of length 1 stands for all lanes, None for a zero; |a|
    lists       interval lists of many lanes, and their algebra
    quadratic   Problem 1, and the same as schoolbooks have it
    tracer      every leaf, and trees: rays in, lists out, in blocks, so that memory is bounded
    tiles       the rays of a camera, in tiles, and which tile cannot meet which part
    plan        what a scene lets leave out, by name, each to be switched off
    picture     depth, normal, thickness and count of each pixel

`python -m raycert.reference.arrays` renders a scene given on standard input.
"""
