"""What everything is made of; imports nothing of ours from a higher floor.

In reading order: symbols, lists, text, ratios, many (values), spans, failure, errors,
diagnostics, suggest, render (trouble, as data and as text), decoding, packages,
character_names, number_kinds, number_text, symbol_text, sharing, printer, shown (values as text),
control (jumps), image (all that one interpreter knows by name), resolve (which
symbol a name means in it), running (which interpreter is at work).

This room must not know what a form means, what a task is, or who asks.
"""
