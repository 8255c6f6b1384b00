"""Where syntax meets tasks: what the papers add to Lisp.

One package for each language, one file for each section of its paper: esl is
[Gat 1996] and [Gat and Pell 1998], scs is [Lee and Durfee 1995].

This room must not know who asked for the run: no prompt, no command line.
"""
