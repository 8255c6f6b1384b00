"""Which macros may be expanded once and for all.

A text is kept compiled only if expanding it again could not matter: if a
macro's expander changes or reads state (a counter, a table of names), each run
must expand it. Judged from the compiled code of the expander and of what it
calls; in doubt it is not pure, which costs time and nothing else.
"""

from __future__ import annotations

import dis
from types import CodeType, FunctionType

from eslang.base.hints import Any
from eslang.base.image import Cell

PURE = frozenset(
    [
        "*",
        "+",
        "-",
        "/",
        "/=",
        "1+",
        "1-",
        "<",
        "<=",
        "=",
        ">",
        ">=",
        "ACONS",
        "ADJOIN",
        "APPEND",
        "APPLY",
        "AREF",
        "ARRAYP",
        "ASSOC",
        "ATOM",
        "BOUNDP",
        "BUTLAST",
        "CAAR",
        "CADDDR",
        "CADDR",
        "CADR",
        "CAR",
        "CDAAR",
        "CDADR",
        "CDAR",
        "CDDAR",
        "CDDDR",
        "CDDR",
        "CDR",
        "CHAR",
        "CHAR-CODE",
        "CHAR-DOWNCASE",
        "CHAR-UPCASE",
        "CHAR=",
        "CHARACTERP",
        "CODE-CHAR",
        "COERCE",
        "CONCATENATE",
        "CONS",
        "CONSP",
        "CONSTANTP",
        "COPY-LIST",
        "COPY-SEQ",
        "COPY-TREE",
        "COUNT",
        "COUNT-IF",
        "DIGIT-CHAR-P",
        "EIGHTH",
        "ELT",
        "ENDP",
        "EQ",
        "EQL",
        "EQUAL",
        "EQUALP",
        "ERROR",
        "EVENP",
        "EVERY",
        "FIFTH",
        "FIND",
        "FIND-IF",
        "FIRST",
        "FLOOR",
        "FOURTH",
        "FUNCALL",
        "FUNCTIONP",
        "GENSYM",
        "GETF",
        "IDENTITY",
        "INTEGERP",
        "INTERN",
        "KEYWORDP",
        "LAST",
        "LDIFF",
        "LENGTH",
        "LIST",
        "LIST*",
        "LIST-LENGTH",
        "LISTP",
        "MACROEXPAND",
        "MACROEXPAND-1",
        "MAKE-LIST",
        "MAKE-SYMBOL",
        "MAPCAN",
        "MAPCAR",
        "MAPLIST",
        "MAX",
        "MEMBER",
        "MEMBER-IF",
        "MIN",
        "MINUSP",
        "MOD",
        "NCONC",
        "NINTH",
        "NOT",
        "NOTANY",
        "NOTEVERY",
        "NREVERSE",
        "NSUBST",
        "NTH",
        "NTHCDR",
        "NULL",
        "NUMBERP",
        "ODDP",
        "PLUSP",
        "POSITION",
        "POSITION-IF",
        "PRIN1-TO-STRING",
        "PRINC-TO-STRING",
        "RASSOC",
        "REDUCE",
        "REM",
        "REMOVE",
        "REMOVE-DUPLICATES",
        "REMOVE-IF",
        "REMOVE-IF-NOT",
        "REST",
        "REVERSE",
        "ROUND",
        "SECOND",
        "SET-DIFFERENCE",
        "SEVENTH",
        "SIXTH",
        "SOME",
        "SORT",
        "STABLE-SORT",
        "STRING",
        "STRING-DOWNCASE",
        "STRING-UPCASE",
        "STRING=",
        "STRINGP",
        "SUBLIS",
        "SUBSEQ",
        "SUBST",
        "SYMBOL-NAME",
        "SYMBOL-PACKAGE",
        "SYMBOLP",
        "TENTH",
        "THIRD",
        "TRUNCATE",
        "TYPEP",
        "UNION",
        "VALUES",
        "VECTOR",
        "VECTORP",
        "ZEROP",
    ]
)


def is_pure(expander: Any, seen: set[int] | None = None) -> bool:
    """True if EXPANDER, given the same form, surely gives the same expansion and does nothing else."""
    if not isinstance(expander, FunctionType) or "%many" not in expander.__globals__:
        return True  # a macro of ours, in Python
    if expander.__code__.co_filename.startswith("<stdlib>"):
        return True
    seen = seen if seen is not None else set()
    if id(expander.__code__) in seen:
        return True
    seen.add(id(expander.__code__))
    return _is_pure_code(expander.__code__, expander.__globals__, seen)


def _is_pure_code(code: CodeType, names: dict[str, Any], seen: set[int]) -> bool:
    cell: Any = None
    for instruction in dis.get_instructions(code):
        if instruction.opname == "STORE_ATTR":
            return False
        if instruction.opname == "LOAD_GLOBAL":
            cell = names.get(instruction.argval)
        elif instruction.opname in ("LOAD_ATTR", "LOAD_METHOD") and isinstance(cell, Cell):
            if not _is_pure_use(cell, str(instruction.argval), seen):
                return False
            cell = None
    return all(_is_pure_code(inner, names, seen) for inner in code.co_consts if isinstance(inner, CodeType))


def _is_pure_use(cell: Cell, part: str, seen: set[int]) -> bool:
    """True if reading PART of CELL in an expander is harmless."""
    if part == "value":
        return cell.constant
    symbol = cell.symbol
    if symbol is None or part != "function":
        return False
    if symbol.package == "COMMON-LISP":
        return symbol.name in PURE or symbol.name.startswith("%DESTRUCTURE")
    made = getattr(cell, "function", None)
    return isinstance(made, FunctionType) and "%many" in made.__globals__ and is_pure(made, seen)
