"""The reports of a run: each a pure function from the certificate to text.

`text` and `reading` say once what every report shows; `junit`, `markdown` and `page` are the
forms; `scene`, `numberline` and `svg` draw the page's pictures; `write` is the list of forms. What
a client said of itself is hostile until `text.clean` has seen it.
"""
