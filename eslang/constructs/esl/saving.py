"""SAVE-FACTS and LOAD-FACTS: the facts of the database as a file that people can read.

Importing this room costs nothing: what writes and reads facts (fact_text.py)
is loaded when a plan does.
Source: ours; the papers keep their facts in memory.
"""

from __future__ import annotations

from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure, simple_error, type_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable, NoReturn
from eslang.base.image import Image
from eslang.base.lists import Cons
from eslang.base.packages import Package
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import CL, ESL, function

if TYPE_CHECKING:
    from eslang.facts.query import Facts

IN_PACKAGE = Symbol.intern("IN-PACKAGE", CL)
LIBRARY = (CL, ESL, "SCS")  # packages whose symbols are written as they are written in plans
LOAD_PATHNAME = Symbol.intern("*LOAD-PATHNAME*", CL)


@function("(save-facts file &rest relations)", ESL)
def save_facts(file: Value, *relations: Value) -> Value:
    """Write the facts of RELATIONS, or all facts, to FILE, one a line.

    LOAD-FACTS reads them, in any package. What is derived by rules, the rules
    and the declarations belong to the program, and are not written. FILE is
    written anew, and as a whole: if that fails, it stays as it was.

    Returns: the number of facts.
    Fails:   :error, if FILE cannot be written, or a fact has no text that is
             read back as the same fact: it holds a function, an object of
             Python, an uninterned symbol, or a vector or structure, which is
             equal to itself only; and if one of RELATIONS names no relation.

    Source: ours (decision 24); the papers keep their facts in memory.
    """
    from eslang.constructs.esl.fact_text import Writer

    path, image = file_name(file, "save-facts"), running.session.image
    database: Facts = running.session.database
    for name in relations:
        if not isinstance(name, Symbol) or not database.is_relation(name):
            raise simple_error("there is no relation of this name", name)
    writer = Writer(written_in(image), "saved")
    lines = []
    for chosen in relations or (None,):
        for relation in list(database.relations.values()) if chosen is None else database.named(chosen):
            if relation.name is IN_PACKAGE and relation.rows:
                raise simple_error("in a file of facts this name means something else", IN_PACKAGE)
            lines += [writer.text(relation.name, row) for row in relation.rows]
    write_whole(path, header(image.package, len(lines)) + "".join([f"{line}\n" for line in lines]))
    return len(lines)


@function("(load-facts file)", ESL)
def load_facts(file: Value) -> Value:
    """Assert the facts in FILE, first looked for beside the file being loaded.

    FILE is text: facts as they are written in plans, without quotes, and
    comments. (in-package NAME) says what the names behind it mean; until then
    they mean what they mean where this is called. All facts are asserted as one
    change, in their order, or none is.

    Returns: the number of facts that were not held already.
    Fails:   :error, if FILE cannot be read, or something in it is no fact; this
             names the line and the fact.

    Source: ours (decision 24); the papers keep their facts in memory.
    """
    path, session = file_name(file, "load-facts"), running.session
    facts, lines = facts_in(path, session.image)
    database: Facts = session.database
    check_arities(database, path, facts, lines)
    try:
        return database.add_all(facts)
    except Failure:
        for fact, line in zip(facts, lines, strict=True):
            try:
                database.check(fact)
            except Failure as failure:
                damaged(path, line, f"this is no fact: {reason(failure)}", fact)
        raise  # it is not about the facts


def facts_in(path: str, image: Image) -> tuple[list[Value], list[int]]:
    """What the file PATH holds, and on which lines. Raises Failure."""
    from eslang.base.decoding import decode, file_bytes, find_file

    try:
        content = file_bytes(find_file(path, image.cell(LOAD_PATHNAME).value) or path)
    except (OSError, ValueError) as trouble:
        raise refusal("read", path, trouble) from None
    try:
        return forms_of(decode(content, path), image)
    except EslError as error:
        found = error.diagnostic.labels[0].span
        damaged(path, found.line, error.diagnostic.message, String(found.source.line(found.line).strip()))


def check_arities(database: Facts, path: str, facts: list[Value], lines: list[int]) -> None:
    """Refuse facts with another number of arguments than was declared."""
    declared = {name: arities for name, arities in database.declared.items() if arities}
    for fact, line in zip(facts, lines, strict=True) if declared else ():
        arities = declared.get(fact.car) if fact.__class__ is Cons else None
        if arities and length(fact) - 1 not in arities:
            expected = " or ".join(map(str, sorted(arities)))
            damaged(path, line, f"this relation was declared with {expected} arguments", fact)


def length(fact: Value) -> int:
    """How many elements FACT has, whatever it ends with."""
    count = 0
    while fact.__class__ is Cons:
        count, fact = count + 1, fact.cdr
    return count


def forms_of(source: Any, image: Image) -> tuple[list[Value], list[int]]:
    """What SOURCE holds, and on which lines; IN-PACKAGE says what names mean. Raises EslError."""
    from eslang.constructs.esl.fact_text import Scanner

    reading = Names(image)
    scanner = Scanner(reading.resolve)
    facts, lines = [], []
    for line, form in scanner.forms(source):
        if form.__class__ is Cons and form.car is IN_PACKAGE:
            if not reading.enter(form):
                damaged(source.name, line, "there is no such package", form)
            scanner.forget()
        else:
            facts.append(form)
            lines.append(line)
    return facts, lines


class Names:
    """What names mean in a file of facts."""

    def __init__(self, image: Image) -> None:
        from eslang.base.resolve import resolve_in

        self.image = image
        self.package: str = image.package.name
        self._resolve = resolve_in(image)

    def resolve(self, package: str | None, name: str, external_only: bool) -> Symbol | None:
        """The symbol that a name means."""
        return self._resolve(package or self.package, name, external_only)

    def enter(self, form: Cons) -> bool:
        """Do what FORM, an IN-PACKAGE, says; false if there is no such package."""
        name = form.cdr.car if form.cdr.__class__ is Cons and form.cdr.cdr is None else None
        text = name.name if isinstance(name, Symbol) else name.text if name.__class__ is String else ""
        package = self.image.packages.get(text)
        if package is not None:
            self.package = package.name
        return package is not None


def written_in(image: Image) -> Callable[[Symbol | None], str]:
    """What writes symbols for a file that is read in the current package of IMAGE."""
    from eslang.constructs.esl.fact_text import Unwritable, name_text, with_home

    current = image.package

    def name_of(symbol: Symbol | None) -> str:
        name, home = ("NIL", CL) if symbol is None else (symbol.name, symbol.package)
        if home is None or home == "KEYWORD":
            return with_home(symbol)
        if current.find(name) == (symbol, True) and (home == current.name or home in LIBRARY):
            return name_text(symbol)
        there = image.packages.get(home)
        if there is None or there.find(name) not in ((symbol, True), (None, False)):
            raise Unwritable(f"the name of the symbol {name} is not read as this symbol")
        return with_home(symbol)

    return name_of


def header(package: Package, count: int) -> str:
    """What stands above the facts."""
    from eslang.base.printer import prin1

    facts = "1 fact" if count == 1 else f"{count} facts"
    name = prin1(String(package.name))
    return f";;;; {facts}, written by SAVE-FACTS for LOAD-FACTS\n(cl:in-package {name})\n\n"


def file_name(file: Value, operator: str) -> str:
    """The path that FILE, an argument of OPERATOR, names."""
    if file.__class__ is not String:
        raise type_error(file, "STRING", Symbol.intern(operator.upper(), ESL))
    path: str = file.text
    return path


def write_whole(path: str, text: str) -> None:
    """Let the file PATH hold TEXT. If that fails, it is as it was before. Raises Failure."""
    import os

    try:
        target = os.path.realpath(path)
        if os.path.exists(target) and not os.path.isfile(target):
            raise OSError("it is no plain file")
        fresh = os.path.join(os.path.dirname(target), f".{os.path.basename(target)}.{os.getpid()}")
        try:
            with open(fresh, "wb") as stream:
                stream.write(text.encode())
                stream.flush()
                os.fsync(stream.fileno())
            if os.path.exists(target):
                os.chmod(fresh, os.stat(target).st_mode)
            os.replace(fresh, target)
        finally:
            if os.path.exists(fresh):
                os.remove(fresh)
    except (OSError, ValueError) as trouble:  # a name with a NUL in it is a ValueError
        raise refusal("written", path, trouble) from None


def refusal(done: str, path: str, trouble: OSError | ValueError) -> Failure:
    """The failure that PATH cannot be read or written."""
    words = getattr(trouble, "strerror", None) or str(trouble)
    return simple_error(f"the file cannot be {done}", String(path), words.lower(), condition="FILE-ERROR")


def damaged(path: str, line: int, message: str, fact: Value) -> NoReturn:
    """Fail: what stands on LINE of PATH is wrong."""
    raise simple_error(f"{path}:{line}: {message}", fact, condition="FILE-ERROR")


def reason(failure: Failure) -> str:
    """What FAILURE says, in the midst of a sentence."""
    from eslang.base.failure_text import message_of

    if failure.cause.name == "UNBOUND-LOGIC-VARIABLE":
        return f"{failure.values[0]} is a variable"
    words = message_of(failure).rstrip(".")
    return words if words[1:2].isupper() else words[0].lower() + words[1:]
