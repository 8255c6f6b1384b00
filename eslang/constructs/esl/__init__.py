"""ESL, the Execution Support Language.

In reading order: contingency (ESL §2) with its clauses, queries and database
(§5), conditions and goals (§3), events, checkpoints, tasks and task_nets,
guardians (§4), watching and timing (waits for conditions, and for time).

This room must not know SCS, nor any device.
"""
