"""The grammar of esl.lark as tables: what Lark makes of it, in the shape the reader wants.

Lark analyses the grammar and gives the LALR table and the terminals. From these
come one pattern that finds the next token, and for each state where a symbol
leads and which rule, if any, is to be reduced there. Importing Lark is slow,
so it is done when the first text is read.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from eslang.base.hints import Any, NamedTuple

GRAMMAR = Path(__file__).with_name("esl.lark")
END, WRONG = "END", "WRONG"  # beside the grammar's terminals: the text's end, and what is none


class Rule(NamedTuple):
    """A rule that a state reduces: so many symbols become ORIGIN, by what ACTION names."""

    size: int
    origin: str
    action: str


class Tables(NamedTuple):
    """The grammar, ready to be run."""

    pattern: re.Pattern[str]  # blanks, then one token in the group of its name
    paths: list[dict[str, int]]  # of each state: symbol → next state
    rules: list[Rule | None]  # of each state: the rule to reduce there
    start: int
    end: int  # where a whole form leads


@cache
def tables() -> Tables:
    """The tables of our grammar, made once."""
    from lark import Lark

    lark = Lark(GRAMMAR.read_text(encoding="utf-8"), parser="lalr", lexer="basic")
    table = lark.parse_interactive("").parser_state.parse_conf.parse_table
    numbers = {state: number for number, state in enumerate(table.states)}
    paths: list[dict[str, int]] = []
    rules: list[Rule | None] = []
    for actions in table.states.values():
        reduced = {argument for action, argument in actions.values() if action.name == "Reduce"}
        assert len(reduced) <= 1, "the grammar is no longer LR(0)"
        rules.append(_rule(reduced.pop()) if reduced else None)
        paths.append({} if rules[-1] else {str(symbol): numbers[to] for symbol, (_, to) in actions.items()})
    for path in paths:
        for symbol in path:
            path[symbol] = _beyond_units(path, symbol, rules)
    start = numbers[table.start_states["start"]]
    return Tables(_pattern(lark), paths, rules, start, paths[start]["start"])


def _rule(rule: Any) -> Rule:
    return Rule(len(rule.expansion), str(rule.origin.name), str(rule.alias or ""))


def _beyond_units(path: dict[str, int], symbol: str, rules: list[Rule | None]) -> int:
    """Where SYMBOL leads, past the rules that only call one thing another."""
    state = path[symbol]
    rule = rules[state]
    while rule is not None and not rule.action and rule.origin in path:
        state = path[rule.origin]
        rule = rules[state]
    return state


def _pattern(lark: Any) -> re.Pattern[str]:
    """Blanks and comments, then the next token."""
    terminals = sorted(lark.terminals, key=lambda terminal: -terminal.priority)
    texts = {terminal.name: terminal.pattern.to_regexp() for terminal in terminals}
    blank = f"(?:{texts.pop('BLANK')}|{texts.pop('COMMENT')})*"
    tokens = "|".join([f"(?P<{name}>{text})" for name, text in texts.items()])
    return re.compile(f"{blank}(?:{tokens}|(?P<{END}>\\Z)|(?P<{WRONG}>))")
