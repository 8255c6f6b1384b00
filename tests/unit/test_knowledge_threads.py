"""`agent.facts` from other threads, blocking primitives and coroutines."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from around import Worker, in_thread, whole_agent
from eslang import EslError, Failure, Interpreter, Keyword, Symbol
from eslang.knowledge import Change

PLANS = "(defvar *told* nil) (defun note (it) (push it *told*)) (defevent go)"


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that waits for the outside."""
    with whole_agent(PLANS, outside=True) as made:
        yield made


def when_waiting(agent: Interpreter, work: Callable[[], Any]) -> Worker:
    """A worker that begins when a task of AGENT begins to wait."""
    begun = threading.Event()
    agent.hooks.listeners.append(lambda event: begun.set() if event.kind == "wait" else None)
    return Worker(lambda: work() if begun.wait(10) else "nobody waits")


# --- while a run goes on --------------------------------------------------------------------


def test_a_change_from_another_thread_is_left_and_wakes_who_waits_for_it(agent: Interpreter) -> None:
    worker = when_waiting(agent, lambda: agent.facts.add("seen", "cup"))
    assert agent.eval("(progn (wait-until (seen cup)) (db-query '(seen ?x)))") is not None
    assert worker.end() is None


def test_all_changes_can_be_left(agent: Interpreter) -> None:
    facts = agent.facts
    facts.add_all([("at", "cup", "table"), ("at", "jug", "table"), ("at", "pan", "stove")])

    def work() -> list[Any]:
        return [
            facts.remove("at", "?_", "table"),
            facts.update("(at pan ?_)", ["at", "pan", ["shelf", 3]]),
            facts.add_all([("cup", "tray"), ("jug", "tray")], "at"),
            agent.signal("go"),
        ]

    worker = when_waiting(agent, work)
    agent.eval("(wait-for-events go)")
    assert worker.end() == [None] * 4
    assert [fact[1:] for fact in facts] == [
        [Symbol("pan"), [Symbol("shelf"), 3]],
        [Symbol("cup"), Symbol("tray")],
        [Symbol("jug"), Symbol("tray")],
    ]


def test_a_change_comes_before_the_signal_that_follows_it(agent: Interpreter) -> None:
    def work() -> None:
        agent.facts.add("obstacle", 3)
        agent.signal("go")

    worker = when_waiting(agent, work)
    assert agent.eval("(progn (wait-for-events go) (db-query '(obstacle 3)))") == [None]
    worker.end()


def test_a_question_from_another_thread_is_answered_between_two_steps(agent: Interpreter) -> None:
    def work() -> Any:
        agent.facts.add("seen", "cup")
        found = [
            agent.facts.query("(seen ?x)"),
            agent.facts.first("(seen jug)"),
            agent.facts.holds("(seen cup)"),
        ]
        found += [len(agent.facts), "(seen cup)" in agent.facts, list(agent.facts)]
        agent.signal("go")
        return found

    worker = when_waiting(agent, work)
    agent.eval("(wait-for-events go)")
    cup = Symbol("cup")
    assert worker.end() == [[{"x": cup}], None, True, 1, True, [[Symbol("seen"), cup]]]


def test_a_task_that_never_waits_is_no_obstacle(agent: Interpreter) -> None:
    worker: list[Worker] = []

    def begin() -> None:
        worker.append(Worker(lambda: (agent.facts.add("stop"), agent.facts.holds("(stop)"))))

    agent.primitive(name="begin")(begin)
    agent.eval("(progn (begin) (loop (if (db-query '(stop)) (return))))")
    assert worker[0].end() == (None, True)


def test_a_blocking_primitive_changes_and_asks(agent: Interpreter) -> None:
    @agent.primitive(blocking=True)
    def look() -> int:
        agent.facts.add("seen", "cup")
        agent.facts.add("seen", "jug")
        return len(agent.facts.query("(seen ?x)"))

    agent.primitive(name="count-them", blocking=True)(lambda: len(agent.facts))
    assert agent.eval("(list (look) (length (db-query '(seen ?x))) (count-them))") == [2, 2, 2]


def test_who_leaves_a_change_does_not_wait_even_if_the_step_waits_for_it(agent: Interpreter) -> None:
    agent.primitive(name="disconnect")(lambda: in_thread(lambda: agent.facts.add("seen", "cup")))
    assert agent.eval("(list (disconnect) (db-query '(seen cup)))") == [None, None]
    assert agent.facts.holds("(seen cup)")
    agent.facts.subscribe(lambda change: in_thread(lambda: agent.facts.add("seen", "jug")))
    agent.facts.add("seen", "pan")
    assert agent.facts.holds("(seen jug)")


def test_a_mistake_is_found_where_it_is_made_and_changes_nothing(agent: Interpreter) -> None:
    def mistakes() -> list[str]:
        found = []
        for wrong in (("(seen",), ("seen", "?x"), ("seen", "a cup"), (5,)):
            with pytest.raises((Failure, EslError)) as caught:
                agent.facts.add(*wrong)
            found.append(type(caught.value).__name__)
        with pytest.raises(Failure, match="row 2"):
            agent.facts.add_all([("cup",), ("?x",)], "seen")
        return found

    agent.primitive(name="try-it")(lambda: in_thread(mistakes))
    assert agent.eval("(try-it)") == ["IncompleteInput", "Failure", "Failure", "Failure"]
    assert len(agent.facts) == 0
    assert agent.eval('(find-symbol "JUG")') is None


def test_what_goes_wrong_later_is_a_failure_of_the_run(agent: Interpreter) -> None:
    def broken(change: Change) -> None:
        raise OSError("no display")

    agent.facts.subscribe(broken)
    worker = when_waiting(agent, lambda: (agent.facts.add("seen", "cup"), agent.signal("go")))
    agent.eval("(wait-for-events go)")
    assert worker.end() == (None, None)
    with pytest.raises(Failure) as caught:
        agent.finish()
    assert isinstance(caught.value.__cause__, OSError)
    assert agent.facts.holds("(seen cup)")


def test_what_is_wrong_with_a_question_is_raised_where_it_is_asked(agent: Interpreter) -> None:
    worker = when_waiting(agent, lambda: (agent.signal("go"), agent.facts.query("(not (seen ?x))")))
    agent.eval("(wait-for-events go)")
    failure = worker.end()
    assert failure.cause is Keyword("unbound-logic-variable")
    assert failure.arguments[0] is Symbol("?x")


def test_what_a_question_from_another_thread_calls_cannot_wait(agent: Interpreter) -> None:
    agent.facts.add("load", 3)
    agent.eval("(defun odd-one (n) (oddp n)) (defun slow (n) (sleep 0.001) n)")

    def work() -> list[Any]:
        found: list[Any] = [agent.facts.holds("(and (load ?n) (odd-one ?n))")]
        with pytest.raises(Failure) as caught:
            agent.facts.holds("(and (load ?n) (slow ?n))")
        agent.signal("go")
        return [*found, caught.value.cause]

    worker = when_waiting(agent, work)
    agent.eval("(wait-for-events go)")
    assert worker.end() == [True, Keyword("control-error")]


def test_a_list_may_be_used_on_after_it_was_left_in_a_change(agent: Interpreter) -> None:
    def work() -> None:
        place: list[Any] = ["shelf", [1]]
        row = ["at", "cup", place]
        agent.facts.add(row)
        agent.facts.add_all([row])
        place[1].append(2)
        row[1] = "jug"

    agent.primitive(name="try-it")(lambda: in_thread(work))
    agent.eval("(try-it)")
    assert [fact[1:] for fact in agent.facts] == [[Symbol("cup"), [Symbol("shelf"), [1]]]]


def test_names_that_are_left_are_of_the_package_outside_all_tasks(agent: Interpreter, tmp_path: Path) -> None:
    agent.eval("(make-package :robot)")
    agent.primitive(name="esl-user::from-elsewhere")(
        lambda: in_thread(lambda: agent.facts.add("seen", "jug"))
    )
    agent.primitive(name="esl-user::from-here")(lambda: agent.facts.add("seen", "jug"))
    plan = tmp_path / "robot.esl"
    plan.write_text("(in-package :robot) (esl-user::from-elsewhere) (esl-user::from-here)")
    agent.load(plan)
    homes = [fact[0].package for fact in agent.facts]
    assert sorted(homes) == ["ESL-USER", "ROBOT"]


def test_subscribers_hear_in_the_thread_that_is_at_work(agent: Interpreter) -> None:
    threads: list[Any] = []

    def work() -> None:
        unsubscribe = agent.facts.subscribe(lambda change: threads.append(threading.current_thread()))
        agent.facts.add("seen", "cup")
        agent.facts.holds("(seen cup)")
        unsubscribe()
        agent.facts.add("seen", "jug")
        agent.signal("go")

    worker = when_waiting(agent, work)
    agent.eval("(wait-for-events go)")
    worker.end()
    assert threads == [threading.main_thread()]


# --- while nothing is at work ---------------------------------------------------------------


def test_another_thread_is_served_at_once_while_nothing_is_at_work(agent: Interpreter) -> None:
    assert in_thread(lambda: agent.facts.add("seen", "cup")) is True
    assert in_thread(lambda: agent.facts.query("(seen ?x)")) == [{"x": Symbol("cup")}]
    assert in_thread(lambda: agent.facts.remove("seen", "?_")) == 1


def test_tasks_that_are_alive_are_no_obstacle_and_are_woken(agent: Interpreter) -> None:
    agent.eval("(spawn (progn (wait-until (seen cup)) (note :woken))) (yield)")
    assert in_thread(lambda: agent.facts.add("seen", "cup")) is True
    assert in_thread(lambda: agent.facts.holds("(seen cup)")) is True
    agent.finish()
    assert agent.value("*told*") == [Keyword("woken")]


def test_what_was_posted_before_is_done_before(agent: Interpreter) -> None:
    agent.eval("(spawn (progn (wait-for-events go) (note (db-query '(seen cup))))) (yield)")
    agent.signal("go")
    agent.facts.add("seen", "cup")
    agent.finish()
    assert agent.value("*told*") == [[None]]


def test_calls_are_not_refused_because_another_thread_is_at_the_facts(agent: Interpreter) -> None:
    agent.eval("(defun work (n) (assert `(done ,n)) (task-net (a (yield) n) (b (yield))))")
    over = threading.Event()

    def work() -> int:
        rounds = 0
        while not over.is_set():
            agent.facts.update("(round ?_)", ("round", rounds))
            if not agent.facts.holds("round", "?n"):
                return -1
            rounds += 1
        return rounds

    workers = [Worker(work) for _ in range(2)]
    for number in range(300):
        assert agent.call("work", number) == number
        assert agent.facts.holds("done", number)
    over.set()
    assert all(worker.end() > 0 for worker in workers)
    assert len(agent.facts.query("(done ?n)")) == 300


@pytest.mark.slow
def test_threads_and_plans_that_change_facts_at_once_each_find_their_own(agent: Interpreter) -> None:
    agent.eval("""
        (defun churn (rounds)
          (dotimes (n rounds)
            (assert `(owned plan ,n))
            (if (evenp n) (retract `(owned plan ,n)))
            (yield)))""")
    told: list[Change] = []
    agent.facts.subscribe(told.append)

    def work(name: str) -> int:
        wrong = 0
        for number in range(150):
            agent.facts.add("owned", name, number)
            wrong += not agent.facts.holds("owned", name, number)
            if number % 2 == 0:
                agent.facts.remove("owned", name, number)
                wrong += ["owned", name, number] in agent.facts
        return wrong

    workers = [Worker(lambda name=f"w{number}": work(name)) for number in range(4)]  # type: ignore[misc]
    while any(worker.is_alive() for worker in workers):
        agent.call("churn", 20)
    assert [worker.end() for worker in workers] == [0] * 4
    held: set[tuple[Any, ...]] = set()
    for change in told:
        assert (change.terms in held) is not change.added
        (held.add if change.added else held.remove)(change.terms)
    assert held == {tuple(fact[1:]) for fact in agent.facts}
    for name in ("w0", "w3"):
        assert [row["n"] for row in agent.facts.query("owned", name, "?n")] == list(range(1, 150, 2))


def test_a_question_that_nobody_could_answer_yet_is_answered_by_who_leaves(agent: Interpreter) -> None:
    gate = agent.runs.gate
    assert gate.let_in()  # as if somebody was visiting
    worker = Worker(lambda: agent.facts.holds("(seen cup)"))
    while agent.scheduler.posted.empty():
        pass
    agent.facts.add("seen", "cup")
    gate.let_out()
    assert agent.eval("1") == 1
    assert worker.end() is True


def test_a_question_to_an_interpreter_that_is_closed_meanwhile_fails() -> None:
    agent = Interpreter()
    gate = agent.runs.gate
    assert gate.let_in()
    worker = Worker(lambda: agent.facts.holds("(seen cup)"))
    while agent.scheduler.posted.empty():
        pass
    agent.closed = True
    gate.let_out()
    agent.runs.let_go()
    assert worker.end().cause is Keyword("interpreter-closed")


def test_a_change_that_is_left_when_the_interpreter_is_closed_is_dropped() -> None:
    agent = Interpreter()
    gate = agent.runs.gate
    assert gate.let_in()
    assert in_thread(lambda: agent.facts.add("seen", "cup")) is None
    agent.closed = True
    gate.let_out()
    agent.runs.let_go()
    assert agent.scheduler.posted.empty() and not agent.runs.errands
