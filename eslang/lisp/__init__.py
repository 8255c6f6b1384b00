"""The Common Lisp that plans are written in.

One chapter of the standard a file: conses, numbers, characters and strings,
sequences, hash tables, structures, conditions, format, streams and the rest.
What is easier said in Lisp itself stands in stdlib/.

This room must not know any construct of ESL or SCS.
"""
