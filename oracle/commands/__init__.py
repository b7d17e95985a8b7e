"""The command line: one module a verb. Each loads what it uses when it runs, and not before."""
