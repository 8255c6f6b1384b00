"""What an interpreter has from the start: the registered names, the library in stdlib/, the devices."""

from __future__ import annotations

from eslang import prelude
from eslang.base.hints import TYPE_CHECKING
from eslang.base.image import PACKAGE, Image
from eslang.base.symbols import Symbol
from eslang.compile.registry import DEFINITIONS, Definition
from eslang.constructs.scs.learning import DISCOUNT
from eslang.devices import gym, robot, spacecraft, widget

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter

PACKAGES = ("COMMON-LISP", "ESL", "SCS")


def furnish(session: Interpreter) -> None:
    """Fill the image of SESSION, which is at work."""
    prelude.import_rooms()
    image = session.image
    image.cell(PACKAGE).value = image.packages["COMMON-LISP"]
    image.cell(PACKAGE).special = True
    image.packages["COMMON-LISP"].export(PACKAGE.name)
    for definition in DEFINITIONS:
        if definition.kind != "special form":
            furnish_definition(image, definition)
    export(image, DISCOUNT)
    session.texts.load_library(prelude.stdlib_files(), frozenset(prelude.stdlib_files(prelude.LATER)))
    image.cell(PACKAGE).value = image.packages["ESL-USER"]
    widget.install(session)
    spacecraft.install(session)
    gym.install(session)
    robot.install(session)


def furnish_definition(image: Image, definition: Definition) -> None:
    """Give IMAGE one registered name."""
    symbol = image.packages[definition.package].intern(definition.name)
    if symbol is None:
        return
    cell = image.cell(symbol)
    made = definition.implementation
    if definition.kind == "function":
        if definition.many is not None:
            made.many = definition.many
        cell.function = made
    elif definition.kind == "macro":
        cell.macro = made
    else:
        cell.special = True
        cell.constant = definition.kind == "constant"
        cell.value = made() if callable(made) else made
    if cell.definition is None or definition.kind != "variable":
        cell.definition = definition
    export(image, symbol)


def export(image: Image, symbol: Symbol) -> None:
    """Make SYMBOL external, unless it begins with %."""
    if not symbol.name.startswith("%") and symbol.package in PACKAGES:
        image.packages[symbol.package].export(symbol.name)


def furnish_special_forms(image: Image) -> None:
    """Give IMAGE the special forms, unless it has them; their room is imported by then."""
    if image.special_forms:
        return
    for definition in DEFINITIONS:
        if definition.kind == "special form":
            symbol = image.packages[definition.package].intern(definition.name)
            if symbol is not None:
                image.special_forms[symbol] = definition
                if image.cell(symbol).definition is None:
                    image.cell(symbol).definition = definition
