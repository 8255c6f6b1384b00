"""Hash tables: what a program can do with them (the tables are hashing.py).

A table is walked in the order in which its keys were first stored, so that the
same program always gives the same trace.
"""

from __future__ import annotations

from eslang.base.arguments import UNSUPPLIED, take_keys
from eslang.base.failure import simple_error, type_error
from eslang.base.hashing import KEY_OF, PLAIN, HashTable, equal_key
from eslang.base.lists import Cons, from_items
from eslang.base.many import pack
from eslang.base.number_kinds import is_ratio
from eslang.base.running import to_function
from eslang.base.symbols import Symbol, Value, truth
from eslang.base.text import Character
from eslang.compile.registry import function
from eslang.lisp.predicates import eq, eql, equal, equalp

_TEST_NAMES = {eq: "EQ", eql: "EQL", equal: "EQUAL", equalp: "EQUALP"}


def check_table(value: Value, operator: str) -> HashTable:
    """VALUE, if it is a hash table; else a type error."""
    if value.__class__ is HashTable:
        table: HashTable = value
        return table
    raise type_error(value, "HASH-TABLE", operator)


def _test_name(test: Value) -> str:
    if test is None:
        return "EQL"
    name = test.name if isinstance(test, Symbol) else _TEST_NAMES.get(test)
    if name in KEY_OF:
        return name
    raise simple_error("the test of a hash table is EQ, EQL, EQUAL or EQUALP, not", test)


@function("(make-hash-table &key test size rehash-size rehash-threshold weakness synchronized)")
def make_hash_table(*options: Value) -> Value:
    """Return an empty hash table with keys compared by TEST, or else EQL."""
    names = ("TEST", "SIZE", "REHASH-SIZE", "REHASH-THRESHOLD", "WEAKNESS", "SYNCHRONIZED")
    return HashTable(_test_name(take_keys(options, names)[0]))


@function("(hash-table-p object)")
def hash_table_p(value: Value) -> Value:
    """True if OBJECT is a hash table."""
    return truth(value.__class__ is HashTable)


def gethash_values(key: Value, table: Value, default: Value = None) -> Value:
    """What TABLE holds under KEY, and whether it does."""
    value = check_table(table, "GETHASH").get(key, UNSUPPLIED)
    return pack([default, None] if value is UNSUPPLIED else [value, truth(True)])


@function("(gethash key hash-table &optional default)", many=gethash_values)
def gethash(key: Value, table: Value, default: Value = None) -> Value:
    """Return what HASH-TABLE holds under KEY, or DEFAULT.

    Returns: second, whether HASH-TABLE holds anything under KEY.
    """
    if table.__class__ is not HashTable:
        raise type_error(table, "HASH-TABLE", "GETHASH")
    return table.entries.get(key if key.__class__ in PLAIN else table.key_of(key), default)


@function("(%set-gethash key hash-table &rest default-and-value)")
def set_gethash(key: Value, table: Value, value: Value, *more: Value) -> Value:
    """Let HASH-TABLE hold VALUE, the last argument, under KEY; return VALUE."""
    if more:
        (value,) = more  # what came before it was a default
    if table.__class__ is not HashTable:
        raise type_error(table, "HASH-TABLE", "GETHASH")
    if key.__class__ in PLAIN:
        table.entries[key] = value
    else:
        table.put(key, value)
    return value


@function("(remhash key hash-table)")
def remhash(key: Value, table: Value) -> Value:
    """Let HASH-TABLE hold nothing under KEY; true if it did hold something."""
    return truth(check_table(table, "REMHASH").remove(key))


@function("(clrhash hash-table)")
def clrhash(table: Value) -> Value:
    """Let HASH-TABLE hold nothing; return it."""
    check_table(table, "CLRHASH").clear()
    return table


@function("(maphash function hash-table)")
def maphash(f: Value, table: Value) -> Value:
    """Call FUNCTION with each key of HASH-TABLE and what it holds there.

    Keys that FUNCTION adds are not visited, those that it removes are.
    """
    call = to_function(f)
    for key, value in check_table(table, "MAPHASH").pairs():
        call(key, value)
    return None


@function("(hash-table-count hash-table)")
def hash_table_count(table: Value) -> Value:
    """Return the number of keys of HASH-TABLE."""
    return len(check_table(table, "HASH-TABLE-COUNT").entries)


@function("(hash-table-size hash-table)")
def hash_table_size(table: Value) -> Value:
    """Return how many keys HASH-TABLE has room for: as many as it has."""
    return hash_table_count(table)


@function("(hash-table-test hash-table)")
def hash_table_test(table: Value) -> Value:
    """Return the name of the test of HASH-TABLE."""
    return Symbol.intern(check_table(table, "HASH-TABLE-TEST").test, "COMMON-LISP")


@function("(%hash-table-pairs hash-table)")
def hash_table_pairs(table: Value) -> Value:
    """Return a list of (KEY . VALUE) for each key of HASH-TABLE."""
    return from_items([Cons(key, value) for key, value in check_table(table, "LOOP").pairs()])


@function("(%hash-table-keys hash-table)")
def hash_table_keys(table: Value) -> Value:
    """Return a list of the keys of HASH-TABLE."""
    return from_items(check_table(table, "LOOP").keys())


@function("(%hash-table-values hash-table)")
def hash_table_values(table: Value) -> Value:
    """Return a list of the values of HASH-TABLE."""
    return from_items(list(check_table(table, "LOOP").entries.values()))


@function("(sxhash object)")
def sxhash(value: Value) -> Value:
    """Return a number that is equal for values that are EQUAL, in every run."""
    from binascii import crc32

    key = equal_key(value)
    tokens = key[:_HASHED] if key.__class__ is tuple else (key,)
    return crc32(" ".join([_word(token) for token in tokens]).encode("utf-8", "surrogatepass"))


_HASHED = 64  # so much of a long structure counts


def _word(token: Value) -> str:
    """The same text for the same token, in every run."""
    if token.__class__ in (str, tuple, int, Character) or token is None or is_ratio(token):
        return repr(token)
    return token.name if isinstance(token, Symbol) else type(token).__name__
