"""AT-THE-PROMPT: forms said to the prompt by a plan."""

from __future__ import annotations

from support import run


def printed(text: str) -> list[str]:
    """The lines that TEXT prints; nothing may fail."""
    came = run(text)
    assert came.failure is None
    assert came.error is None
    return [line for line in came.output.split("\n") if line]


def test_a_form_is_shown_as_it_is_written_and_then_its_values() -> None:
    assert printed("(at-the-prompt (List 1   'two) :Three (values 4 5) (values))") == [
        "? (List 1   'two)",
        "(1 TWO)",
        "? :Three",
        ":THREE",
        "? (values 4 5)",
        "4",
        "5",
        "? (values)",
    ]


def test_further_lines_are_indented_as_they_stand_to_the_first() -> None:
    text = "(progn\n    (at-the-prompt\n      (list 1\n            2)))"
    assert printed(text) == ["? (list 1", "        2)", "(1 2)"]


def test_a_failure_ends_its_form_only() -> None:
    came = run("(print (at-the-prompt (fail :stuck) (+ 1 1)))")
    assert came.trace == ["Failure :STUCK, no recovery available.", "Aborted"]
    assert came.output.split() == ["?", "(fail", ":stuck)", "?", "(+", "1", "1)", "2", "NIL"]


def test_no_procedure_outside_is_asked() -> None:
    came = run("(with-recovery-procedures ((:stuck (abort))) (at-the-prompt (fail :stuck)))")
    assert came.trace == ["Failure :STUCK, no recovery available.", "Aborted"]


def test_cleanups_and_dynamic_bindings_of_a_failed_form_are_undone() -> None:
    text = """
        (defvar *depth* 0)
        (at-the-prompt
          (let ((*depth* 1)) (with-cleanup-procedure (print :clean) (fail :stuck)))
          *depth*)"""
    assert printed(text)[-3:] == [":CLEAN ", "? *depth*", "0"]


def test_it_writes_to_standard_output_as_it_is_bound() -> None:
    text = (
        "(defvar *said* (with-output-to-string (*standard-output*) (at-the-prompt (+ 1 2)))) (prin1 *said*)"
    )
    assert printed(text) == ['"? (+ 1 2)', "3", '"']


def test_a_jump_leaves_all_of_it() -> None:
    assert printed("(prin1 (block out (at-the-prompt (return-from out 7) (print :never))))") == [
        "? (return-from out 7)",
        "7",
    ]
