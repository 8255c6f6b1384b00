"""A spacecraft for tests: what the facts say, on virtual time."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from io import StringIO

from eslang import Failure, Interpreter
from eslang.base.printer import prin1

LAMP = """
    (is-a :lamp :lamp) (powered-thru :lamp :bus) (switched-thru :lamp :sw1) (switched-thru :lamp :sw2)
    (power-draw :lamp 10) (transient-draw :lamp 30) (bus-capacity :bus 100)
"""


@contextmanager
def craft(facts: str = LAMP) -> Iterator[Interpreter]:
    """An interpreter whose database holds FACTS."""
    with Interpreter(clock="virtual", output=StringIO()) as agent:
        agent.eval(f"(dolist (fact '({facts})) (assert fact))")
        yield agent


def failure_of(agent: Interpreter, form: str) -> tuple[str, ...]:
    """The cause and the arguments of the failure that FORM ends with."""
    try:
        agent.eval(form)
    except Failure as failure:
        return (str(failure.cause), *map(str, failure.arguments))
    raise AssertionError(f"{form} does not fail")


def state(agent: Interpreter, device: str, relation: str = "power-state") -> str:
    """What the facts say of the state of DEVICE."""
    found = agent.eval(f"(cdaar (db-query '({relation} {device} ?state)))")
    return str(found).lower()


def shown(agent: Interpreter, form: str) -> str:
    """The value of FORM as it prints."""
    return prin1(agent.to_lisp(agent.eval(form)))
