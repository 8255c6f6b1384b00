"""Loading files from within a program (CLHS 24).

The interpreter loads (interpreter.py); here is what a plan says to have it done.
"""

from __future__ import annotations

from eslang.base.arguments import UNSUPPLIED, take_keys
from eslang.base.decoding import find_file
from eslang.base.diagnostics import EslError
from eslang.base.failure import simple_error, type_error
from eslang.base.running import running
from eslang.base.symbols import Symbol, T, Value
from eslang.base.text import String
from eslang.compile.registry import function, variable

LOAD_PATHNAME = Symbol.intern("*LOAD-PATHNAME*", "COMMON-LISP")

variable("*load-pathname*", None, "The file that is being loaded, a string; NIL if there is none.")


@function("(load filespec &key verbose print (if-does-not-exist :error) external-format)")
def load(path: Value, *options: Value) -> Value:
    """Load the file FILESPEC, first looked for beside the file being loaded.

    Returns: T; NIL for a file that is not there if IF-DOES-NOT-EXIST is NIL.
    """
    names = ("VERBOSE", "PRINT", "IF-DOES-NOT-EXIST", "EXTERNAL-FORMAT")
    absent = take_keys(options, names, UNSUPPLIED)[2]
    if path.__class__ is not String:
        raise type_error(path, "STRING", "load")
    session = running.session
    found = find_file(path.text, session.image.cell(LOAD_PATHNAME).value)
    if found is None:
        if absent is None:
            return None
        raise simple_error("there is no such file", path, condition="FILE-ERROR")
    try:
        session.texts.load_file(found, lambda form: form())
    except EslError as error:
        raise simple_error(str(error).split("\n")[0]) from None
    except OSError as trouble:
        raise simple_error("the file cannot be read", path, (trouble.strerror or "").lower()) from None
    return T
