"""What `esl check` says of relations, rules and queries.

A relation is known that is declared, derived or asserted somewhere in the
program. Where facts may come that its text does not show, from a file or a
computed list, a name is blamed only if it is surely wrong. A program that
declares a relation by DEFRELATION is taken at its word: all are to be declared.
"""

from __future__ import annotations

from eslang.base.diagnostics import Diagnostic, Label
from eslang.base.failure import Failure
from eslang.base.hints import Iterable, Iterator
from eslang.base.image import Image
from eslang.base.lists import Cons, items
from eslang.base.shown import shown
from eslang.base.spans import Span
from eslang.base.suggest import nearest
from eslang.base.symbols import Symbol, Value
from eslang.compile.analyser import Use
from eslang.compile.check import Judge
from eslang.compile.registry import CL, ESL, SCS
from eslang.constructs.esl.mentions import (
    ASKED,
    ASSERTED,
    CONDITION,
    DECLARED,
    DERIVED,
    UNKNOWN,
    Mention,
    Mentions,
    Question,
    parts_of,
)
from eslang.constructs.queries import LOGICAL_BINDING
from eslang.facts.goals import AND, NOT, UNBOUND, read_query, shape_of, variables_of
from eslang.facts.query import Facts
from eslang.facts.rules import UNSTRATIFIED

DISCOUNT = Symbol.intern("DISCOUNT", SCS)  # of which REINFORCE asserts facts
SURE_TESTS = frozenset(
    Symbol.intern(name, CL)
    for name in ("<", ">", "<=", ">=", "=", "/=", "EQ", "EQL", "EQUAL", "EQUALP", "FUNCALL")
)


class RelationCheck(Judge):
    """Judges what a program says of relations."""

    def __init__(self, image: Image, uses: list[Use], is_whole: bool) -> None:
        super().__init__(image, uses, is_whole)
        self.mentions = Mentions(uses, is_whole)
        self.known: dict[Symbol, list[Mention]] = {}  # how each relation became one
        for mention in self.mentions.all:
            if mention.how in (DECLARED, DERIVED, ASSERTED):
                self.known.setdefault(mention.name, []).append(mention)

    def is_called(self, operator: Symbol) -> bool:
        """Whether a condition with OPERATOR is a call: it names a function, and no relation."""
        return super().is_called(operator) and operator not in self.known

    def told(self, diagnostic: Diagnostic, use: Use) -> Diagnostic | None:
        """Where a fact or a query is not quoted, that is said, and nothing of the names in it."""
        for operator, place in self.mentions.unquoted:
            if use.span is not None and is_inside(use.span, place) and not self.is_operator(operator):
                if use.symbol is not operator:
                    return None
                if operator in self.known or diagnostic.hint is None:
                    hint = f"write `'({shown(operator)} …)` if a fact or a query is meant: these are data"
                    return diagnostic._replace(hint=hint)
        return diagnostic

    def verdicts(self) -> Iterator[Diagnostic]:
        """What is wrong with relations, rules and queries."""
        undeclared: set[Symbol] = set()
        for mention in self.mentions.all:
            if mention.how != DECLARED:
                yield from self.arity(mention)
            if mention.name not in self.known:
                yield from self.unknown(mention) if mention.how in (ASKED, CONDITION) else ()
            elif mention.name not in undeclared and self.is_undeclared(mention.name):
                undeclared.add(mention.name)
                yield self.undeclared(mention)
        yield from self.ambiguous()
        yield from self.variables()
        yield from QuestionCheck(self).verdicts()

    # --- names -------------------------------------------------------------------

    def is_operator(self, name: Symbol) -> bool:
        """Whether NAME names a function, a macro or a special form."""
        cell = self.image.cell(name)
        return hasattr(cell, "function") or cell.macro is not None or name in self.image.special_forms

    def is_undeclared(self, name: Symbol) -> bool:
        """Whether NAME is asserted only, in a program that declares its relations."""
        only_asserted = all(each.how == ASSERTED for each in self.known[name])
        return self.mentions.is_strict and only_asserted and not is_of_library(name)

    def unknown(self, mention: Mention) -> Iterator[Diagnostic]:
        """Nothing declares, derives or asserts what is asked."""
        name, is_condition = mention.name, mention.how == CONDITION
        if is_of_library(name):
            return
        if self.is_operator(name):
            if not is_condition and not hasattr(self.image.cell(name), "function"):
                what = f"there is no relation `{shown(name)}`, and a macro is no test"
                yield warning("unknown-relation", what, mention, "put it into a function, and ask that")
            return
        known = [each.name for each in (*self.known, *filter(is_of_library, self.accessible()))]
        functions = [] if not is_condition else [s.name for s in self.accessible() if self.is_operator(s)]
        near = nearest(name.name, [*known, *functions])
        if not self.mentions.is_whole and not self.mentions.is_strict and not (is_condition and near):
            return
        what = "neither a relation nor a function" if is_condition else "no relation"
        hint = f"write `{near.lower()}`" if near else None
        if near is None:
            hint = f"declare it, if its facts come from elsewhere: `(defrelation {shown(name)})`"
        yield warning("unknown-relation", f"there is {what} `{shown(name)}`", mention, hint)

    def accessible(self) -> Iterable[Symbol]:
        """The names that can be said here."""
        return [symbol for symbol in self.image.package.accessible() if symbol is not None]

    def undeclared(self, mention: Mention) -> Diagnostic:
        """A relation is asserted, and not declared as others are."""
        name = mention.name
        declared = [each.name for each in self.known if not self.is_undeclared(each)]
        near = nearest(name.name, declared)
        hint = f"write `{near.lower()}`" if near else f"write `(defrelation {shown(name)})` before"
        return warning("undeclared-relation", f"the relation `{shown(name)}` is not declared", mention, hint)

    def ambiguous(self) -> Iterator[Diagnostic]:
        """Names of relations that are names of functions, too."""
        for name, mentions in self.known.items():
            if self.is_operator(name):
                declared = [each for each in mentions if each.how != ASSERTED]
                message = f"`{shown(name)}` is a relation and a function"
                if declared:
                    hint = "give one of them another name: a condition means the relation"
                else:
                    message += ", and which of them a condition means depends on when it is asked"
                    hint = f"write `(defrelation {shown(name)})` before, or give it another name"
                yield warning("relation-and-function", message, (declared or mentions)[0], hint)

    def variables(self) -> Iterator[Diagnostic]:
        """Names of variables that stand for themselves, in queries that are conditions."""
        for asked, mention in self.mentions.variables:
            is_relation = asked.name in self.known or is_of_library(asked.name)
            if is_relation and not self.is_called(asked.name):
                name = shown(mention.name)
                message = f"`{name}` stands for itself in a query, not for the variable"
                hint = f"put the query under a backquote, and write `,{name}`"
                yield warning("variable-in-query", message, mention, hint)

    # --- arities -----------------------------------------------------------------

    def arity(self, mention: Mention) -> Iterator[Diagnostic]:
        """A relation has another number of arguments than it is declared with, or than all its facts have."""
        ways = self.known.get(mention.name, [])
        declared = {each.arity for each in ways if each.how == DECLARED and each.arity is not None}
        if mention.arity is None or not ways:
            return
        if declared:
            if mention.arity not in declared:
                yield self.wrong_arity(mention, sorted(declared))
        elif mention.how in (ASKED, CONDITION) and self.mentions.is_whole:
            arities = {each.arity for each in ways}
            if None not in arities and mention.arity not in arities:
                some = " or ".join(sorted(map(str, arities)))
                message = f"no fact of `{shown(mention.name)}` has {counted(mention.arity)}"
                hint = f"give it {some}, as where it is asserted or derived"
                yield warning("unknown-relation", message, mention, hint)

    def wrong_arity(self, mention: Mention, declared: list[int]) -> Diagnostic:
        """A relation is declared with other numbers of arguments."""
        name = shown(mention.name)
        some = " or ".join(map(str, declared))
        message = f"`{name}` takes {some} argument{'' if declared == [1] else 's'}, found {mention.arity}"
        arguments = [self.mentions.arguments.get((mention.name, arity)) for arity in declared]
        hints = [
            f"`({name}{''.join(f' {shown(each)}' for each in items(names))})`" for names in arguments if names
        ]
        hint = f"write {' or '.join(hints)}" if hints else None
        return diagnostic("wrong-number-of-arguments", message, mention.span, mention.use, hint)


class QuestionCheck:
    """Judges rules and queries by a database of their own, in which there are no facts."""

    def __init__(self, check: RelationCheck) -> None:
        self.check = check
        self.facts = Facts(self.is_test, lambda name, arguments: True)
        self.told: set[str] = set()  # what was said of rules, and is not said again of who asks them
        for name in check.known:
            self.facts.declare(name)

    def is_test(self, name: Symbol) -> bool:
        """Whether a goal with NAME is surely a call of Lisp."""
        return name in SURE_TESTS or (self.check.mentions.is_whole and self.check.is_operator(name))

    def verdicts(self) -> Iterator[Diagnostic]:
        """What is wrong with rules and queries."""
        mentions = self.check.mentions
        for rule in mentions.rules:
            yield from self.rule(rule)
        for question in mentions.questions:
            yield from self.question(question.query, question)

    def rule(self, rule: Question) -> Iterator[Diagnostic]:
        """A rule: defined, and asked for with all the variables of its head known."""
        head, body = shows(rule.head), shows(rule.query)
        try:
            self.facts.define_rule(head, body)
            variables = variables_of(shape_of(read_query(head)[0]).goal)
        except Failure as failure:
            if failure.cause is UNSTRATIFIED:
                yield unstratified(failure, rule)
            return
        yield from self.question(Cons(AND, body), rule, dict.fromkeys(variables, UNKNOWN))

    def question(
        self, query: Value, question: Question, given: dict[Symbol, Value] | None = None
    ) -> Iterator[Diagnostic]:
        """A query that would fail because a variable has no value."""
        try:
            self.facts.plan(shows(query), given or {})
        except Failure as failure:
            if failure.cause is UNBOUND:
                goal = shown(failure.values[1])
                if question.head is not None:
                    self.told.add(goal)
                elif goal in self.told:
                    return
                yield unsafe(failure, question)


def unsafe(failure: Failure, question: Question) -> Diagnostic:
    """A variable has no value where a goal needs one."""
    variable, goal = failure.values
    message = f"`{shown(variable)}` has no value where `{shown(goal)}` needs one"
    spans = question.use.scope.analyser.spans
    places = [spans.of(part) for part in parts_of(question.query) if shown(part) == shown(goal)]
    span = next((place for place in places if place is not None), spans.of(question.query))
    hint = f"let a pattern beside it tell what `{shown(variable)}` is"
    if goal.car is NOT:
        hint += ", or write `?_` if it may be anything"
    return diagnostic("unsafe-query", message, span, question.use, hint)


def unstratified(failure: Failure, rule: Question) -> Diagnostic:
    """A rule that closes a circle through NOT."""
    circle = " → ".join(f"`{shown(name)}`" for name in items(failure.values[0]))
    message = f"`{shown(rule.head.car)}` would depend on its own absence: {circle}"
    span = rule.use.scope.analyser.spans.of(rule.head)
    return diagnostic("unstratified-rules", message, span, rule.use, None)


def shows(term: Value) -> Value:
    """TERM, with a constant for each #?x."""
    if term.__class__ is not Cons:
        return term
    if term.car is LOGICAL_BINDING:
        return UNKNOWN
    return Cons(shows(term.car), shows(term.cdr))


def is_of_library(name: Symbol) -> bool:
    """Whether NAME is a word of the language, such as POWER-STATE: the language may assert facts of it."""
    return name.package == ESL or name is DISCOUNT


def is_inside(span: Span, place: Span) -> bool:
    """Whether SPAN lies in PLACE."""
    begins = (place.line, place.column) <= (span.line, span.column)
    return (
        span.source is place.source
        and begins
        and (span.end_line, span.end_column) <= (place.end_line, place.end_column)
    )


def counted(number: int) -> str:
    """NUMBER arguments."""
    return f"{number} argument{'' if number == 1 else 's'}"


def warning(name: str, message: str, mention: Mention, hint: str | None) -> Diagnostic:
    """A warning about a mention."""
    return diagnostic(name, message, mention.span, mention.use, hint)._replace(severity="warning")


def diagnostic(name: str, message: str, span: Span | None, use: Use, hint: str | None) -> Diagnostic:
    """What is wrong at SPAN, or at USE."""
    place = span or use.span
    return Diagnostic(name, message, (Label(place),) if place is not None else (), use.within, hint)
