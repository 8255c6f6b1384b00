"""What is remembered of queries by their shape: by all that they say but for their constants.

Most queries say something of symbols, integers and variables. These are looked
up term by term while they are read, and nothing is checked: queries that are
wrong are not among those that are remembered. All others are read into tokens.
"""

from __future__ import annotations

from eslang.base.hints import Any, Iterable
from eslang.base.symbols import Symbol, Value
from eslang.facts.goals import CLOSE, CONNECTIVES, CONSTANT, Constants, Tokens
from eslang.facts.terms import DIRECT

Node = dict[Any, Any]  # by the next token
FEW = range(200)  # terms; longer queries are rare, and some have no end
END = object()  # behind the last token stands what is remembered
UNKNOWN: Node = {}


class Shapes:
    """Something for each of some shapes."""

    def __init__(self) -> None:
        self.root: Node = {}
        self.by_tokens: dict[Tokens, Any] = {}

    def __len__(self) -> int:
        return len(self.by_tokens)

    def values(self) -> Iterable[Any]:
        """All that is remembered."""
        return self.by_tokens.values()

    def put(self, tokens: Tokens, value: Any) -> None:
        """Remember VALUE for the queries that say TOKENS."""
        self.by_tokens[tokens] = value
        node = self.root
        for token in tokens:
            node = node.setdefault(token, {})
        node[END] = value

    def clear(self) -> None:
        """Remember nothing."""
        self.root.clear()
        self.by_tokens.clear()


def behind(node: Node, query: Value, constants: Constants) -> Node:
    """The node behind the shape of a plain QUERY, whose CONSTANTS are noted; UNKNOWN for all else."""
    try:
        operator = query.car
        node = node[operator]
        rest = query.cdr
        for _ in FEW:
            if rest is None:
                return node
            term = rest.car
            kind = term.__class__
            if kind is Symbol and (name := term.name) < "@" and name >= "?":
                node = node[term]
            elif kind in DIRECT:
                node = node[CONSTANT]
                constants.append(term)
            elif operator in CONNECTIVES:
                node = behind(node, term, constants)[CLOSE]
            else:
                break
            rest = rest.cdr
    except (AttributeError, KeyError, TypeError):  # no list, or one that nobody knows
        pass
    return UNKNOWN
