"""Error against run time: the same rays for all methods, in one run.

scenarios   the rays, by name and seed
shapes      the solids and points that they are made of
errors      how far each answer is from the exact one, forward and backward
timing      time per ray, interleaved
rows        one row per method: figures, JSON, CSV
run         all of it, interruptible
commands    whole commands of raycert, timed
"""
