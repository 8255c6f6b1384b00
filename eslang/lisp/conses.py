"""Conses and the lists they make: parts, copies, and joining.

Lists may be dotted or circular wherever Common Lisp allows it.
"""

from __future__ import annotations

from itertools import repeat
from operator import attrgetter

from eslang.base.arguments import check_index, take_keys
from eslang.base.failure import type_error
from eslang.base.hints import Callable
from eslang.base.lists import SUSPICIOUS, Cons, check_end, from_items, items, lisp_list
from eslang.base.sameness import is_eql
from eslang.base.symbols import Value, truth
from eslang.compile.registry import function

function("(list &rest elements)")(lisp_list)


@function("(cons car cdr)")
def cons(car: Value, cdr: Value) -> Value:
    """Return a new pair of CAR and CDR."""
    return Cons(car, cdr)


@function("(car list)")
def car(lst: Value) -> Value:
    """Return the first element of LIST; NIL if LIST is empty."""
    if lst.__class__ is Cons:
        return lst.car
    if lst is None:
        return None
    raise type_error(lst, "LIST", "CAR")


@function("(cdr list)")
def cdr(lst: Value) -> Value:
    """Return what follows the first element of LIST; NIL if LIST is empty."""
    if lst.__class__ is Cons:
        return lst.cdr
    if lst is None:
        return None
    raise type_error(lst, "LIST", "CDR")


function("(rest list)")(cdr)


def _check_cons(cell: Value, operator: str) -> None:
    if cell.__class__ is not Cons:
        raise type_error(cell, "CONS", operator)


@function("(rplaca cons object)")
def rplaca(cell: Value, value: Value) -> Value:
    """Make OBJECT the car of CONS; return CONS."""
    _check_cons(cell, "RPLACA")
    cell.car = value
    return cell


@function("(rplacd cons object)")
def rplacd(cell: Value, value: Value) -> Value:
    """Make OBJECT the cdr of CONS; return CONS."""
    _check_cons(cell, "RPLACD")
    cell.cdr = value
    return cell


@function("(%set-car cons value)")
def set_car(cell: Value, value: Value) -> Value:
    """Make VALUE the car of CONS; return VALUE."""
    rplaca(cell, value)
    return value


@function("(%set-cdr cons value)")
def set_cdr(cell: Value, value: Value) -> Value:
    """Make VALUE the cdr of CONS; return VALUE."""
    rplacd(cell, value)
    return value


function("(%set-rest cons value)")(set_cdr)


def _compose(letters: str) -> Callable[[Value], Value]:
    """C...R of LETTERS: a chain of attributes, or step by step where the chain ends early."""
    steps = [car if letter == "a" else cdr for letter in reversed(letters)]
    chain = attrgetter(".".join(step.__name__ for step in steps))

    def access(lst: Value) -> Value:
        try:
            return chain(lst)
        except AttributeError:
            for step in steps:
                lst = step(lst)
            return lst

    return access


def _compose_setter(letters: str) -> Callable[[Value, Value], Value]:
    change = set_car if letters[0] == "a" else set_cdr
    if len(letters) == 1:
        return change
    reach = _compose(letters[1:])
    return lambda lst, value: change(reach(lst), value)


def _register_parts() -> None:
    """CAAR to CDDDDR, FIRST to TENTH, and what changes the same places."""
    words = ["a", "d"]
    for _ in range(3):
        words = [letter + word for letter in "ad" for word in words]
        for word in words:
            inner = " (".join(f"C{letter}R".upper() for letter in word)
            _register_part(f"c{word}r", word, f"({inner} LIST{')' * len(word)}")
    ordinals = "first second third fourth fifth sixth seventh eighth ninth tenth"
    for place, ordinal in enumerate(ordinals.split()):
        _register_part(ordinal, "a" + "d" * place, f"the {ordinal} element of LIST")


def _register_part(name: str, letters: str, words: str) -> None:
    access, change = _compose(letters), _compose_setter(letters)
    access.__name__ = name
    access.__doc__ = f"Return {words}; NIL, if LIST ends before."
    function(f"({name} list)")(access)
    if change is not set_car:
        change.__name__ = f"set_{name}"
        change.__doc__ = f"Make VALUE {words}; return VALUE."
    function(f"(%set-{name} list value)")(change)


_register_parts()


@function("(nthcdr n list)")
def nthcdr(n: Value, lst: Value) -> Value:
    """Return LIST without its first N elements."""
    for _ in range(check_index(n, "NTHCDR")):
        if lst is None:
            return None
        lst = cdr(lst)
    return lst


@function("(nth n list)")
def nth(n: Value, lst: Value) -> Value:
    """Return element N of LIST, counted from 0; NIL beyond the end."""
    if n.__class__ is int and n >= 0:
        rest = lst
        try:
            for _ in range(n):
                rest = rest.cdr
            return rest.car
        except AttributeError:
            pass  # step by step, then
    return car(nthcdr(check_index(n, "NTH"), lst))


@function("(%set-nth n list value)")
def set_nth(n: Value, lst: Value, value: Value) -> Value:
    """Make VALUE element N of LIST; return VALUE."""
    return set_car(nthcdr(n, lst), value)


@function("(endp list)")
def endp(lst: Value) -> Value:
    """True if LIST is empty; it must be a list."""
    if lst is not None and lst.__class__ is not Cons:
        raise type_error(lst, "LIST", "ENDP")
    return truth(lst is None)


@function("(list* element &rest more)")
def list_star(element: Value, *more: Value) -> Value:
    """Return a list of the arguments whose tail is the last of them."""
    if not more:
        return element
    return Cons(element, from_items(more[:-1], more[-1]))


@function("(make-list size &key initial-element)")
def make_list(size: Value, *options: Value) -> Value:
    """Return a list of SIZE elements, each INITIAL-ELEMENT."""
    (element,) = take_keys(options, ("INITIAL-ELEMENT",))
    return from_items([element] * check_index(size, "MAKE-LIST"))


def _cells(lst: Value) -> list[Value]:
    """The conses of a list, proper or dotted."""
    cells: list[Value] = []
    rest = lst
    while True:
        for _ in repeat(None, SUSPICIOUS):
            if rest.__class__ is not Cons:
                return cells
            cells.append(rest)
            rest = rest.cdr
        check_end(lst)


def _check_list(lst: Value, operator: str) -> None:
    if lst is not None and lst.__class__ is not Cons:
        raise type_error(lst, "LIST", operator)


@function("(last list &optional (n 1))")
def last(lst: Value, n: Value = 1) -> Value:
    """Return the last N conses of LIST."""
    _check_list(lst, "LAST")
    if n == 1 and lst is not None:
        rest = lst
        for _ in repeat(None, SUSPICIOUS):
            if rest.cdr.__class__ is not Cons:
                return rest
            rest = rest.cdr
    cells = _cells(lst)
    if check_index(n, "LAST") >= len(cells):
        return lst
    return cells[-n] if n else cells[-1].cdr


@function("(butlast list &optional (n 1))")
def butlast(lst: Value, n: Value = 1) -> Value:
    """Return a copy of LIST without its last N elements."""
    _check_list(lst, "BUTLAST")
    cells = _cells(lst)
    return from_items([cell.car for cell in cells[: max(0, len(cells) - check_index(n, "BUTLAST"))]])


@function("(nbutlast list &optional (n 1))")
def nbutlast(lst: Value, n: Value = 1) -> Value:
    """Cut the last N elements off LIST and return it."""
    _check_list(lst, "NBUTLAST")
    cells = _cells(lst)
    kept = len(cells) - check_index(n, "NBUTLAST")
    if kept <= 0:
        return None
    cells[kept - 1].cdr = None
    return lst


@function("(append &rest lists)")
def append(*lists: Value) -> Value:
    """Return the elements of LISTS in one list; the last of LISTS is its tail."""
    if not lists:
        return None
    result = lists[-1]
    for lst in lists[-2::-1]:
        if lst is not None:
            result = from_items(items(lst), result)
    return result


@function("(nconc &rest lists)")
def nconc(*lists: Value) -> Value:
    """Join LISTS by changing the last cdr of each."""
    result = end = None
    for place, lst in enumerate(lists):
        if lst is None:
            continue
        if lst.__class__ is not Cons and place < len(lists) - 1:
            raise type_error(lst, "LIST", "NCONC")
        if end is None:
            result = lst
        else:
            end.cdr = lst
        end = last(lst) if lst.__class__ is Cons else None
    return result


@function("(revappend list tail)")
def revappend(lst: Value, tail: Value) -> Value:
    """Return the elements of LIST in reverse, and TAIL behind them."""
    for element in items(lst):
        tail = Cons(element, tail)
    return tail


@function("(nreconc list tail)")
def nreconc(lst: Value, tail: Value) -> Value:
    """Turn LIST round in place, with TAIL behind it."""
    while lst is not None:
        _check_list(lst, "NRECONC")
        lst.cdr, tail, lst = tail, lst, lst.cdr
    return tail


@function("(copy-list list)")
def copy_list(lst: Value) -> Value:
    """Return a new list of the elements of LIST; a dotted end is kept."""
    _check_list(lst, "COPY-LIST")
    cells = _cells(lst)
    return from_items([cell.car for cell in cells], cells[-1].cdr) if cells else None


@function("(list-length list)")
def list_length(lst: Value) -> Value:
    """Return the number of elements of LIST; NIL if it is circular."""
    slow, count = lst, 0
    while lst is not None:
        _check_list(lst, "LIST-LENGTH")
        lst = lst.cdr
        count += 1
        if count % 2 == 0:
            slow = slow.cdr
            if slow is lst and lst is not None:
                return None
    return count


@function("(ldiff list tail)")
def ldiff(lst: Value, tail: Value) -> Value:
    """Return a copy of that part of LIST which stands before TAIL."""
    _check_list(lst, "LDIFF")
    before: list[Value] = []
    for cell in _cells(lst):
        if cell is tail:
            return from_items(before)
        before.append(cell.car)
        lst = cell.cdr
    return from_items(before, None if is_eql(lst, tail) else lst)


@function("(tailp tail list)")
def tailp(tail: Value, lst: Value) -> Value:
    """True if TAIL is LIST or one of its tails."""
    for cell in _cells(lst):
        if cell is tail:
            return truth(True)
        lst = cell.cdr
    return truth(is_eql(lst, tail))
