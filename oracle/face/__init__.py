"""Exact answers for rays and solids, and the judgement of what others answer."""
