"""What the compute rows measure, as a Python programmer writes it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def fib(n: int) -> int:
    if n < 2:
        return n
    return fib(n - 1) + fib(n - 2)


def tak(x: int, y: int, z: int) -> int:
    if not y < x:
        return z
    return tak(tak(x - 1, y, z), tak(y - 1, z, x), tak(z - 1, x, y))


def is_safe(row: int, placed: list[int]) -> bool:
    distance = 1
    for other in placed:
        if other == row or abs(other - row) == distance:
            return False
        distance += 1
    return True


def queens(size: int, placed: list[int], left: int) -> int:
    if left == 0:
        return 1
    count = 0
    for row in range(size):
        if is_safe(row, placed):
            count += queens(size, [row, *placed], left - 1)
    return count


def string_work(text: str, rounds: int) -> int:
    found = 0
    for _ in range(rounds):
        letters = []
        for c in text:
            if c.isalpha():
                letters.append(chr(97 + (3 + ord(c.lower()) - 97) % 26))
            else:
                letters.append(c)
        shifted = "".join(letters)
        found += shifted.count("e")
        if shifted[::-1][::-1] == shifted:
            found += 1
        if "gdb" in shifted + "-gdb":
            found += 1
        found += len(shifted.upper())
    return found


def list_work(size: int, rounds: int) -> int:
    total = 0
    for _ in range(rounds):
        numbers = [i * 7919 % 1009 for i in range(size)]
        squares = [x * x for x in numbers]
        odd = [x for x in squares if x % 2]
        pairs = list(zip(numbers, squares, strict=True))
        total += sum(odd)
        total += len(odd + numbers[::-1])
        total += sorted(numbers)[0]
        for number, square in pairs:
            total += square - number * number
    return total


class Pair:
    """A cons, as a Python programmer would make it."""

    __slots__ = ("head", "tail")

    def __init__(self, head: Any, tail: Any) -> None:
        self.head = head
        self.tail = tail


def is_safe_on_pairs(row: int, placed: Any) -> bool:
    distance = 1
    while placed is not None:
        other = placed.head
        if other == row or abs(other - row) == distance:
            return False
        distance += 1
        placed = placed.tail
    return True


def queens_on_pairs(size: int, placed: Any, left: int) -> int:
    if left == 0:
        return 1
    count = 0
    for row in range(size):
        if is_safe_on_pairs(row, placed):
            count += queens_on_pairs(size, Pair(row, placed), left - 1)
    return count


def mapped(function: Callable[[Any], Any], pairs: Any) -> Any:
    first = last = Pair(None, None)
    while pairs is not None:
        last.tail = last = Pair(function(pairs.head), None)
        pairs = pairs.tail
    return first.tail


def zipped(left: Any, right: Any) -> Any:
    first = last = Pair(None, None)
    while left is not None:
        last.tail = last = Pair(Pair(left.head, right.head), None)
        left, right = left.tail, right.tail
    return first.tail


def filtered(function: Callable[[Any], bool], pairs: Any) -> Any:
    first = last = Pair(None, None)
    while pairs is not None:
        if function(pairs.head):
            last.tail = last = Pair(pairs.head, None)
        pairs = pairs.tail
    return first.tail


def reversed_pairs(pairs: Any) -> Any:
    result = None
    while pairs is not None:
        result = Pair(pairs.head, result)
        pairs = pairs.tail
    return result


def joined(pairs: Any, tail: Any) -> Any:
    first = last = Pair(None, None)
    while pairs is not None:
        last.tail = last = Pair(pairs.head, None)
        pairs = pairs.tail
    last.tail = tail
    return first.tail


def as_list(pairs: Any) -> list[Any]:
    result = []
    while pairs is not None:
        result.append(pairs.head)
        pairs = pairs.tail
    return result


def as_pairs(values: list[Any]) -> Any:
    result = None
    for value in reversed(values):
        result = Pair(value, result)
    return result


def list_work_on_pairs(size: int, rounds: int) -> int:
    total = 0
    for _ in range(rounds):
        numbers = as_pairs([i * 7919 % 1009 for i in range(size)])
        squares = mapped(lambda x: x * x, numbers)
        odd = filtered(lambda x: x % 2 == 1, squares)
        pairs = zipped(numbers, squares)
        rest = odd
        while rest is not None:
            total += rest.head
            rest = rest.tail
        total += len(as_list(joined(odd, reversed_pairs(numbers))))
        total += as_pairs(sorted(as_list(numbers))).head
        while pairs is not None:
            total += pairs.head.tail - pairs.head.head * pairs.head.head
            pairs = pairs.tail
    return total


def deep(n: int) -> int:
    if n == 0:
        return 0
    return 1 + deep(n - 1)
