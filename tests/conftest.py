"""One Hypothesis profile for all tests: a loaded machine is not a failure."""

from hypothesis import settings

settings.register_profile("raycert", deadline=None)
settings.load_profile("raycert")
