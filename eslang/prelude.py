"""What every interpreter begins with: the registered rooms, and stdlib/.

The rooms register their functions and macros when they are imported; their
special forms are wanted only when something is compiled.
"""

from __future__ import annotations

import os

from eslang.base.hints import Iterable

LISP = [
    "predicates",
    "types",
    "subtypes",
    "coercions",
    "conses",
    "alists",
    "trees",
    "sets",
    "mapping",
    "sequences",
    "sequences_search",
    "sequences_change",
    "sequences_mapping",
    "sequences_sort",
    "hash_tables",
    "arrays",
    "vectors",
    "numbers",
    "numbers_division",
    "numbers_integers",
    "numbers_reals",
    "characters",
    "strings",
    "symbols",
    "packages",
    "streams",
    "stream_input",
    "output",
    "format",
    "reading",
    "structures",
    "places",
    "conditions",
    "defining",
    "control",
    "standard_macros",
    "loading",
    "times",
    "task_types",
]
ROOMS = [
    *(f"eslang.lisp.{name}" for name in LISP),
    "eslang.constructs.esl.contingency",
    "eslang.constructs.queries",
    "eslang.constructs.esl.database",
    "eslang.constructs.esl.saving",
    "eslang.constructs.esl.explaining",
    "eslang.constructs.conditions",
    "eslang.constructs.esl.events",
    "eslang.constructs.esl.checkpoints",
    "eslang.constructs.esl.tasks",
    "eslang.constructs.esl.task_nets",
    "eslang.constructs.scs.steps",
    "eslang.constructs.scs.learning",
    "eslang.constructs.scs.actions",
    "eslang.constructs.scs.choice",
    "eslang.constructs.scs.clauses",
    "eslang.constructs.scs.threads",
    "eslang.constructs.scs.parallel",
    "eslang.constructs.scs.goals",
    "eslang.constructs.scs.pursuing",
    "eslang.constructs.esl.guardians",
    "eslang.constructs.esl.timing",
    "eslang.constructs.esl.resources",
    "eslang.constructs.esl.goals",
    "eslang.constructs.esl.locks",
    "eslang.constructs.esl.prompt",
    "eslang.constructs.esl.doubles",
    "eslang.constructs.esl.documentation",
    "eslang.constructs.esl.quitting",
]
FILES = [
    "control",
    "places",
    "place-kinds",
    "loop-variables",
    "loop",
    "declarations",
    "types",
    "packages",
    "structures",
    "conditions",
    "tasks",
    "widgets",
    "recovery",
    "locks",
    "devices",
    "spacecraft",
    "configuration",
    "robot",
    "environments",
    "testing",
]
AT_ONCE = ("conditions", "tasks", "widgets", "devices", "testing")  # these define more than operators
LATER = tuple(name for name in FILES if name not in AT_ONCE)  # the others can wait (later.py)


def import_rooms() -> None:
    """Import every room that registers something a plan can say."""
    for name in ROOMS:
        __import__(name)


def stdlib_folder() -> str:
    """Where stdlib/ is: inside the package in a wheel, beside it in a checkout."""
    package = os.path.dirname(__file__)
    inside = os.path.join(package, "stdlib")
    return inside if os.path.isdir(inside) else os.path.join(os.path.dirname(package), "stdlib")


def stdlib_files(names: Iterable[str] = FILES) -> list[str]:
    """The files of stdlib/ of these NAMES, in the order in which they are loaded."""
    folder = stdlib_folder()
    return [os.path.join(folder, f"{name}.esl") for name in names]
