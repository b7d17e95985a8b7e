"""Error against stiffness: one parameter is swept by decades, all methods answer.

`sweeps` says what is swept and makes the rays (`aims`, `touching`), `measure` judges answers,
`ranges` reads the curves, `remedies` and `causes` tell why a method breaks, `run` does it all.
"""
