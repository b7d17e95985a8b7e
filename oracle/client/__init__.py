"""Running an implementation: one process, the dialogue with it, the replay after a failure."""
