"""SCS, Structured Circuit Semantics.

Its steps, choices and energizing conditions (SCS, Appendix C) will stand here.

This room must not know how ESL's own constructs are made: both stand on the
same machines.
"""
