"""How far an answer is right, by faces moved until it is, and which level that reaches.

moved     the same solid with every face moved: the lists that sandwich an answer
backward  the least k that accepts an answer: proposed in doubles, proved in integers
levels    the judge: the errors of a list, and what each level asks
decisive  which levels a case can decide
answer    an interval list, a first hit, a yes or no, and how each is judged
pixels    the backward error of every pixel of a picture
"""
