"""The exact answers, the judgement of others, and what helps to understand both.

Chapters, each importing only those above it, and raycert.cases:

exact      where a ray is inside a solid, in integers: no float decides anything
judge      how far an answer is right, and on which level
batch      the exact answers, rounded, for arrays of rays
witness    whether the oracle is right: by definition, enclosure, symbols, meshes
corpus     golden rows: written, checked, drawn anew, adopted
client     what somebody's tracer answers, whatever it is and does
zoo        wrong tracers and sound ones: what judge and corpus are tried on
certify    what a tracer is granted, why not more, and what its failures share
reports    a certificate for a terminal, as a page, Markdown, JUnit
explain    one case, step by step
hunt       cases that a tracer gets wrong, beyond the golden ones
map        what surrounds a case
measure    error against run time and against stiffness
plots      the figures
commands   the verbs of the command line; nobody imports them

Three outcomes: an answer, a refusal with its reason (`raycert.cases.model.Refused`), "undecided"
from a witness; undecided is never a miss and never agreement.
"""
