"""How far an answer is right, by faces moved until it is, and which level that reaches.

moved     the same solid with every face moved: the lists that sandwich an answer
levels    the judge: backward and forward error of a list, and what each level asks
answer    an interval list, a first hit, a yes or no, and how each is judged
decisive  which rows can decide a level
pixels    the backward error of every pixel of a picture
"""
