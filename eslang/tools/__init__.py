"""The doors that people use.

The command line, the prompt, the narrator that speaks the papers' trace lines,
transcripts, the checks of `esl check`, and the reference pages.

This room may know everything below; nothing below may know this room.
"""
