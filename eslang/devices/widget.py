"""Widgets (ESL §2.3): they are operated, they break, and they can be fixed.

Registered through the embedding interface alone, as any device would be. Each
primitive takes, last, the name of a widget; without one it means the widget
whose state is the variable *WIDGET-STATUS* (stdlib/widgets.esl).
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any
from eslang.base.symbols import Keyword

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter

OK, BROKEN = Keyword("OK"), Keyword("BROKEN")
STATUS = "esl::*widget-status*"


class Widgets:
    """The widgets of one interpreter."""

    def __init__(self, agent: Interpreter) -> None:
        self.agent = agent
        self.named: dict[Any, Any] = {}

    def status(self, widget: Any) -> Any:
        """The state of WIDGET: :OK, or how it is broken."""
        return self.agent.value(STATUS) if widget is None else self.named.get(key_of(widget), OK)

    def change(self, widget: Any, state: Any) -> None:
        """Put WIDGET into STATE."""
        if widget is None:
            self.agent.set_value(STATUS, state)
        else:
            self.named[key_of(widget)] = state

    def say(self, line: str) -> None:
        """Write LINE on a line of its own."""
        self.agent.output.fresh_line()
        self.agent.output.write(line + "\n")

    def operate_widget(self, widget: Any = None) -> None:
        """Operate WIDGET.

        Returns: NIL.
        Fails:   :widget-broken, with the name of the widget if it has one.

        Example:
            ? (operate-widget)
            OPERATING WIDGET SUCCESSFULLY.
            NIL

        Source: ESL §2.3.
        """
        if self.status(widget) is not OK:
            raise Failure("widget-broken", *([] if widget is None else [widget]))
        self.say("OPERATING WIDGET SUCCESSFULLY.")

    def break_widget(self, state: Any = None, widget: Any = None) -> Any:
        """Break WIDGET so that it is in STATE, :broken unless given.

        Returns: STATE.

        Example:
            ? (break-widget :severely-broken)
            :SEVERELY-BROKEN

        Source: ESL §2.3.
        """
        state = BROKEN if state is None else state
        self.change(widget, state)
        return state

    def attempt_widget_fix(self, state: Any, widget: Any = None) -> None:
        """Fix WIDGET, which works if STATE is the state that it is in.

        Returns: NIL.

        Example:
            ? (progn (break-widget) (attempt-widget-fix :broken))
            Widget is fixed.
            NIL

        Source: ESL §2.3.
        """
        if self.status(widget) is state:
            self.change(widget, OK)
            self.say("Widget is fixed.")
        else:
            self.say("Widget fix didn't work.")

    def widget_status(self, widget: Any = None) -> Any:
        """Tell the state of WIDGET.

        Returns: :ok, or how it is broken.

        Example:
            ? (widget-status)
            :OK

        Source: ours, after ESL §2.3.
        """
        return self.status(widget)


def key_of(widget: Any) -> Any:
    """What a widget is known by here: its name, which may be a list."""
    return tuple(map(key_of, widget)) if isinstance(widget, list) else widget


def install(agent: Interpreter) -> None:
    """Give an interpreter its widgets."""
    widgets = Widgets(agent)
    agent.primitive(signature="(esl::operate-widget &optional widget)")(widgets.operate_widget)
    agent.primitive(signature="(esl::break-widget &optional state widget)")(widgets.break_widget)
    agent.primitive(signature="(esl::attempt-widget-fix state &optional widget)")(widgets.attempt_widget_fix)
    agent.primitive(signature="(esl::widget-status &optional widget)", outside=False)(widgets.widget_status)
