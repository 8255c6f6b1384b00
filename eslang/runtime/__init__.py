"""Tasks and control: what happens while a plan runs.

In reading order: hooks (what the kernel tells whoever listens), clock, timers,
the one random source, story (where something happened), events, logical, failures with
the recovery procedures that answer them, ticks, tasks, lives (how a task begins
and ends), polls, idling, scheduler (whose turn it is), nets, guarding and periods (what the
constructs are made of), deadlock, gate (whether it is at work, and in which thread), runs
(what is entered from outside), visits (what is done without a run), choices (who has the
turn), resources, property locks: attempts, claims, locks, maintenance; and what an agent is
to achieve: agenda, pursuit.

This room must not know any syntax, and it prints nothing: listeners do.
"""
