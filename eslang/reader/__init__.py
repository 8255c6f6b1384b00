"""Text becomes forms, each with the place where it stands.

In reading order: the grammar (esl.lark), what a token means, the reader that
gives one top-level form at a time, and the mistakes it can explain.

This room must not know what a form means: no macro, no construct, no task.
"""
