"""What of the library waits until it is wanted: names that stand for it, and what then happens."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator
from io import StringIO
from pathlib import Path

import pytest

from eslang import Failure, Interpreter
from eslang.base.many import many_of, values_list
from eslang.base.symbols import Symbol
from eslang.prelude import LATER, stdlib_files

Start = Callable[[], Interpreter]


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the compiled library."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def start(cache: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Start]:
    """What makes interpreters whose library was compiled before."""
    monkeypatch.setenv("ESLANG_CACHE", str(cache))
    made: list[Interpreter] = []

    def begin() -> Interpreter:
        made.append(Interpreter(clock="virtual", output=StringIO()))
        return made[-1]

    begin()
    yield begin
    for interp in made:
        interp.close()


def test_what_can_wait_defines_functions_and_macros_alone() -> None:
    allowed = re.compile(
        r"^\((?:defun (?!\(setf)|defmacro |scs:defaction |define-setf-expander |in-package |defvar %|$)", re.M
    )
    for path in stdlib_files(LATER):
        text = re.sub(r'"(?:[^"\\]|\\.)*"', '""', Path(path).read_text(encoding="utf-8"))
        wrong = [line for line in text.split("\n") if line.startswith("(") and not allowed.match(line)]
        assert wrong == [], path


def waits(interp: Interpreter) -> bool:
    """True if a part of the library is still to be loaded."""
    return interp.texts.later is not None


def test_a_plan_that_was_compiled_and_needs_none_of_it_loads_none_of_it(start: Start, tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(defun twice (n) (if (< n 100) (twice (* 2 n)) n)) (print (twice 3))")
    start().load(plan)
    interp = start()
    assert waits(interp)
    interp.load(plan)
    assert waits(interp)
    assert interp.call("twice", 7) == 112


def test_a_call_of_one_of_its_functions_loads_it(start: Start) -> None:
    interp = start()
    assert str(interp.call("load-spacecraft")) == ":SPACECRAFT"
    assert not waits(interp)
    assert str(interp.call("make-ready", interp.symbol(":ega_x"))) == ":EGA_X"


def test_a_plan_that_was_compiled_may_use_it(start: Start, tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("""
        (defstruct (dog (:print-function (lambda (dog stream depth) (declare (ignore depth dog))
                                           (write-string "a dog" stream))))
          name)
        (defun names (dogs) (loop for dog in dogs collect (dog-name dog)))
        (defvar *first* (make-dog :name "rex"))
        (setf (dog-name *first*) "max")
        (print (names (list *first*))) (print *first*)
    """)
    start().load(plan)
    interp = start()
    interp.load(plan)
    assert interp.call("names", [interp.value("*first*")]) == ["max"]


def test_whatever_is_compiled_finds_all_of_it(start: Start) -> None:
    interp = start()
    assert interp.eval("(loop for i below 3 collect i)") == [0, 1, 2]
    assert not waits(interp)


def test_a_function_of_it_gives_all_its_values_the_first_time_too(start: Start) -> None:
    interp = start()
    cell = interp.image.cell(Symbol.intern("DEVICE-READY-P", "ESL"))
    with interp.at_work():
        interp.call("load-spacecraft")
        assert values_list(many_of(cell.function)(interp.symbol(":camera"))) == [None]


def test_what_a_program_has_defined_before_stays(start: Start, tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text('(defun make-ready (device) (list :mine device)) (print "defined")')
    start().load(plan)
    interp = start()
    interp.load(plan)
    assert waits(interp)
    interp.call("load-spacecraft")
    assert interp.eval("(make-ready 1)")[1] == 1
    assert "configuration.esl" not in (interp.definition(Symbol.intern("MAKE-READY", "ESL")).where or "")


def test_a_double_that_stands_in_for_one_of_its_functions_stays(start: Start) -> None:
    interp = start()
    interp.double("make-ready").returns("ready")
    interp.call("load-spacecraft")
    assert interp.call("make-ready", 1) == "ready"


def test_wrong_arguments_are_those_of_the_function(start: Start) -> None:
    interp = start()
    with pytest.raises(Failure) as caught:
        interp.call("make-ready")
    assert str(caught.value.cause) == ":WRONG-NUMBER-OF-ARGUMENTS"
    assert caught.value.arguments[0] is Symbol.intern("MAKE-READY", "ESL")


def test_its_macros_are_macros_and_its_names_are_external(start: Start, tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("""
        (defun ask () (list (and (macro-function 'loop) t) (fboundp 'make-ready)
                            (nth-value 1 (find-symbol "MAKE-READY" :esl))))
    """)
    start().load(plan)
    interp = start()
    interp.load(plan)
    assert waits(interp)
    loop, bound, status = interp.call("ask")
    assert (loop, bool(bound), str(status)) == (True, True, ":EXTERNAL")


def test_the_package_of_the_moment_stays(start: Start) -> None:
    interp = start()
    interp.call("load-spacecraft")
    assert interp.image.package.name == "ESL-USER"


def test_its_definitions_are_documented(start: Start) -> None:
    interp = start()
    definition = interp.definition(Symbol.intern("MAKE-READY", "ESL"))
    assert definition is not None
    assert definition.doc().startswith("Make DEVICE ready")


def test_what_was_kept_may_be_gone(start: Start, cache: Path) -> None:
    interp = start()
    shutil.rmtree(cache)
    assert str(interp.call("load-spacecraft")) == ":SPACECRAFT"
    assert interp.image.package.name == "ESL-USER"
    assert interp.eval("(loop repeat 2 collect 1)") == [1, 1]


def test_a_task_that_loads_it_is_not_interrupted_by_others(start: Start, tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("""
        (defun both ()
          (multiple-value-list
            (task-net (a (load-spacecraft) (make-ready :camera)) (b (load-spacecraft) (make-ready :heater)))))
    """)
    start().load(plan)
    interp = start()
    interp.load(plan)
    assert waits(interp)
    assert [str(device) for device in interp.call("both")] == [":CAMERA", ":HEATER"]
