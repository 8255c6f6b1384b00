"""Which symbol a name in a text means, in one interpreter.

The reader asks through a function, so that it needs to know no image; here is
the one that answers for an Image, with the packages as they are at that moment.
"""

from __future__ import annotations

from eslang.base.hints import Callable, Iterable
from eslang.base.image import Image
from eslang.base.symbols import Symbol

# (package name or None for the current one, name, external symbols only) → symbol; NIL is None
Resolve = Callable[[str | None, str, bool], Symbol | None]


class UnknownPackage(LookupError):
    """There is no package of that name; KNOWN are the names that there are."""

    def __init__(self, package: str, known: Iterable[str] = ()) -> None:
        super().__init__(package)
        self.package = package
        self.known = tuple(known)


class NotExternal(LookupError):
    """The package has no external symbol of that name.

    PRESENT tells whether it has one at all, EXTERNAL what can be had instead.
    """

    def __init__(self, package: str, name: str, present: bool = False, external: Iterable[str] = ()) -> None:
        super().__init__(package, name)
        self.package = package
        self.name = name
        self.present = present
        self.external = tuple(external)


def resolve_in(image: Image) -> Resolve:
    """The function that finds, or interns, the symbols that names mean in IMAGE."""

    def resolve(package_name: str | None, name: str, external_only: bool) -> Symbol | None:
        if package_name is None:
            return image.package.intern(name)
        package = image.packages.get(package_name)
        if package is None:
            raise UnknownPackage(package_name, image.packages)
        if external_only and package.name != "KEYWORD" and name not in package.external:
            _, present = package.find(name)
            raise NotExternal(package_name, name, present, package.external)
        return package.intern(name)

    return resolve


def symbol_called(text: str, resolve: Resolve) -> Symbol | None:
    """The symbol that TEXT names, with or without a package, in capitals or not."""
    package, mark, name = text.upper().rpartition(":")
    if not mark:
        return resolve(None, name, False)
    return resolve(package.rstrip(":") or "KEYWORD", name, False)
