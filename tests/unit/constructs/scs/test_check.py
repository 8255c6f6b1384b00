"""What `esl check` says of programs of SCS; the wording of each diagnostic is in tests/diagnostics."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest

from eslang import Interpreter


def found(folder: Path, text: str) -> list[tuple[str, str]]:
    """What is said of the program TEXT: names, and the text at each place."""
    path = folder / "plan.esl"
    path.write_text(text, encoding="utf-8")
    with Interpreter(output=StringIO()) as interp:
        diagnostics = interp.check([path])
    spans = [each.labels[0].span for each in diagnostics]
    parts = [span.source.line(span.line)[span.column - 1 : span.end_column - 1] for span in spans]
    return [(each.name, part) for each, part in zip(diagnostics, parts, strict=True)]


QUIET = {
    "actions and steps, also before they are defined": (
        "(defstep tidy (room) (sweep room) (dust)) (defaction sweep (room) room) (defstep dust () 1) (tidy 1)"
    ),
    "steps that call themselves": "(defstep down (n) (if (> n 0) (down (1- n)) :bottom)) (down 3)",
    "conditions that the program's facts may meet": (
        """(assert '(at cup shelf)) (defproperty door (state)) (defvar *up* nil)
           (defun f () (do-first :while (door :open) :until *up* ((at cup ?where) (print #?where)) (t 1)))"""
    ),
    "a condition under a backquote": (
        "(assert '(at cup shelf)) (defstep fetch (thing) (do-first (`(at ,thing ?where) #?where)))"
    ),
    "variables of a condition in a utility": (
        "(assert '(near cup 3)) (defun f () (do-best :learn t ((near ?what ?far) (- #?far) (print #?what))))"
    ),
    "what was learned": "(defun learned () (db-query '(scs::discount ?action ?factor)))",
    "a test among the patterns of a condition": (
        "(assert '(level 3)) (defun f () (repeat :while (and (level ?l) (< ?l 5)) (print #?l)))"
    ),
    "a local function as a step": "(defun f () (flet ((grip () 1)) (scs:do (grip))))",
    "Common Lisp's DO beside that of SCS": "(do ((i 0 (1+ i))) ((= i 3)) (scs:do (princ i)))",
    "DO in a package of SCS": "(in-package :scs-user) (do :when t (princ 1) (do* (princ 2)))",
    "a goal that the program's facts may meet": "(assert '(at dock)) (add-goal (achieve (at dock)))",
}
SAID = {
    "conditions that nothing can meet, wherever they stand": (
        """(assert '(at cup))
           (defun f ()
             (do-first ((att cup) 1)
                       ((at cup) (repeat :until (bt 1) 1)))
             (do-best :unless (ct 1) ((dt 1) 2 3))
             (with-cycle (2) :when (and (at cup) (not (et 1))) 1)
             (do-all :while '(ft 1) (do-any :while `(gt ,(f)) 1)))""",
        [("unknown-relation", f"{letter}t") for letter in ("at", *"bcdefg")],
    ),
    "a condition with another number of arguments": (
        "(defproperty door (state)) (defun f () (do-first ((door front :open) 1)))",
        [("wrong-number-of-arguments", "door")],
    ),
    "a variable that stands for itself in a condition": (
        "(assert '(at cup)) (defstep fetch (thing) (do-first ((at thing) 1)))",
        [("variable-in-query", "thing")],
    ),
    "an action with too few arguments": (
        "(defaction move (from to) (list from to)) (defun f () (scs:do (move 1)))",
        [("wrong-number-of-arguments", "move")],
    ),
    "a step with too many arguments": (
        "(defstep tidy () 1) (defun f () (do-any (tidy :hall)))",
        [("wrong-number-of-arguments", "tidy")],
    ),
    "a step that there is not": (
        "(defun f () (do-all (print 1) (sweeep :hall)))",
        [("unknown-function", "sweeep")],
    ),
    "a utility that there is not": (
        "(defun f () (do-best (t (worth 1) 2)))",
        [("unknown-function", "worth")],
    ),
    "a logic variable without its mark": (
        "(assert '(at cup)) (defun f () (do-first ((at ?what) (print ?what))))",
        [("unknown-variable", "?what")],
    ),
    "a variable of a condition that no pattern gives a value": (
        "(assert '(at 1)) (defun f () (do-first ((and (at ?x) (< ?y 3)) 1)))",
        [("unsafe-query", "(< ?y 3)")],
    ),
    "a modifier that there is not": (
        "(defun f () (do-all :unles (at cup) 1))",
        [("malformed-step", ":unles")],
    ),
    "goals that nothing can meet": (
        """(assert '(at dock))
           (defun f (x)
             (add-goal (achieve (att dock)))
             (add-goal '(achieve (bt dock)))
             (add-goal `(maintain (ct ,x)))
             (drop-goal (achieve (dt dock))))""",
        [("unknown-relation", f"{letter}t") for letter in ("at", *"bcd")],
    ),
}


@pytest.mark.parametrize("text", QUIET.values(), ids=QUIET)
def test_nothing_is_said_of(text: str, tmp_path: Path) -> None:
    assert found(tmp_path, text) == []


@pytest.mark.parametrize(("text", "said"), SAID.values(), ids=SAID)
def test_what_is_said_of(text: str, said: list[tuple[str, str]], tmp_path: Path) -> None:
    assert found(tmp_path, text) == said
