"""The runs that are killed, and what their files may hold.

Every state that a run may leave behind is known: the run is made once without
a file, and what it knows is noted at the end of each step.
"""

from __future__ import annotations

from hashlib import sha256
from typing import Any

from eslang import Interpreter
from eslang.durable import keep_facts

PLAN = """
(defproperty level)
(defun work (name many)
  (dotimes (i many)
    (assert (list 'done name i "a note" (list 'about i)))
    (update (list 'level name '?any) (list 'level name i))
    (case (mod i 4)
      (0 (yield))
      (1 (without-interrupts (retract (list 'done name (- i 3) '?note '?about))
                             (assert (list 'gone name (- i 3)))))
      (2 (sleep 0.5))
      (3 (dotimes (k 700) (when (= k 350) (assert (list 'slice name i))))))))

(defun go-on (many)
  (task-net (a (work 'a many))
            (b (work 'b many))
            (c (with-cleanup-procedure (assert '(cleaned))
                 (work 'c many)))))
"""


MARCH = """
(defun march (many)
  (let ((n (with-recovery-procedures ((:no-bindings (abort 0))) (with-query-bindings '(at ?n) #?n))))
    (task-net (left (loop while (< n many)
                          do (without-interrupts
                               (incf n)
                               (update '(at ?n) (list 'at n))
                               (assert (list 'trail n))
                               (retract (list 'trail (- n 50))))
                             (yield)))
              (right (loop while (< n many) do (yield))))))
"""


def begun() -> Interpreter:
    """An interpreter that knows the plans, and has no file yet."""
    agent = Interpreter(clock="virtual")
    agent.eval(PLAN + MARCH)
    return agent


def held(agent: Interpreter) -> str:
    """What AGENT knows, in its order within each relation, as a short text."""
    relations = sorted(agent.database.relations.values(), key=lambda each: (each.name.name, each.arity))
    shown = [f"{each.name.name} {row}" for each in relations for row in each.rows]
    return sha256("\n".join(shown).encode()).hexdigest()


def states(agent: Interpreter, path: str, many: int) -> list[str]:
    """What AGENT, in a run of MANY rounds, has in its file, from the beginning to the end.

    That is what it knows whenever a transaction is written.
    """
    keep_facts(agent, path)
    found = [held(agent)]
    journal: Any = agent.database.journal
    write = journal.file.write

    def note(*given: Any) -> None:
        write(*given)
        found.append(held(agent))

    journal.file.write = note
    agent.call("go-on", many)
    agent.close()
    return found


def progress(agent: Interpreter) -> str:
    """How far the march has come; "broken" if what AGENT knows is no state of it."""
    at = agent.eval(
        "(with-recovery-procedures ((:no-bindings (abort 0))) (with-query-bindings '(at ?n) #?n))"
    )
    trail = agent.eval("(mapcar #'cdar (db-query '(trail ?n)))") or []
    whole = trail == list(range(max(1, at - 49), at + 1)) and len(agent.database) == len(trail) + (at > 0)
    return str(at) if whole else "broken"
