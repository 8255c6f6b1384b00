"""What the compute rows measure, as a Python programmer writes it."""

from __future__ import annotations


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


def deep(n: int) -> int:
    if n == 0:
        return 0
    return 1 + deep(n - 1)
