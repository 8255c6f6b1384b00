"""Records: tuples whose places have names.

What `typing.NamedTuple` makes, made without compiling anything: a start has no
time for that. Files write `NamedTuple`, which hints.py lends to both readers:
type checkers see Python's own, a running program sees this one.
"""

from __future__ import annotations

from operator import itemgetter


class Naming(type):
    """Makes each annotated name of a class body a place of the tuple; a value given there is its default."""

    def __new__(cls, name: str, bases: tuple[type, ...], body: dict[str, object]) -> Naming:
        """The class of that body."""
        annotated: dict[str, str] = body.get("__annotations__", {})  # type: ignore[assignment]
        names = tuple(field for field in annotated if not field.startswith("_"))
        defaults = {field: body.pop(field) for field in names if field in body}
        places = {field: property(itemgetter(place)) for place, field in enumerate(names)}
        return super().__new__(
            cls, name, bases, {"__slots__": (), **body, **places, "_fields": names, "_defaults": defaults}
        )


class Record(tuple[object, ...], metaclass=Naming):
    """The class of all records: `class Span(Record): start: int; end: int = 0`."""

    _fields: tuple[str, ...]
    _defaults: dict[str, object]

    def __new__(cls, *values: object, **named: object) -> Record:
        """A record of VALUES in their order, then of those given by name, then of the defaults."""
        if named or len(values) != len(cls._fields):
            given = dict(zip(cls._fields, values, strict=False))
            every = {**cls._defaults, **given, **named}
            if len(values) > len(cls._fields) or every.keys() != set(cls._fields) or given.keys() & named:
                raise TypeError(f"{cls.__name__} takes {', '.join(cls._fields)}")
            values = tuple(every[field] for field in cls._fields)
        return tuple.__new__(cls, values)

    def _replace(self, **changes: object) -> Record:
        """The same record but for CHANGES."""
        return type(self)(**{**dict(zip(self._fields, self, strict=True)), **changes})

    def __getnewargs__(self) -> tuple[object, ...]:
        return tuple(self)

    def __repr__(self) -> str:
        shown = (f"{field}={value!r}" for field, value in zip(self._fields, self, strict=True))
        return f"{type(self).__name__}({', '.join(shown)})"
