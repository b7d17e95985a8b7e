"""The questions: rays, solids, and why each is asked; nothing here knows an exact answer.

Symbols, fixed once and used everywhere:

    u, v    origin and direction of the ray f(t) = u + t v, t >= 0; v is never normalised
    p, q    the ends of a cylinder's axis; w = q - p
    y       u - p
    r       radius
    t       the ray's own parameter, in units of |v|

A solid is a closed set. The answer is the list of pairs [(enter, leave), ...]: the maximal
closed intervals of t >= 0 for which f(t) is in the solid. Every number is a binary64 (or a
binary32) and is taken as exactly the number it is; -0 is 0.

    model       rays and solids that refuse what they cannot mean
    formats     binary64 and binary32, and how a number is spelled
    vectors     three numbers as a vector
    numbers     a ray and a solid as a list of numbers, neighbours on the grid of a format
    forms       rays and solids as JSON objects, and the line that asks about them
    domain      what an implementation is for, and how exact it is: lengths, distances, shapes
    protocol    the messages of the line protocol, and the implementation's side of it
    scene       solids, a camera and a size, and the ray of each pixel
    table       the three tables of the case analysis, as data
    levels      tiers and levels
    degenerate  inputs that have lost a dimension
    flags       what is hard in a case, and where to read of it
    case        a case, and a family of them
    accept      answers between an inner and an outer list of numbers
    hints       what a message says to do: names that come near, packages to install
    files       the files that somebody gives, read
    row         a golden row and its JSON form
    corpus      the golden files and their manifest
    interrupts  signals that end a run: where they are taken, where they wait
    workers     processes of ours that work side by side, and end with us
    lattice     where every sound formula decides a touch exactly
    families    the golden cases, as tables of shots
    dice        deterministic random numbers
    recipes     hard numbers, and scenes made of picks from them
    draw        fresh cases of a seed
    strategies  the same for Hypothesis
"""
