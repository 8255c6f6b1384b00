"""SCS, Structured Circuit Semantics.

In reading order: asking.py (conditions), stepping.py (what all constructs share),
steps.py, actions.py, parallel.py, choice.py, clauses.py, learning.py, threads.py
(SCS, Appendix C, §3); goals.py and pursuing.py (§2).

This room must not know how ESL's own constructs are made: both stand on the
same machines.
"""
