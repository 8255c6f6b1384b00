"""ESL, the Execution Support Language.

In reading order: contingency (ESL §2), goals (ESL §3). The other sections of
the paper get a file each when their turn comes.

This room must not know SCS, nor any device.
"""
