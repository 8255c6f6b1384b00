"""Compiled code on disk, so that a text is read and compiled once.

What is kept of a text: the code of its top-level forms, its cells and
constants, and the variants of its functions. The key is everything it depends
on: the text, its name, what was defined before it, this package's own files,
and Python's version. A cache that cannot be read or written does no harm.
"""

from __future__ import annotations

import marshal
import os
import sys
from types import CodeType

from eslang.base.hints import Any, NamedTuple
from eslang.base.image import Image
from eslang.base.lists import Cons, from_items
from eslang.base.symbols import Symbol, Value
from eslang.base.text import CHARACTERS, Character, String, Vector
from eslang.compile.code import Code

try:
    from _blake2 import blake2b  # what hashlib has, without all that hashlib brings along
except ImportError:
    from hashlib import blake2b

FORMAT = 1
MOST = 300  # texts kept
DEEPEST = 60  # functions inside one another


class Uncachable(Exception):
    """A constant that cannot be written down."""


class Kept(NamedTuple):
    """What is kept of one text."""

    codes: list[CodeType]
    cells: list[tuple[str, Any]]
    constants: list[tuple[str, Any]]
    variants: bytes  # of a dict by number, taken apart only when one is wanted


def folder() -> str | None:
    """Where the cache is; None if there is to be none."""
    chosen = os.environ.get("ESLANG_CACHE")
    if chosen is not None:
        return chosen or None
    base = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return os.path.join(base, "eslang")


def fingerprint() -> str:
    """What changes whenever this package or Python does."""
    parts = [str(FORMAT), sys.version]
    pending = [os.path.dirname(os.path.dirname(__file__))]
    while pending:
        with os.scandir(pending.pop()) as entries:
            for entry in sorted(entries, key=lambda entry: entry.name):
                if entry.is_dir():
                    if entry.name != "__pycache__":
                        pending.append(entry.path)
                elif entry.name.endswith(".py"):
                    stat = entry.stat()
                    parts.append(f"{entry.name} {stat.st_size} {stat.st_mtime_ns}")
    return digest("\n".join(parts))


def digest(*parts: str) -> str:
    """One name for all PARTS."""
    return blake2b("\0".join(parts).encode("utf-8", "surrogatepass"), digest_size=20).hexdigest()


# --- reading and writing -------------------------------------------------------------


def fetch(key: str) -> list[Kept] | None:
    """What is kept under KEY; None if there is nothing, or nothing usable."""
    where = folder()
    if where is None:
        return None
    try:
        with open(os.path.join(where, key), "rb") as file:
            kept = memoryview(file.read())
        check, data = kept[:32], kept[32:]
        if blake2b(data, digest_size=32).digest() != check:
            return None
        os.utime(os.path.join(where, key))  # it was used: see `forget_old`
        return [Kept(*entry) for entry in marshal.loads(data)]
    except (OSError, ValueError, EOFError, TypeError):
        return None


def keep(key: str, entries: list[Kept]) -> None:
    """Keep ENTRIES under KEY, if that can be done."""
    where = folder()
    if where is None:
        return
    kept = os.path.join(where, key)
    temporary = f"{kept}.{os.getpid()}"
    try:
        data = marshal.dumps([tuple(entry) for entry in entries])
        os.makedirs(where, exist_ok=True)
        with open(temporary, "wb") as file:
            file.write(blake2b(data, digest_size=32).digest() + data)
        os.replace(temporary, kept)
        forget_old(where)
    except (OSError, ValueError):
        return


def forget_old(where: str) -> None:
    """Remove the texts that were not used for longest, when there are many. Raises OSError."""
    names = os.listdir(where)
    if len(names) > MOST:
        paths = [os.path.join(where, name) for name in names]
        for path in sorted(paths, key=os.path.getmtime)[: MOST // 2]:
            os.remove(path)


# --- texts ---------------------------------------------------------------------------


def write_down(compiler: Any) -> Kept | None:
    """What is to be kept of a text that COMPILER has compiled whole; None if it cannot be."""
    unit = compiler.unit
    if any(nesting(lambda_.procedure) > DEEPEST for lambda_ in unit.lambdas):
        return None  # each variant holds those inside it: that grows too fast
    try:
        fresh: dict[int, int] = {}
        cells = [(name, _encode(symbol, fresh)) for symbol, name in unit.cells.items()]
        constants = [(name, _encode(value, fresh)) for name, value in unit.constants.values()]
        variants = {
            number: code
            for number in range(1, len(unit.lambdas) + 1)
            if (code := unit.variant_code(number)) is not None
        }
        return Kept(compiler.codes, cells, constants, marshal.dumps(variants))
    except (Uncachable, RecursionError, ValueError):
        return None


def nesting(procedure: Any) -> int:
    """How many functions stand around PROCEDURE; beyond DEEPEST they are not counted on."""
    depth = 0
    while procedure is not None and depth <= DEEPEST:
        procedure = procedure.parent
        depth += 1
    return depth


def take_up(kept: Kept, image: Image, support: dict[str, Any]) -> Code:
    """The code of a text that was kept."""
    code = Code(image, support)
    fresh: dict[int, Symbol] = {}
    for name, encoded in kept.cells:
        code.add_cell(name, _decode(encoded, image, fresh))
    for name, encoded in kept.constants:
        code.add_constant(name, _decode(encoded, image, fresh))
    code.make_variants = lambda: dict(marshal.loads(kept.variants))
    return code


# --- constants -----------------------------------------------------------------------


def _encode(value: Value, fresh: dict[int, int]) -> Any:
    """VALUE in what marshal can write; FRESH numbers the uninterned symbols."""
    if value is None or value.__class__ in (int, float):
        return value
    if isinstance(value, Symbol):
        if value.package is None:
            return ("g", fresh.setdefault(id(value), len(fresh)), value.name)
        return ("s", value.package, value.name)
    kind = value.__class__
    if kind is String:
        return ("t", value.text)
    if kind is Character:
        return ("c", value.char)
    if kind is Cons:
        elements = []
        rest = value
        while rest.__class__ is Cons:
            elements.append(_encode(rest.car, fresh))
            rest = rest.cdr
            if rest is value:
                raise Uncachable
        return ("l", elements, _encode(rest, fresh))
    if kind is Vector and value.fill is None:
        return ("v", [_encode(element, fresh) for element in value.items])
    if kind is tuple:
        return ("k", [_encode(element, fresh) for element in value])
    if kind.__name__ == "Ratio":
        return ("r", value.numerator, value.denominator)
    raise Uncachable


def _decode(encoded: Any, image: Image, fresh: dict[int, Symbol]) -> Value:
    if encoded.__class__ is not tuple:
        return encoded
    match encoded[0]:
        case "s":
            return _symbol(encoded[1], encoded[2], image)
        case "t":
            return String(encoded[1])
        case "l":
            return from_items(
                [_decode(element, image, fresh) for element in encoded[1]], _decode(encoded[2], image, fresh)
            )
        case "g":
            return fresh.setdefault(encoded[1], Symbol.uninterned(encoded[2]))
        case "c":
            return CHARACTERS[encoded[1]]
        case "v":
            return Vector([_decode(element, image, fresh) for element in encoded[1]])
        case "k":
            return tuple(_decode(element, image, fresh) for element in encoded[1])
    from eslang.base.ratios import Ratio

    return Ratio(encoded[1], encoded[2])


def _symbol(package: str, name: str, image: Image) -> Symbol:
    """An interned symbol, present in its home package as if it had been read."""
    symbol = Symbol.intern(name, package)
    home = image.packages.get(package)
    if home is not None and name not in home.present:
        home.present[name] = symbol
    return symbol
