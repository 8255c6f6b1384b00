"""The words that plans of tasks are made of, and what may be mentioned where."""

from __future__ import annotations

from random import Random
from typing import NamedTuple

EVENTS = ("*e1*", "*e2*", "*e3*")
VARIABLES = ("*v1*", "*v2*")
CAUSES = (":x1", ":x2", ":x3")
ANSWERED = (*CAUSES, ":general-failure", ":deadlock", ":deadline-expired", ":timeout", ":error")
SECONDS = ("0", "0.25", "0.5", "1", "2")  # sums of these are exact

PREAMBLE = """
(defevent *e1*) (defevent *e2*) (defevent *e3*)
(defvar *v1* 0) (defvar *v2* 0)
(defvar *d* 0)
(defvar *entrances* 0)
(defstruct (shown (:print-function show-shown)) value)
(defun show-shown (object stream depth)
  (declare (ignore depth))
  (yield) (note :shown) (princ (shown-value object) stream))
(defmacro slowly (form) (yield) `(progn (note :slowly) ,form))
(defun here (number) (unless (= *d* number) (note :wrong-binding number *d*)))
(defmacro cleaned (cleanup &body body)
  (let ((number (gensym "NUMBER")))
    `(let ((,number (incf *entrances*)))
       (with-cleanup-procedure (progn (note :clean ,number) ,cleanup)
         (note :enter ,number)
         (prog1 (progn ,@body) (note :leave ,number))))))
(defmacro protected (form &body cleanup)
  (let ((number (gensym "NUMBER")))
    `(let ((,number (incf *entrances*)))
       (unwind-protect (progn (note :enter-protected ,number) ,form)
         (note :clean-protected ,number)
         ,@cleanup))))
"""


class Scope(NamedTuple):
    """What a plan may mention at one place."""

    tasks: tuple[str, ...] = ("*main*",)
    blocks: tuple[str, ...] = ()
    catches: tuple[str, ...] = ()
    recovering: bool = False  # inside a recovery procedure, in the text


class Words:
    """Writes a plan, choosing by CHANCE."""

    def __init__(self, chance: Random, *, jumps: bool = True) -> None:
        self.chance = chance
        self.jumps = jumps
        self.count = 0

    def fresh(self, prefix: str) -> str:
        """A new name."""
        self.count += 1
        return f"{prefix}{self.count}"

    def number(self) -> str:
        """A small number."""
        return str(self.chance.randrange(3))

    def one(self, *choices: str) -> str:
        """One of CHOICES."""
        return self.chance.choice(choices)

    def perhaps(self, text: str) -> str:
        """TEXT, or nothing."""
        return text if self.chance.randrange(2) else ""

    def note(self) -> str:
        """A form that leaves a trace of its own."""
        self.count += 1
        return f"(note {self.count})"
