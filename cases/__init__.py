"""The questions: plain data, no geometry.

Symbols, fixed once and used everywhere:

    u, v    origin and direction of the ray f(t) = u + t v, t >= 0; v is never normalised
    p, q    the ends of a cylinder's axis; w = q - p
    y       u - p
    r       radius
    t       the ray's own parameter, in units of |v|

A solid is a closed set. The answer is the list of pairs [(enter, leave), ...]: the maximal
closed intervals of t >= 0 for which f(t) is in the solid. Every number is a binary64 (or a
binary32) and is taken as exactly the number it is; -0 is 0.
"""
