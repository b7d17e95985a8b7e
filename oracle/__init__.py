"""The exact answers, and the judgement of others. Exact and slow; no float decides anything here.

Inputs are dyadic, so everything is integers and one power of two. Three outcomes: an answer, a
refusal with its reason (`cases.model.Refused`), "undecided" from a witness; undecided is never a
miss and never agreement.
"""
