"""Recovery clauses: their syntax, and the functions they become (ESL §2.1).

(CAUSE [:retries N] . BODY) or ((CAUSE . ARGS) [:retries N] . BODY). What is
wrong with a clause is said at the place where it is wrong.
"""

from __future__ import annotations

from eslang.base.failure import GENERAL_FAILURE
from eslang.base.hints import TYPE_CHECKING
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.shown import shown
from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import CL, ESL
from eslang.constructs.shapes import refuse

if TYPE_CHECKING:
    from eslang.compile.scope import Scope

RETRIES, INFINITE = Keyword("RETRIES"), Keyword("INFINITE")
LAMBDA, QUOTE, OPTIONAL, REST, SYMBOL_MACROLET = (
    Symbol.intern(name, CL) for name in ("LAMBDA", "QUOTE", "&OPTIONAL", "&REST", "SYMBOL-MACROLET")
)
RETRY, ABORT = (Symbol.intern(name, ESL) for name in ("RETRY", "ABORT"))
JUMPS = {op: Symbol.intern(f"%{op.name}-AS-VALUE", ESL) for op in (RETRY, ABORT)}
THIS_FORM = Symbol.intern("%RECOVERY-FORM", ESL)  # stands, inside a clause, for its form


def is_one_clause(clauses: Cons) -> bool:
    """True for a clause that stands where a list of them could: its first element is an atom."""
    return clauses.car.__class__ is not Cons


class RecoveryClause:
    """One recovery clause, taken apart."""

    def __init__(self, clause: Value, holder: Cons, environment: Scope | None) -> None:
        self.environment = environment
        if clause.__class__ is not Cons:
            refuse(
                environment,
                "malformed-clause",
                f"`{shown(clause)}` is no recovery clause",
                holder,
                hint="write `(cause form...)`",
            )
        self.clause = clause
        head = clause.car
        self.arguments: Value = None
        if head.__class__ is Cons:
            head, self.arguments = head.car, head.cdr
        if not isinstance(head, Symbol):
            refuse(
                environment,
                "malformed-clause",
                f"`{shown(head)}` cannot be the cause of a failure",
                clause,
                hint="write a keyword, such as `:widget-broken`",
            )
        if head is QUOTE and self.arguments.__class__ is Cons and self.arguments.cdr is None:
            refuse(
                environment,
                "malformed-clause",
                "the cause of a clause is not evaluated, and so not quoted",
                clause,
                hint=f"write `{shown(self.arguments.car)}`",
            )
        self.cause = head
        self.limit: Value = 1
        self.body = clause.cdr
        self.options()

    def options(self) -> None:
        """Take the option :retries from the head of the body."""
        body = self.body
        if body.__class__ is not Cons or not isinstance(body.car, Keyword):
            return
        if body.cdr is None:
            self.option_alone(body)
            return
        if body.car is not RETRIES:
            close = nearest(body.car.name, ["RETRIES"])
            if close is None:
                return  # a body may begin with a keyword, idle as it is
            refuse(
                self.environment,
                "unknown-clause-option",
                f"a recovery clause has no option `{shown(body.car)}`",
                body,
                label="expected `:retries`",
                hint=f"write `:retries {shown(body.cdr.car)}`",
            )
        self.limit = body.cdr.car
        self.body = body.cdr.cdr
        wrong = self.limit.__class__ is int and self.limit < 0
        literal = not isinstance(self.limit, Symbol) and self.limit.__class__ is not Cons
        other = isinstance(self.limit, Keyword) and self.limit is not INFINITE
        if wrong or other or self.limit is None or (literal and self.limit.__class__ is not int):
            refuse(
                self.environment,
                "malformed-clause",
                f"`{shown(self.limit)}` is no number of retries",
                body.cdr,
                hint="write a whole number, or `:infinite`",
            )

    def option_alone(self, body: Cons) -> None:
        """Refuse :retries with nothing behind it."""
        if body.car is RETRIES:
            refuse(
                self.environment,
                "malformed-clause",
                "`:retries` has no number behind it",
                body,
                hint="write a whole number, or `:infinite`",
            )

    def procedure(self, this: Symbol) -> Value:
        """The function of the clause's arguments; (retry) in it means the form THIS."""
        declare = lisp_list(lisp_list(THIS_FORM, this))
        body = Cons(SYMBOL_MACROLET, Cons(declare, self.with_jump_as_value(this)))
        made = lisp_list(LAMBDA, self.lambda_list(), body)
        if self.environment is not None:
            self.environment.analyser.spans.copy_from(made, self.clause)
        return made

    def with_jump_as_value(self, this: Symbol) -> Value:
        """The body; a (retry) or (abort) at its end is returned to the runtime, which jumps faster."""
        forms = []
        rest = self.body
        while rest.__class__ is Cons:
            forms.append(rest.car)
            rest = rest.cdr
        last = forms.pop() if forms else None
        if rest is not None or last.__class__ is not Cons or self.environment is None:
            return self.body
        operator = last.car
        if operator not in JUMPS or self.environment.find_function(operator) is not None:
            return self.body
        if last.cdr is not None and (operator is RETRY or last.cdr.cdr is not None):
            return self.body
        result = last.cdr if operator is RETRY else last.cdr or Cons(None, None)
        jump = Cons(JUMPS[operator], Cons(this, result))
        self.environment.analyser.spans.copy_from(jump, last)
        return from_items([*forms, jump])

    def lambda_list(self) -> Value:
        """Arguments in excess are discarded, missing ones are NIL (ESL §2.1)."""
        names: list[Value] = []
        rest = self.arguments
        while rest.__class__ is Cons:
            marker = isinstance(rest.car, Symbol) and rest.car.name.startswith("&")
            known = rest.car is OPTIONAL or rest.car is REST
            if not isinstance(rest.car, Symbol) or isinstance(rest.car, Keyword) or (marker and not known):
                refuse(
                    self.environment,
                    "malformed-clause",
                    f"`{shown(rest.car)}` cannot name an argument of a failure",
                    rest,
                    hint="the arguments come in order; write `&rest name` for all the others"
                    if marker
                    else None,
                )
            names.append(rest.car)
            rest = rest.cdr
        if rest is not None:
            names += [REST, rest]
        if OPTIONAL not in names:
            names.insert(0, OPTIONAL)
        if REST not in names:
            names += [REST, Symbol.uninterned("EXCESS")]
        return from_items(names)

    def place(self) -> Value:
        """Where the clause stands, as a list."""
        span = self.environment.analyser.spans.of(self.clause) if self.environment is not None else None
        return lisp_list(String(span.source.name), *span[1:]) if span is not None else None


def warn_of_unreachable(clauses: list[RecoveryClause], environment: Scope | None) -> None:
    """Note each clause that can never be invoked: another answers all its failures, for ever."""
    if environment is None:
        return
    for index, clause in enumerate(clauses):
        before = [
            c for c in clauses[:index] if c.limit is INFINITE and c.cause in (clause.cause, GENERAL_FAILURE)
        ]
        if before:
            first = str(before[0].cause).lower()
            message = f"this clause is never invoked: the one for `{first}` takes all its failures"
        elif clause.limit == 0:
            message = "this clause is never invoked: it has no retries"
        else:
            continue
        analyser = environment.analyser
        analyser.warn("unreachable-clause", message, analyser.spans.of(clause.clause))
