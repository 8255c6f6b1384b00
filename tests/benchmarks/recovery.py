"""Fail, recover, retry: three failures, three retries, success.

Beside ESL stand a loop that a Python programmer writes, the same with handlers
that are searched before anything is unwound (what ESL does, with no more than
that), and two libraries that know retrying.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from eslang import Interpreter
from tests.benchmarks.measure import Peer, Run, Work

ROUNDS = 200
TEXT = """
(defun stumble ()
  (let ((tries 0))
    (with-recovery-procedures ((:slipped :retries 3 (retry)))
      (incf tries)
      (if (< tries 4) (fail :slipped))
      tries)))
(defun stumbles (rounds)
  (let ((tries 0))
    (dotimes (round rounds tries)
      (incf tries (stumble)))))
"""


def works() -> Iterator[Work]:
    """The one work of this file."""
    agent = Interpreter()
    agent.eval(TEXT)
    yield Work(
        "three failures, three retries, success",
        lambda: agent.call("stumbles", ROUNDS),
        [
            Peer("Python raise/except in a loop", rounds_of(raising), 5.0, ROUNDS),
            Peer("handlers searched before unwinding, in Python", rounds_of(searching), 1.8, ROUNDS),
            Peer("py_trees Retry", py_trees_rounds(), 0.2, ROUNDS),
            Peer("tenacity", tenacity_rounds(), 0.2, ROUNDS),
        ],
        per=ROUNDS,
    )


def rounds_of(stumble: Callable[[], int]) -> Run:
    """Do it as often as the Lisp loop does."""

    def run() -> int:
        tries = 0
        for _ in range(ROUNDS):
            tries += stumble()
        return tries

    return run


class Slipped(Exception):
    """What fails."""


def raising() -> int:
    """A loop around try and except."""
    tries, left = 0, 3
    while True:
        try:
            tries += 1
            if tries < 4:
                raise Slipped
            return tries
        except Slipped:
            if not left:
                raise
            left -= 1


class Form:
    """A form that answers failures: its handlers, each with a number of retries."""

    def __init__(self, handlers: list[tuple[str, int, Callable[[Form], object]]]) -> None:
        self.handlers = handlers
        self.used = [0] * len(handlers)


class Again(BaseException):
    """The jump to the start of a form's body."""

    def __init__(self, target: Form) -> None:
        self.target = target


FORMS: list[Form] = []


def fail(cause: str) -> object:
    """Call the first handler for CAUSE that has retries left, from the innermost form outward."""
    for form in reversed(FORMS):
        for number, (wanted, limit, handler) in enumerate(form.handlers):
            if wanted == cause and form.used[number] < limit:
                form.used[number] += 1
                return handler(form)
    raise Slipped(cause)


def again(form: Form) -> object:
    """The handler that retries."""
    raise Again(form)


def with_handlers(form: Form, body: Callable[[], int]) -> int:
    """Run BODY while the handlers of FORM answer its failures."""
    FORMS.append(form)
    try:
        while True:
            try:
                return body()
            except Again as jump:
                if jump.target is not form:
                    raise
    finally:
        FORMS.pop()


def searching() -> int:
    """Handlers are searched where the failure occurs, and jump."""
    tries = 0

    def body() -> int:
        nonlocal tries
        tries += 1
        if tries < 4:
            fail("slipped")
        return tries

    return with_handlers(Form([("slipped", 3, again)]), body)


def py_trees_rounds() -> Run | None:
    """A Retry decorator around a behaviour that fails three times."""
    try:
        import py_trees
    except ImportError:
        return None
    FAILURE, SUCCESS = py_trees.common.Status.FAILURE, py_trees.common.Status.SUCCESS

    class Stumble(py_trees.behaviour.Behaviour):  # type: ignore[misc]
        """Succeeds when it is ticked for the fourth time."""

        tries = 0

        def update(self) -> Any:
            """One try."""
            self.tries += 1
            return FAILURE if self.tries < 4 else SUCCESS

    child = Stumble(name="stumble")
    root = py_trees.decorators.Retry(name="retry", child=child, num_failures=4)

    def stumble() -> int:
        child.tries = 0
        root.tick_once()
        while root.status is not SUCCESS:
            root.tick_once()
        return child.tries

    return rounds_of(stumble)


def tenacity_rounds() -> Run | None:
    """A Retrying without pauses."""
    try:
        import tenacity
    except ImportError:
        return None

    def stumble() -> int:
        tries = 0

        def once() -> int:
            nonlocal tries
            tries += 1
            if tries < 4:
                raise Slipped
            return tries

        again = tenacity.Retrying(
            stop=tenacity.stop_after_attempt(4),
            wait=tenacity.wait_none(),
            retry=tenacity.retry_if_exception_type(Slipped),
        )
        return int(again(once))

    return rounds_of(stumble)
