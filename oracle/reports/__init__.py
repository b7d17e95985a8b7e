"""The certificate as people and machines read it: each report is a function from it to text.

foreign     the text of others, as it may be shown: on terminals, in Markdown, XML and pages
screen      what tables and colours are printed on
inputs      the numbers of a case, in decimal, as code, and in hex
reading     what a certificate says, said once for every report
findings    what was found beside the verdict: domains, likely faults, kinds of failures
terminal    the certificate on a terminal
markdown    the certificate for the summary of a CI job
junit       the certificate as JUnit XML
page        the certificate as one HTML page, and the list of all forms
gradebook   how many targets fare, as JSON, and its words
gradetable  the same on a terminal, as Markdown and as a page
picture     the pictures of one case
bounds      the domains of a type of solid, declared and measured, as a picture and in words
section     a ray and a solid in a plane: what to look at, from where, and how large
"""
