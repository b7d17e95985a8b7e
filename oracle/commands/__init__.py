"""The command line: one module a verb. Each loads what it uses when it runs, and not before.

main           the command `raycert`: its table of verbs
streams        standard streams that never fail a command
options        the options that verbs share
asking         a case by options, id or JSON
measuring      what bench and stress share
keeping        where a certificate goes, and what it may not take the place of
scenes         what render and plan share
certify        certify, report
listing        list, show
adopt          keep a found case
bench          error against run time, and what everything costs
crosscheck     the oracle against its witnesses
explain        one case, derived
export         flat TSV
field          many targets in one table
fielding       certified side by side
golden         write or check the golden files
harness        starters for a client
hunt           search for failing cases
map            what surrounds a case
plan           what a scene lets the tracer leave out
render         a scene to a PNG
serve          a built-in implementation behind the line protocol
stress         error against stiffness
zoo            the kill matrix
pytest_plugin  `pytest --raycert TARGET`
"""
