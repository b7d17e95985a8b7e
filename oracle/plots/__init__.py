"""Plots for people: from rows of figures to SVG and PNG, the same bytes for the same rows.

style      fonts, greys, marks and lines; how a plot is written
pareto     error against run time
stiffness  error against stiffness
standing   where one implementation sits in both
mapping    the picture around a case
heatmap    values of a scene, pixel by pixel
"""
