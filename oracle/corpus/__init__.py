"""The golden rows: made from families, drawn anew, adopted from what was found.

golden  from cases to rows with the exact answer in every form; write and check the files
fresh   rows drawn anew from a seed, so that nobody can tune to the files
adopt   a found case checked by every witness, named, and kept
lock    a folder that one process at a time changes
"""
