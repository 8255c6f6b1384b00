"""What `esl check` says of relations; the wording of each diagnostic is in tests/diagnostics."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest

from eslang import Interpreter

STRICT = "(defrelation link (from to)) (defproperty power (device state))"


@pytest.fixture(name="folder")
def fixture_folder(tmp_path: Path) -> Path:
    return tmp_path


def found(folder: Path, *texts: str) -> list[tuple[str, str]]:
    """What is said of a program of these TEXTS, a file each: names, and the text at each place."""
    paths = []
    for number, text in enumerate(texts):
        path = folder / f"{number}.esl"
        path.write_text(text, encoding="utf-8")
        paths.append(path)
    with Interpreter(output=StringIO()) as interp:
        diagnostics = interp.check(paths)
    spans = [each.labels[0].span for each in diagnostics]
    parts = [span.source.line(span.line)[span.column - 1 : span.end_column - 1] for span in spans]
    return [(each.name, part) for each, part in zip(diagnostics, parts, strict=True)]


QUIET = {
    "a query of what is asserted": "(assert '(on a)) (db-query '(on ?x))",
    "a query of what is derived": "(defrule (on ?x) (of ?x)) (assert '(of a)) (db-query '(on ?x))",
    "a query of what is declared": "(defrelation on) (db-query '(on ?x)) (db-query '(on ?x ?y))",
    "a query of what is asserted later, in a function": (
        "(db-query '(on ?x)) (defun put (x) (assert (list 'on x)))"
    ),
    "a fact that a backquote makes": "(defun put (x) (assert `(on ,x))) (db-query '(on ?x))",
    "a fact of which only the beginning shows": (
        "(defun put (more) (assert (cons 'on more)) (assert `(of ,@more))) (db-query '(or (on ?x) (of 1 2)))"
    ),
    "facts that are computed": "(defun put (fact) (assert fact)) (db-query '(on ?x))",
    "facts that a function of functions asserts": "(mapc #'assert (list)) (db-query '(on ?x))",
    "facts from a file": '(load-facts "world.facts") (db-query \'(on ?x))',
    "a fact that an update brings": "(update '(on ?x) '(on 3)) (db-query '(on ?x))",
    "words of the language, which devices assert": "(wait-until (power-state ega_x :on))",
    "a property is no promise to declare everything": "(defproperty on) (assert '(of a)) (db-query '(of ?x))",
    "a variable in a backquoted query": "(assert '(on 1)) (defun f (x) (wait-until `(on ,x)))",
    "a word in a quoted query": "(assert '(on lamp)) (defun f (lamp) (wait-until '(on lamp)) lamp)",
    "a variable in a call": "(assert '(on 1)) (defun f (x) (wait-until (and (on ?y) (> ?y x) (oddp x))))",
    "a variable in a marked place": (
        "(assert '(on 1)) (defun f (x) (with-query-bindings '(on ?x) (wait-until (on #?x))) x)"
    ),
    "a macro in a condition": "(assert '(on 1)) (wait-until (and (on ?x) (when (> ?x 0) t)))",
    "tests in a query": "(assert '(on 1)) (db-query '(and (on ?x) (oddp ?x) (> (+ ?x 1) 1)))",
    "a condition that is a call": "(defvar *up* nil) (wait-until (eq *up* t))",
    "a condition whose arguments are names": "(assert '(on lamp)) (wait-until (on lamp))",
    "a relation and its call in one condition": "(assert '(on 1)) (wait-until (and (on ?x) (oddp ?x)))",
    "a goal that only methods know": "(to-achieve (lit ?room) (t (print #?room)))",
    "bindings that are inherited": (
        """(assert '(on 1)) (with-query-bindings '(on ?x)
             (with-query-bindings '(and (on ?y) (< ?x ?y)) :inherit-bindings (print #?y)))"""
    ),
    "values of bindings in a query": (
        "(assert '(on 1)) (with-query-bindings '(on ?x) (db-query '(and (on ?y) (not (< #?x ?y)))))"
    ),
    "a rule that needs its argument": (
        "(defrule (big ?x) (> ?x 3)) (assert '(on 1)) (db-query '(and (on ?x) (big ?x)))"
    ),
    "negation that is stratified": (
        "(assert '(on 1)) (defrule (off ?x) (of ?x) (not (on ?x))) (assert '(of 1))"
    ),
    "a relation that all its uses agree on": STRICT + "(assert '(link a b)) (wait-until (link a ?x))",
}
SAID = {
    "a query of what nothing asserts": ("(db-query '(on ?x))", [("unknown-relation", "on")]),
    "a variable in a query that is a condition": (
        "(assert '(on 1)) (defun f (x) (wait-until (on x)) (achieve (and (not (on x)) (on (lamp x)))))",
        [("variable-in-query", "x"), ("variable-in-query", "x"), ("variable-in-query", "x")],
    ),
    "a property that nothing asserts": (
        "(assert '(power b :on)) (defun f () (with-maintained-properties ((power b :on) (powr b :on)) 1))",
        [("unknown-relation", "powr")],
    ),
    "a property of another length than declared": (
        "(defproperty power (device state)) (defun f () (with-maintained-properties (power :on) 1))",
        [("wrong-number-of-arguments", "power")],
    ),
    "a variable in a property that is maintained": (
        "(defproperty on (what)) (defun f (x) (with-maintained-properties ((on x) `(on ,x)) 1))",
        [("variable-in-query", "x")],
    ),
    "a fact that is not quoted, once": ("(assert (on lamp ?x))", [("unknown-function", "on")]),
    "a query that is not quoted, once": (
        "(assert '(on lamp)) (with-query-bindings (on ?x) (db-query (on ?x)) #?x)",
        [("unknown-function", "on"), ("unknown-function", "on")],
    ),
    "a macro that is meant as a test": (
        "(assert '(on 1)) (db-query '(and (on ?x) (when (> ?x 0) t)))",
        [("unknown-relation", "when")],
    ),
    "what is retracted is asked for": ("(retract '(on ?x))", [("unknown-relation", "on")]),
    "a relation in a rule": (
        "(assert '(of a)) (defrule (on ?x) (or (of ?x) (oof ?x)))",
        [("unknown-relation", "oof")],
    ),
    "deep in a condition": (
        "(assert '(on a)) (whenever (and (on ?x) (not (onn ?x))) (print #?x))",
        [("unknown-relation", "onn")],
    ),
    "what an ACHIEVE asks": ("(defun f () (achieve (onn a)))", [("unknown-relation", "onn")]),
    "another number of arguments than all facts have": (
        "(assert '(on a)) (defun f () (db-query '(on ?x ?y)))",
        [("unknown-relation", "on")],
    ),
    "a misspelt function in a condition, though facts are computed": (
        "(defun ready? () t) (defun f (x) (assert x) (wait-until (redy?)))",
        [("unknown-relation", "redy?")],
    ),
    "an unknown relation where facts are loaded, once relations are declared": (
        STRICT + '(load-facts "f") (db-query \'(lnk ?x ?y))',
        [("unknown-relation", "lnk")],
    ),
    "what is not declared is told once": (
        STRICT + "(assert '(on a)) (assert '(on b)) (db-query '(on ?x))",
        [("undeclared-relation", "on")],
    ),
    "the arguments of what is declared": (
        STRICT + "(assert '(link a)) (defrule (power ?x) (link ?x ?y)) (wait-until (power a b c))",
        [(n, s) for n in ["wrong-number-of-arguments"] for s in ("link", "power", "power")],
    ),
    "a goal with other arguments than are declared": (
        STRICT + "(to-achieve (power ?x) (t (print 1)))",
        [("wrong-number-of-arguments", "power")],
    ),
    "two ways to declare a relation": (
        "(defrelation on 1) (defrelation on (a b)) (db-query '(on 1)) (db-query '(on 1 2 3))",
        [("wrong-number-of-arguments", "on")],
    ),
    "a function of the same name": (
        "(defun on (x) x) (assert '(on a))",
        [("relation-and-function", "on")],
    ),
    "a macro of the same name": (
        "(defmacro on (x) x) (defrelation on)",
        [("relation-and-function", "defrelation")],
    ),
    "a variable that only a test knows": (
        "(assert '(on 1)) (wait-until (and (on ?x) (> ?y 1)))",
        [("unsafe-query", "(> ?y 1)")],
    ),
    "a rule that no query can ask": (
        "(assert '(on 1)) (defrule (odd ?x) (on ?x) (not (= ?x ?y)))",
        [("unsafe-query", "(not (= ?x ?y))")],
    ),
    "a rule that no query can ask is told once": (
        "(assert '(on 1)) (defrule (odd ?x) (on ?x) (not (= ?x ?y))) (db-query '(odd ?x))",
        [("unsafe-query", "(not (= ?x ?y))")],
    ),
    "declared arguments count, though not all facts show theirs": (
        STRICT + "(defun f (x) (assert (cons 'link x)) (db-query '(link ?x)))",
        [("wrong-number-of-arguments", "link")],
    ),
    "a rule whose head nothing binds, asked for all": (
        "(assert '(on 1)) (defrule (any ?x) (on 1)) (db-query '(any ?x))",
        [("unsafe-query", "(any ?x)")],
    ),
    "a rule about its own absence": (
        "(assert '(on 1)) (defrule (off ?x) (on ?x) (not (off ?x)))",
        [("unstratified-rules", "(off ?x)")],
    ),
}


@pytest.mark.parametrize("name", QUIET)
def test_nothing_is_said_of(name: str, folder: Path) -> None:
    assert found(folder, QUIET[name]) == []


@pytest.mark.parametrize("name", SAID)
def test_it_is_told(name: str, folder: Path) -> None:
    text, expected = SAID[name]
    assert found(folder, text) == expected


def test_a_program_of_several_files_is_one(folder: Path) -> None:
    assert found(folder, "(db-query '(on ?x))", "(defun put () (assert '(on a)))") == []


def test_what_could_not_be_analysed_may_have_asserted_facts(folder: Path) -> None:
    text = "(defun put () (assert '(on a)) (let ((1 2)) 3)) (db-query '(on ?x))"
    assert [name for name, _ in found(folder, text)] == ["malformed-binding"]


def test_calls_in_a_condition_that_is_a_query_are_not_judged(folder: Path) -> None:
    assert found(folder, "(assert '(position cup table)) (wait-until (position cup table))") == [
        ("relation-and-function", "position")
    ]


def test_warnings_alone_do_not_make_a_program_wrong(folder: Path) -> None:
    from unit.tools.command import call

    path = folder / "plan.esl"
    path.write_text("(db-query '(on ?x))\n", encoding="utf-8")
    ended = call(["check", str(path)])
    assert (ended.code, ended.err.splitlines()[-1]) == (0, "0 errors, 1 warning")
