"""Goals for tests: lamps that can be lit, a battery that can be charged, and what listeners hear of goals."""

from __future__ import annotations

from typing import Any

from support import run

LAMPS = """
(defproperty lamp (where state))
(to-achieve (lamp ?where ?state) (t (assert '(lamp #?where #?state))))
"""
BATTERY = """
(defproperty battery (state))
(to-achieve (battery :full) (t (print :charge) (sleep 1) (assert '(battery :full))))
(assert '(battery :full))
"""
SEEDS = range(5)


def changes_of(text: str, **given: Any) -> list[str]:
    """What listeners hear of goals while TEXT runs."""
    heard: list[str] = []

    def listen(event: Any) -> None:
        if event.kind == "goal-changed":
            failure = event.data["failure"]
            why = "" if failure is None else f" {failure.cause}"
            heard.append(f"{event.data['change']} {event.data['goal']}{why}".lower())

    run(text, listeners=[listen], **given)
    return heard
