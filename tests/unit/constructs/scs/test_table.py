"""The table of SCS (docs/reference/scs-table.md): every cell is run, under several seeds."""

from __future__ import annotations

import re

import pytest

from support import ROOT, run

PAGE = ROOT / "docs" / "reference" / "scs-table.md"
ROW = re.compile(r"^\| `([^`]+)` \|(.+)\|$", re.M)
COLUMNS = (
    *("all succeed", "one fails", "all fail", "one is deactivated", "all are deactivated"),
    *("when is false", "while becomes false"),
)
CELLS = [
    (name, column, cell.strip())
    for name, cells in ROW.findall(PAGE.read_text(encoding="utf-8"))
    for column, cell in zip(COLUMNS, cells.split("|"), strict=True)
]
STEPS = {
    "all succeed": ("(good)", "(good)", "(good)"),
    "one fails": ("(bad)", "(good)", "(good)"),
    "all fail": ("(bad)", "(bad)", "(bad)"),
    "one is deactivated": ("(off)", "(good)", "(good)"),
    "all are deactivated": ("(off)", "(off)", "(off)"),
    "when is false": ("(good)", "(good)", "(good)"),
    "while becomes false": ("(until-late)", "(until-late)", "(until-late)"),
}
WORDS = """
(defvar *fails* 0) (defvar *bad* 0) (defvar *done* 0) (defvar *up* t)
(defaction good () (incf *done*) :good)
(defaction bad () (incf *bad*) (if (<= *bad* *fails*) (fail :bad) :better))
(defstep off () :when nil (incf *done*))
(defstep until-late () (repeat (if (= (incf *done*) 7) (setq *up* nil))))
"""


def steps_of(name: str, column: str) -> str:
    """The steps of the construct NAME in that COLUMN, with conditions and utilities where it has them."""
    steps = list(STEPS[column])
    if "first" in name:
        return " ".join(f"(t {step})" for step in steps)
    if "best" in name:
        return " ".join(f"(t {9 - number} {step})" for number, step in enumerate(steps))
    return " ".join(steps)


def came_of(name: str, column: str, fails: int, seed: int) -> tuple[str, int, int]:
    """What becomes of the construct; how many of its good steps were done, and how many bad ones tried."""
    modifiers = {"when is false": ":when nil", "while becomes false": ":while *up*"}.get(column, "")
    if "repeat" in name and column not in ("when is false", "while becomes false"):
        modifiers = ":until (>= (+ *done* *bad* (incf *turns*)) 30)"
    form = f"({name} {modifiers} {steps_of(name, column)})"
    text = f"""{WORDS} (setq *fails* {fails}) (defvar *turns* 0)
    (print (with-recovery-procedures ((:bad (abort :fails))
                                      ((:all-subtasks-failed l) (abort (if (= (length l) 3) :fails l))))
             {form}))
    (print *done*) (print *bad*)"""
    came = run(text, seed=seed)
    assert came.failure is None and came.error is None, (form, came.failure, came.error)
    outcome, done, bad = came.output.split()
    return outcome, int(done), int(bad)


@pytest.mark.parametrize(("name", "column", "expected"), CELLS, ids=[f"{a} {b}" for a, b, _ in CELLS])
def test_a_cell_of_the_table(name: str, column: str, expected: str) -> None:
    for seed in range(5):
        fails = 4 if expected == "retries" else 1000
        outcome, done, bad = came_of(name, column, fails, seed)
        if expected == "fails":
            assert outcome == ":FAILS"
        elif expected == "deactivated":
            assert outcome == ":DEACTIVATED"
        elif expected == "retries":
            assert outcome != ":FAILS" and bad > 4
        elif expected == "repeats":
            assert outcome == ":DEACTIVATED" and (done > 3 or "deactivated" in column)
        else:
            assert outcome not in (":FAILS", ":DEACTIVATED")
        if column == "when is false":
            assert done == 0


def test_the_table_has_every_construct_and_column() -> None:
    assert len(CELLS) == 12 * len(COLUMNS)
