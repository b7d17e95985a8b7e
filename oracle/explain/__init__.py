"""Why an answer is what it is: one case derived step by step, as data, as text and as a page.

wording      passages made of lines; how exact numbers are worded in them
leaf_steps   Problems 1 to 3 with the numbers of one leaf
derive       the whole derivation: leaves, lists, ends, measures; a golden row as it stands
console      derivations, golden rows and proofs on the terminal
casepicture  the pictures: two views, and a close look at each end
casepage     the page: pictures, answers of implementations asked that case alone, derivation
"""
