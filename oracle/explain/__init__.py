"""Why an answer is what it is: one case derived step by step, as data, as text and as a page.

wording   passages made of lines; how exact numbers are worded in them
derive    the derivation: Problems 1 to 3, lists, ends, measures; a golden row as it stands
console   derivations, golden rows and proofs on the terminal
casepage  the page: pictures, answers of implementations asked that case alone, derivation
"""
