"""Texts: how the forms of a file, a string or the library are loaded.

A file is taken from the cache of compiled code if it was compiled before under
the same circumstances; else it is read, compiled and run form by form, and
kept. What was loaded so far, and in which order, is part of the circumstances.
"""

from __future__ import annotations

import os
from types import FunctionType

from eslang.base.decoding import decode, file_bytes
from eslang.base.diagnostics import Diagnostic, EslError
from eslang.base.hints import Any, Callable, Iterable
from eslang.base.image import PACKAGE
from eslang.base.packages import Package
from eslang.base.spans import Source
from eslang.base.symbols import Value
from eslang.base.text import String
from eslang.compile import cache
from eslang.lisp.loading import LOAD_PATHNAME
from eslang.runtime.failures import run_apart

Run = Callable[[FunctionType], Value]


class Texts:
    """Loads texts into one interpreter."""

    def __init__(self, session: Any) -> None:
        self.session = session
        self.circumstances = ""  # a digest of all that was loaded or evaluated before

    def note(self, text: str) -> None:
        """Remember that TEXT was evaluated: what is compiled later may depend on it."""
        self.circumstances = cache.digest(self.circumstances, text)

    def run(self, source: Source) -> Value:
        """Read, compile and run the forms of a source; the value of the last."""
        self.note(source.text)
        return self._compile(source)[1]

    def load(self, source: Source, run: Run = run_apart) -> None:
        """Load a file: from the cache, if it is there. RUN runs each form, as a task unless given."""
        key = cache.digest(self.circumstances, source.name, source.text, self.session.image.package.name)
        self.note(source.text)
        if self._run_kept(key, run):
            return
        before = self.circumstances
        compiler, _ = self._compile(source, run)
        alone = self.circumstances == before  # it loaded nothing else, whose macros it might use
        written = cache.write_down(compiler) if alone and compiler.is_pure() else None
        if written is not None:
            cache.keep(key, [written])

    def load_file(self, path: str, run: Run) -> Package:
        """Load a file, its forms run by RUN; the package that was current at its end.

        *PACKAGE* and *LOAD-PATHNAME* are as before afterwards.
        """
        image, bindings = self.session.image, self.session.bindings
        source = decode(file_bytes(path), path)
        bindings.bind(image.cell(PACKAGE), image.package)
        bindings.bind(image.cell(LOAD_PATHNAME), String(path))
        try:
            self.load(source, run)
            package: Package = image.package
            return package
        finally:
            bindings.unbind(2)

    def load_library(self, paths: list[str]) -> None:
        """Load the library, all of it or none from the cache."""
        stats = [(path, os.stat(path)) for path in paths]
        named = [f"{path} {stat.st_size} {stat.st_mtime_ns}" for path, stat in stats]
        key = self.circumstances = cache.digest(cache.fingerprint(), *named)
        if self._run_kept(key, run_apart):
            return
        entries = []
        for path in paths:
            source = decode(file_bytes(path), f"<stdlib>/{os.path.basename(path)}")
            compiler, _ = self._compile(source)
            entries.append(cache.write_down(compiler))
        if all(entry is not None for entry in entries):
            cache.keep(key, [entry for entry in entries if entry is not None])

    def check(self, paths: Iterable[str]) -> list[Diagnostic]:
        """What can be known of a program, the files in order, without running it."""
        from eslang.compile.check import Checker
        from eslang.constructs.esl.relation_check import RelationCheck

        session = self.session
        session.compiler("<check>")
        package = session.image.cell(PACKAGE)
        checker = Checker(session.image, lambda unit, code: run_apart(unit.load(code)), RelationCheck)
        for path in paths:
            try:
                source = decode(file_bytes(path), path)
            except EslError as error:
                checker.found.append(error.diagnostic)
                continue
            before = package.value
            checker.text(session.readings(source), session.compiler(source.name))
            package.value = before
        return checker.finish()

    def _compile(self, source: Source, run: Run = run_apart) -> tuple[Any, Value]:
        """Compile and run a source form by form; its compiler, and the value of the last form."""
        compiler = self.session.compiler(source.name)
        result: Value = None
        run_code = self._runner(compiler.unit.load, run)
        for reading in self.session.readings(source):
            result = compiler.run(reading.form, reading.spans, reading.span, run=run_code)
        return compiler, result

    def _runner(self, load: Callable[[Any], FunctionType], run: Run) -> Callable[[Any], Value]:
        return lambda code: run(load(code))

    def _run_kept(self, key: str, run: Run) -> bool:
        """Run the top-level forms of the texts kept under KEY; false if there are none."""
        texts = cache.fetch(key)
        for kept in texts or ():
            code = cache.take_up(kept, self.session.image, self.session.support)
            for form in kept.codes:
                run(code.load(form))
        return texts is not None
