"""Clients to begin from, one folder a language: `raycert harness LANG --out DIR` copies one.

Each holds the whole line protocol and one marked place, `replace from here` to `to here`, for the
user's own tracer; until then a port of the reference tracer stands there, so that it is granted
`stable` as it is. `library` is a shared library instead of a program, and binds the tracer of `c`;
`readers` holds two programs that judge answers without raycert, and is no client. The folders are
data: nothing here is imported.
"""
