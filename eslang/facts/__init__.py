"""A small Prolog: assertions, and questions about them.

In reading order: unify, terms, relations, views, properties, watching (what is
held, who reads it, and who hears of it); goals, shapes, nested, patterns (what is
asked); rules, transitive, steps, procs (how an answer is found); source,
tables, answers, walks, functions (the Python that finds it); journal, store, plans,
explain, query (the database as a whole).

This room must not know what a task is, what a form means, or how Lisp is
called: what it needs of these it is handed.
"""
