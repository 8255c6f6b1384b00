"""The types EVENT and TASK, of which the second is one of the first (ESL §4.2)."""

from __future__ import annotations

from eslang.base.symbols import Symbol
from eslang.compile.registry import ESL
from eslang.lisp.types import NAME_OF, define_simple_type
from eslang.runtime.events import Event
from eslang.runtime.tasks import Task

EVENT, TASK = Symbol.intern("EVENT", ESL), Symbol.intern("TASK", ESL)

define_simple_type("EVENT", lambda value: isinstance(value, Event), ESL)
define_simple_type("TASK", lambda value: value.__class__ is Task, ESL)
NAME_OF[Event] = lambda value: EVENT
NAME_OF[Task] = lambda value: TASK
