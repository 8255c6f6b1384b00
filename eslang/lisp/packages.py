"""Packages as plans see them: finding, making and changing name spaces (CLHS 11).

A package is designated by itself or by its name, a string or symbol. The macros
DEFPACKAGE, IN-PACKAGE and DO-SYMBOLS expand into the % functions here.
"""

from __future__ import annotations

from eslang.base.arguments import UNSUPPLIED, take_keys
from eslang.base.failure import simple_error, type_error
from eslang.base.hints import Callable
from eslang.base.image import PACKAGE, Image
from eslang.base.lists import Cons, from_items, items
from eslang.base.many import Values
from eslang.base.packages import Package
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.text import String
from eslang.compile.registry import function
from eslang.lisp.predicates import is_symbol
from eslang.lisp.strings import check_string, text_of

_INTERNAL, _EXTERNAL, _INHERITED = Keyword("INTERNAL"), Keyword("EXTERNAL"), Keyword("INHERITED")
_DEFAULT = Keyword("DEFAULT")


def _image() -> Image:
    image: Image = running.session.image
    return image


def package_called(designator: Value, name: str) -> Package:
    """The package that DESIGNATOR means, NIL being the current one; a failure if there is none."""
    if designator is None:
        return _image().package
    if isinstance(designator, Package):
        return designator
    found = _image().packages.get(text_of(designator, name))
    if found is None:
        raise simple_error(f"{name.upper()}: there is no such package", designator)
    return found


def _listed(designator: Value) -> list[Value]:
    """The elements of a list, or DESIGNATOR alone where it is none."""
    if designator is None:
        return []
    return items(designator) if designator.__class__ is Cons else [designator]


def _status(package: Package, name: str) -> tuple[Value, Value]:
    """The symbol called NAME in PACKAGE, and how it is accessible; NIL NIL if it is not."""
    symbol, found = package.find(name)
    if not found:
        return None, None
    if name in package.present:
        return symbol, _EXTERNAL if name in package.external else _INTERNAL
    return symbol, _INHERITED


def _intern(name: Value, package: Value) -> tuple[Value, Value]:
    where = package_called(package, "intern")
    text = check_string(name, "intern").text
    symbol, status = _status(where, text)
    return (symbol, status) if status is not None else (where.intern(text), None)


def _intern_many(name: Value, package: Value = None) -> Value:
    return Values(_intern(name, package))


@function("(intern name &optional package)", many=_intern_many)
def intern(name: Value, package: Value = None) -> Value:
    """Return the symbol called NAME in PACKAGE, made if there is none.

    Returns: the symbol and, as second value, :internal, :external, :inherited,
             or NIL if it is new.
    """
    return _intern(name, package)[0]


def _find_symbol(name: Value, package: Value) -> tuple[Value, Value]:
    return _status(package_called(package, "find-symbol"), check_string(name, "find-symbol").text)


def _find_symbol_many(name: Value, package: Value = None) -> Value:
    return Values(_find_symbol(name, package))


@function("(find-symbol name &optional package)", many=_find_symbol_many)
def find_symbol(name: Value, package: Value = None) -> Value:
    """Return the symbol called NAME in PACKAGE; NIL if there is none.

    Returns: the symbol and, as second value, :internal, :external, :inherited,
             or NIL if there is none.
    """
    return _find_symbol(name, package)[0]


@function('(gentemp &optional (prefix "T") package)')
def gentemp(prefix: Value = None, package: Value = None) -> Value:
    """Return a new symbol of PACKAGE; its name is PREFIX and a number."""
    where = package_called(package, "gentemp")
    start = "T" if prefix is None else check_string(prefix, "gentemp").text
    while True:
        name = f"{start}{_image().count('GENTEMP')}"
        if not where.find(name)[1]:
            return where.intern(name)


@function("(symbol-package symbol)")
def symbol_package(symbol: Value) -> Value:
    """Return the package that SYMBOL belongs to; NIL if it belongs to none."""
    if not is_symbol(symbol):
        raise type_error(symbol, "SYMBOL", "symbol-package")
    home = "COMMON-LISP" if symbol is None else symbol.package
    return _image().packages.get(home) if home is not None else None


@function("(find-package name)")
def find_package(name: Value) -> Value:
    """Return the package called NAME; NIL if there is none."""
    if isinstance(name, Package):
        return name
    return _image().packages.get(text_of(name, "find-package"))


@function("(package-name package)")
def package_name(package: Value) -> Value:
    """Return the name of PACKAGE."""
    return String(package_called(package, "package-name").name)


@function("(package-nicknames package)")
def package_nicknames(package: Value) -> Value:
    """Return the other names of PACKAGE."""
    return from_items([String(name) for name in package_called(package, "package-nicknames").nicknames])


@function("(package-use-list package)")
def package_use_list(package: Value) -> Value:
    """Return the packages that PACKAGE inherits from."""
    return from_items(package_called(package, "package-use-list").uses)


@function("(package-used-by-list package)")
def package_used_by_list(package: Value) -> Value:
    """Return the packages that inherit from PACKAGE."""
    used = package_called(package, "package-used-by-list")
    return from_items([other for other in _all_packages() if used in other.uses])


@function("(package-shadowing-symbols package)")
def package_shadowing_symbols(package: Value) -> Value:
    """Return the symbols that PACKAGE has whatever it inherits."""
    where = package_called(package, "package-shadowing-symbols")
    return from_items([where.present[name] for name in sorted(where.shadowing)])


def _all_packages() -> list[Package]:
    return list(dict.fromkeys(_image().packages.values()))


@function("(list-all-packages)")
def list_all_packages() -> Value:
    """Return every package."""
    return from_items(_all_packages())


@function("(make-package name &key nicknames use)")
def make_package(name: Value, *options: Value) -> Value:
    """Make a package called NAME that uses those of USE, or COMMON-LISP."""
    nicknames, use = take_keys(options, ("NICKNAMES", "USE"), UNSUPPLIED)
    text = text_of(name, "make-package")
    others = [] if nicknames is UNSUPPLIED else [text_of(n, "make-package") for n in items(nicknames)]
    for each in (text, *others):
        if each in _image().packages:
            raise simple_error("MAKE-PACKAGE: the name is taken", String(each))
    return _new_package(text, others, _DEFAULT if use is UNSUPPLIED else use)


def _new_package(name: str, nicknames: list[str], use: Value) -> Package:
    package = _image().add_package(Package(name, nicknames))
    _use(package, use)
    return package


def _use(package: Package, use: Value) -> None:
    for designator in [String("COMMON-LISP")] if use is _DEFAULT else _listed(use):
        package.use(package_called(designator, "use-package"))


@function("(delete-package package)")
def delete_package(package: Value) -> Value:
    """Forget PACKAGE, which no other package may use."""
    gone = package_called(package, "delete-package")
    if package_used_by_list(gone) is not None:
        raise simple_error("DELETE-PACKAGE: other packages use it", gone)
    packages = _image().packages
    for name in [name for name, known in packages.items() if known is gone]:
        del packages[name]
    return T


def _register_change(name: str, change: Callable[[Package, Value], None], doc: str) -> None:
    def apply(designators: Value, package: Value = None) -> Value:
        where = package_called(package, name)
        for designator in _listed(designators):
            change(where, designator)
        return T

    apply.__name__, apply.__doc__ = name, doc
    function(f"({name} designators &optional package)")(apply)


def _check_symbol(value: Value, name: str) -> None:
    if not isinstance(value, Symbol):
        raise type_error(value, "SYMBOL", name)


def _export(package: Package, symbol: Value) -> None:
    _check_symbol(symbol, "export")
    if package.find(symbol.name) != (symbol, True):
        raise simple_error("EXPORT: the symbol is not accessible in the package", symbol, package)
    package.export(symbol.name)


def _unexport(package: Package, symbol: Value) -> None:
    _check_symbol(symbol, "unexport")
    package.external.discard(symbol.name)


def _import(package: Package, symbol: Value) -> None:
    _check_symbol(symbol, "import")
    there, found = package.find(symbol.name)
    if found and there is not symbol:
        raise simple_error("IMPORT: another symbol of that name is there", symbol, package)
    package.import_symbol(symbol)


def _shadowing_import(package: Package, symbol: Value) -> None:
    _check_symbol(symbol, "shadowing-import")
    package.import_symbol(symbol, shadowing=True)


def _shadow(package: Package, name: Value) -> None:
    package.shadow(text_of(name, "shadow"))


def _use_package(package: Package, used: Value) -> None:
    package.use(package_called(used, "use-package"))


def _unuse_package(package: Package, used: Value) -> None:
    other = package_called(used, "unuse-package")
    if other in package.uses:
        package.uses.remove(other)


_register_change("export", _export, "Make DESIGNATORS, one symbol or a list, external in PACKAGE.")
_register_change("unexport", _unexport, "Make DESIGNATORS, one symbol or a list, internal in PACKAGE.")
_register_change("import", _import, "Make DESIGNATORS, one symbol or a list, accessible in PACKAGE.")
_register_change(
    "shadowing-import", _shadowing_import, "Make DESIGNATORS accessible in PACKAGE, hiding what it inherits."
)
_register_change("shadow", _shadow, "Give PACKAGE symbols of its own called as DESIGNATORS say.")
_register_change("use-package", _use_package, "Let PACKAGE inherit from DESIGNATORS, one package or a list.")
_register_change("unuse-package", _unuse_package, "Let PACKAGE inherit no longer from DESIGNATORS.")


@function("(%in-package name)")
def in_package(name: Value) -> Value:
    """Make the package called NAME the current one, for IN-PACKAGE."""
    package = package_called(name, "in-package")
    _image().cell(PACKAGE).value = package
    return package


@function("(%define-package name nicknames use shadow shadowing-import-from import-from intern export)")
def define_package(
    name: Value,
    nicknames: Value,
    use: Value,
    shadow: Value,
    shadowing_import_from: Value,
    import_from: Value,
    interned: Value,
    exported: Value,
) -> Value:
    """Make or change the package called NAME, for DEFPACKAGE.

    Each argument is a list of names; the IMPORT-FROMs are lists of
    (package name...). USE may be :default, which is COMMON-LISP.
    """
    text = text_of(name, "defpackage")
    others = [text_of(nickname, "defpackage") for nickname in items(nicknames)]
    package = _image().packages.get(text)
    if package is None:
        package = _image().add_package(Package(text, others))
    for designator in items(shadow):
        package.shadow(text_of(designator, "defpackage"))
    _import_from(package, shadowing_import_from, True)
    _use(package, use)
    _import_from(package, import_from, False)
    for designator in items(interned):
        package.intern(text_of(designator, "defpackage"))
    for designator in items(exported):
        package.export(text_of(designator, "defpackage"))
    return package


def _import_from(package: Package, clauses: Value, shadowing: bool) -> None:
    for clause in items(clauses):
        designator, *names = items(clause)
        there = package_called(designator, "defpackage")
        for name in names:
            symbol, found = there.find(text_of(name, "defpackage"))
            if not found:
                raise simple_error("DEFPACKAGE: the package has no such symbol", name, there)
            if symbol is not None:
                package.import_symbol(symbol, shadowing=shadowing)


@function("(%package-symbols package kind)")
def package_symbols(package: Value, kind: Value) -> Value:
    """Return the :accessible, :present or :external symbols of PACKAGE.

    For DO-SYMBOLS, DO-EXTERNAL-SYMBOLS and their like.
    """
    where = package_called(package, "do-symbols")
    if kind is _EXTERNAL:
        found = [where.present[name] for name in sorted(where.external)]
    elif kind is Keyword("PRESENT"):
        found = list(where.present.values())
    else:
        found = list(where.accessible())
    return from_items(found)


@function("(%all-symbols)")
def all_symbols() -> Value:
    """Return the symbols of every package, for DO-ALL-SYMBOLS."""
    found = dict.fromkeys(symbol for package in _all_packages() for symbol in package.present.values())
    return from_items(list(found))


@function("(find-all-symbols name)")
def find_all_symbols(name: Value) -> Value:
    """Return every symbol called NAME, a string or symbol."""
    text = text_of(name, "find-all-symbols")
    found = dict.fromkeys(package.present[text] for package in _all_packages() if text in package.present)
    return from_items(list(found))
