"""DOC: signature and documentation of a name, from where it was defined.
Source: ours; the papers leave it to Lisp.
"""

from __future__ import annotations

from eslang.base.failure import simple_error
from eslang.base.hints import Any
from eslang.base.lists import Cons, lisp_list
from eslang.base.many import Values
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import ESL, Definition, function, macro

QUOTE = Symbol.intern("QUOTE", "COMMON-LISP")
VARIABLE = Symbol.intern("VARIABLE", "COMMON-LISP")
PRINT_DOC = Symbol.intern("%PRINT-DOC", "ESL")


def documentation_text(definition: Definition) -> str:
    """Signature, kind, place and docstring of DEFINITION, for a person."""
    from inspect import cleandoc

    where = f", defined at {definition.where}" if definition.where else ""
    lines = [definition.signature.lower(), f"  {definition.kind} of {definition.package}{where}"]
    text = cleandoc(definition.doc())
    return "\n".join([*lines, "", text] if text else lines) + "\n"


@macro("(doc name)", ESL)
def doc(form: Value, environment: Any) -> Value:
    """Print the signature and documentation of NAME, quoted or not.

    Returns: no values.
    Fails:   :error, if nothing is known of NAME.

    Example:
        ? (defun greet (name) "Return a greeting for NAME." (list :hello name))
        GREET
        ? (doc greet)
        (greet name)
          function of ESL-USER, defined at <prompt>:1:1

        Return a greeting for NAME.

    Source: ours; the papers leave it to Lisp.
    """
    name = form.cdr.car
    if name.__class__ is Cons and name.car is QUOTE:
        name = name.cdr.car
    return lisp_list(PRINT_DOC, lisp_list(QUOTE, name))


def definition_of(name: Value) -> Definition | None:
    """What is registered of NAME."""
    definition: Definition | None = running.session.definition(name) if isinstance(name, Symbol) else None
    return definition


def print_doc_values(name: Value) -> Value:
    """Print what is known of NAME."""
    session = running.session
    definition = definition_of(name)
    if definition is None:
        raise simple_error("nothing is known of this name", name)
    session.output.fresh_line()
    session.output.write(documentation_text(definition))
    return Values()


@function("(%print-doc name)", ESL, many=print_doc_values)
def print_doc(name: Value) -> Value:
    """Print what is known of NAME."""
    print_doc_values(name)
    return None


@function("(documentation name type)")
def documentation(name: Value, kind: Value) -> Value:
    """Return the docstring of NAME as a string, or NIL if it has none."""
    definition = definition_of(name)
    if definition is None or (definition.kind in ("variable", "constant")) != (kind is VARIABLE):
        return None
    return String(definition.doc()) if definition.doc() else None
