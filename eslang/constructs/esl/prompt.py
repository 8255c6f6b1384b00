"""Plans that show a conversation: forms said to the prompt, and what it answers.

The papers explain ESL by such traces (ESL §2.3, §3). Each form is a task of
its own, as at the prompt: a failure that it does not recover from ends it,
and the next form is said.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.many import many_of, values_list
from eslang.base.printer import prin1
from eslang.base.running import running
from eslang.base.spans import Span
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.esl.clauses import LAMBDA
from eslang.runtime import failures

PROGN = Symbol.intern("PROGN", CL)
SAY = Symbol.intern("%SAY-TO-PROMPT", ESL)
STANDARD_OUTPUT = Symbol.intern("*STANDARD-OUTPUT*", CL)
PROMPT = "? "


@macro("(at-the-prompt &body forms)", ESL)
def at_the_prompt(form: Cons, environment: Any) -> Value:
    """Show FORMS as a conversation: each as it is written, then its answer.

    The answer is what the form prints, and its values, one a line. Each form
    is a task of its own: no recovery procedure outside it is asked, and a
    failure that it does not recover from ends this form only.

    Returns: NIL.

    Source: ours, after the traces of ESL §2.3.
    """
    calls = []
    rest = form.cdr
    while rest is not None:
        span = environment.analyser.spans.element(rest) if environment is not None else None
        text = prin1(rest.car).lower() if span is None else written(span)
        calls.append(lisp_list(SAY, String(text), lisp_list(LAMBDA, None, rest.car)))
        rest = rest.cdr
    return Cons(PROGN, from_items([*calls, None]))


def written(span: Span) -> str:
    """The text at SPAN, its further lines indented as if the first stood behind the prompt."""
    lines = [span.source.line(number) for number in range(span.line, span.end_line + 1)]
    lines[-1] = lines[-1][: span.end_column - 1]
    first = lines[0][span.column - 1 :]
    further = [line[min(span.column - 1, len(line) - len(line.lstrip())) :] for line in lines[1:]]
    return "\n".join([first, *(" " * len(PROMPT) + line for line in further)])


@function("(%say-to-prompt text form)", ESL)
def say_to_prompt(text: String, form: Any) -> Value:
    """Write TEXT behind a prompt, run FORM, a function, as a task, and print its values."""
    output = running.session.image.cell(STANDARD_OUTPUT).value
    output.fresh_line()
    output.write(f"{PROMPT}{text.text}\n")
    try:
        values = values_list(failures.run_apart(many_of(form)))
    except Failure:
        return None  # the listeners have been told
    for value in values:
        output.fresh_line()
        output.write(prin1(value) + "\n")
    return None
