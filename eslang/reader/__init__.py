"""Text becomes forms, each with the place where it stands.

In reading order: the grammar (esl.lark) and its tables, atoms (what a token
means), features, building (lists out of their parts), broken (text that is no
token), mistakes (tokens in the wrong place), and the reader, which runs the
tables and gives one top-level form at a time.

This room must not know what a form means: no macro, no construct, no task.
"""
