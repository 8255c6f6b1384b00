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
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterable, Iterator
from eslang.base.image import PACKAGE
from eslang.base.packages import Package
from eslang.base.spans import Source
from eslang.base.symbols import Value
from eslang.base.text import String
from eslang.compile import cache
from eslang.lisp.loading import LOAD_PATHNAME
from eslang.runtime.failures import run_apart

if TYPE_CHECKING:
    from eslang.compile.check import Checker
    from eslang.later import Later
    from eslang.reader.reader import Reading

Run = Callable[[FunctionType], Value]


class Texts:
    """Loads texts into one interpreter."""

    def __init__(self, session: Any) -> None:
        self.session = session
        self.circumstances = ""  # a digest of all that was loaded or evaluated before
        self.later: Later | None = None  # what of the library is still to be loaded

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

    def load_library(self, paths: list[str], later: frozenset[str]) -> None:
        """Load the library, all of it or none from the cache; those of PATHS in LATER can wait then."""
        from eslang.later import Later, Recorder

        stats = [(path, os.stat(path)) for path in paths]
        named = [f"{path} {stat.st_size} {stat.st_mtime_ns}" for path, stat in stats]
        key = self.circumstances = cache.digest(cache.fingerprint(), *named)
        rest = cache.digest(key, "later")
        entries = cache.fetch(key)
        if entries is not None:
            self._run_entries(entries[:-1], run_apart)
            waiting = [path for path in paths if path in later]
            self.later = Later(self.session, entries[-1].cells, lambda: self._load_rest(rest, waiting))
            return
        recorder = Recorder(self.session.image)
        kept: dict[bool, list[cache.Kept | None]] = {False: [], True: []}
        for path in paths:
            kept[path in later].append(self._compile_library(path))
            recorder.pass_over(path in later)
        if None not in kept[False] + kept[True]:
            names = cache.Kept([], recorder.names, [], b"")
            cache.keep(rest, [entry for entry in kept[True] if entry is not None])
            cache.keep(key, [*[entry for entry in kept[False] if entry is not None], names])

    def load_later(self) -> None:
        """Load what of the library could wait, if that was not done yet."""
        later, self.later = self.later, None
        if later is not None:
            try:
                later.take()
            except BaseException:
                self.later = later  # the stack may be full
                raise

    def _load_rest(self, key: str, paths: list[str]) -> None:
        """Load the library's texts in PATHS, which are kept under KEY, unless somebody took them away."""
        if not self._run_kept(key, run_apart):
            for path in paths:
                self._compile_library(path)

    def _compile_library(self, path: str) -> cache.Kept | None:
        """Load a file of the library; what is to be kept of it."""
        source = decode(file_bytes(path), f"<stdlib>/{os.path.basename(path)}")
        return cache.write_down(self._compile(source)[0])

    def check(self, paths: Iterable[str]) -> list[Diagnostic]:
        """What can be known of a program, the files in order, without running it."""
        return self.analyse(paths).finish()

    def analyse(
        self,
        paths: Iterable[str],
        read: Callable[[str], bytes] = file_bytes,
        seen: Callable[[Reading], None] = lambda _: None,
    ) -> Checker:
        """The checker of a program, which has gone through all of it.

        READ gives what a file holds; SEEN gets each form.
        """
        from eslang.compile.check import Checker
        from eslang.constructs.esl.relation_check import RelationCheck

        session = self.session
        session.compiler("<check>")
        package = session.image.cell(PACKAGE)
        checker = Checker(session.image, lambda unit, code: run_apart(unit.load(code)), RelationCheck)
        for path in paths:
            try:
                source = decode(read(path), "<stdin>" if path == "-" else path)
            except EslError as error:
                checker.found.append(error.diagnostic)
                checker.is_whole = False
                continue
            before = package.value
            checker.text(shown_to(seen, session.readings(source)), session.compiler(source.name))
            package.value = before
        return checker

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
        self._run_entries(texts or (), run)
        return texts is not None

    def _run_entries(self, texts: Iterable[cache.Kept], run: Run) -> None:
        """Run the top-level forms of texts that were kept."""
        for kept in texts:
            code = cache.take_up(kept, self.session.image, self.session.support)
            for form in kept.codes:
                run(code.load(form))


def shown_to(seen: Callable[[Reading], None], readings: Iterable[Reading]) -> Iterator[Reading]:
    """READINGS, each of which SEEN gets first."""
    for reading in readings:
        seen(reading)
        yield reading
