"""How far an answer is right: backward error by faces moved, and the levels that follow from it."""
