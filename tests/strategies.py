"""Hypothesis strategies: programs that mean something, end, and tell what they do.

A program is one form. Its variables are integers unless they hold functions,
what it does can be seen in its values and in the trace that (note x) leaves,
and whatever could go on for ever is counted. Other strategies belong here too.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import NamedTuple

from hypothesis import strategies as st

SPECIALS = {"*A*": 10, "*B*": 20}
CAUSES = (":c1", ":c2", ":c3")


class Scope(NamedTuple):
    """What a program may mention at one place; functions come with how many arguments they take."""

    variables: tuple[str, ...] = ()
    closures: tuple[str, ...] = ()  # variables that hold functions of no argument
    functions: tuple[tuple[str, int], ...] = ()
    macros: tuple[str, ...] = ()
    blocks: tuple[str, ...] = ()
    catches: tuple[str, ...] = ()
    recovering: bool = False  # inside a recovery clause

    def bare(self) -> Scope:
        """The scope without what belongs to the forms around."""
        return Scope(self.variables, self.closures, self.functions, self.macros)


class Writer:
    """Writes one program, choosing by CHANCE."""

    def __init__(self, chance: Random, *, failures: bool = True) -> None:
        self.chance = chance
        self.failures = failures
        self.count = 0

    # --- words -----------------------------------------------------------------

    def fresh(self, prefix: str) -> str:
        """A name; sometimes one that is in use already, so that it shadows."""
        if prefix == "v" and self.chance.randrange(4) == 0:
            return self.chance.choice("xyz")
        self.count += 1
        return f"{prefix}{self.count}"

    def pick(self, *choices: Callable[[], str]) -> str:
        """What one of CHOICES writes."""
        return self.chance.choice(choices)()

    def several(self, scope: Scope, depth: int, least: int = 0, most: int = 3) -> str:
        """Some forms."""
        return " ".join(self.form(scope, depth) for _ in range(self.chance.randint(least, most)))

    def body(self, scope: Scope, depth: int) -> str:
        """One to three forms, the last of which gives the value."""
        return self.several(scope, depth, 1, 3)

    # --- forms -----------------------------------------------------------------

    def form(self, scope: Scope, depth: int) -> str:
        """A form that gives an integer, if it does not fail."""
        if depth <= 0:
            return self.atom(scope)
        kinds = [*PLAIN, *PLAIN, *BINDING, *BINDING, *JUMPS, *VALUES, *FUNCTIONS]
        if self.failures:
            kinds += FAILURES
        return self.chance.choice(kinds)(self, scope, depth - 1)

    def atom(self, scope: Scope) -> str:
        """A number, a variable, a call or a jump."""
        choice = self.chance.randrange(12)
        if choice < 5 and scope.variables:
            return self.chance.choice(scope.variables)
        if choice == 5:
            return self.chance.choice(tuple(SPECIALS)).lower()
        if choice == 6 and scope.closures:
            return f"(funcall {self.chance.choice(scope.closures)})"
        if choice == 7 and scope.blocks:
            return f"(return-from {self.chance.choice(scope.blocks)} {self.several_values(scope, 0)})"
        if choice == 8 and scope.catches:
            return f"(throw {self.chance.choice(scope.catches)} {self.several_values(scope, 0)})"
        if choice == 9 and scope.variables:
            return f"(note {self.chance.choice(scope.variables)})"
        if choice == 10 and scope.macros:
            return f"({self.chance.choice(scope.macros)} {self.chance.randrange(9)})"
        if choice == 11 and scope.recovering:
            return self.chance.choice(("(retry)", "(abort 1)", "(abort (note 2))"))
        return str(self.chance.randrange(10))

    # --- order, choice, assignment ---------------------------------------------

    def arithmetic(self, scope: Scope, depth: int) -> str:
        arguments = [self.form(scope, depth) for _ in range(2)]
        return f"({self.chance.choice('+-')} {' '.join(arguments)})"

    def note(self, scope: Scope, depth: int) -> str:
        return f"(note {self.form(scope, depth)})"

    def collected(self, scope: Scope, depth: int) -> str:
        """Several arguments, noted, so that the order of evaluation shows."""
        return f"(length (note (list {self.several(scope, depth, 1, 4)})))"

    def test(self, scope: Scope, depth: int) -> str:
        def compare() -> str:
            operator = self.chance.choice(("<", ">", "=", "eql"))
            return f"({operator} {self.form(scope, depth - 1)} {self.form(scope, depth - 1)})"

        def joined() -> str:
            operator = self.chance.choice(("and", "or"))
            return f"({operator} {self.test(scope, depth - 1)} {self.test(scope, depth - 1)})"

        def negated() -> str:
            return f"(not {self.test(scope, depth - 1)})"

        return self.pick(compare, joined, negated) if depth > 0 else self.pick(compare, lambda: "t", lambda: "nil")

    def choice(self, scope: Scope, depth: int) -> str:
        test = self.test(scope, depth)

        def cond() -> str:
            return (
                f"(cond ({test} {self.body(scope, depth)}) ((values nil 1)) "
                f"({self.test(scope, depth)} {self.form(scope, depth)}) (t {self.body(scope, depth)}))"
            )

        def case() -> str:
            return (
                f"(case {self.form(scope, depth)} ((0 1 2) {self.body(scope, depth)}) "
                f"({self.chance.randrange(3, 9)} {self.form(scope, depth)}) (t {self.body(scope, depth)}))"
            )

        return self.pick(
            lambda: f"(if {test} {self.form(scope, depth)} {self.form(scope, depth)})",
            lambda: f"(or (when {test} {self.body(scope, depth)}) {self.form(scope, depth)})",
            lambda: f"(or (and {test} {self.form(scope, depth)}) {self.form(scope, depth)})",
            cond,
            case,
        )

    def order(self, scope: Scope, depth: int) -> str:
        operator = self.chance.choice(("progn", "progn", "prog1", "multiple-value-prog1", "locally"))
        return f"({operator} {self.body(scope, depth)})"

    def assignment(self, scope: Scope, depth: int) -> str:
        names = (*scope.variables, *(name.lower() for name in SPECIALS))
        name, other = self.chance.choice(names), self.chance.choice(names)
        if self.chance.randrange(3) == 0:
            return f"(setq {name} {self.form(scope, depth)} {other} (+ 1 {name}))"
        return f"(setq {name} {self.form(scope, depth)})"

    # --- bindings --------------------------------------------------------------

    def let(self, scope: Scope, depth: int) -> str:
        star = self.chance.choice(("", "*"))
        inner, pairs = scope, []
        for _ in range(self.chance.randint(1, 3)):
            name = self.fresh("v") if self.chance.randrange(4) else self.chance.choice(tuple(SPECIALS)).lower()
            if f"({name} " in " ".join(pairs):
                continue
            pairs.append(f"({name} {self.form(inner if star else scope, depth)})")
            inner = inner._replace(variables=(*inner.variables, name))
        return f"(let{star} ({' '.join(pairs)}) {self.body(inner, depth)})"

    def progv(self, scope: Scope, depth: int) -> str:
        return f"(progv '(*a*) (list {self.form(scope, depth)}) {self.body(scope, depth)})"

    def symbol_macro(self, scope: Scope, depth: int) -> str:
        if not scope.variables:
            return self.let(scope, depth)
        name = self.fresh("s")
        inner = scope._replace(variables=(*scope.variables, name))
        return f"(symbol-macrolet (({name} {self.chance.choice(scope.variables)})) {self.body(inner, depth)})"

    def macro(self, scope: Scope, depth: int) -> str:
        """Local macros see no variables, but their expansions do."""
        name = self.fresh("m")
        template = self.chance.choice(
            ("(note ,n)", "(progn (setq *a* (+ *a* ,n)) ,@(list n '*a*))", "(let ((*b* ,(+ n 1))) (note *b*))")
        )
        inner = scope._replace(macros=(*scope.macros, name))
        return f"(macrolet (({name} (n) `{template})) {self.body(inner, depth)})"

    def closure(self, scope: Scope, depth: int) -> str:
        """A closure that may change what it captured."""
        name, variable = self.fresh("f"), self.fresh("v")
        inside = scope._replace(variables=(*scope.variables, variable))
        after = inside._replace(closures=(*scope.closures, name))
        made = f"(lambda () {self.body(inside, depth)})"
        return f"(let* (({variable} {self.form(scope, depth)}) ({name} {made})) {self.body(after, depth)})"

    # --- loops -----------------------------------------------------------------

    def loop(self, scope: Scope, depth: int) -> str:
        name = self.fresh("i")
        inner = scope._replace(variables=(*scope.variables, name), blocks=(*scope.blocks, "nil"))
        body = f"(progn {self.several(inner, depth, 1, 2)})"
        result = self.form(inner, depth - 1)
        return self.pick(
            lambda: f"(dotimes ({name} {self.chance.randrange(4)} {result}) (note {name}) {body})",
            lambda: f"(dolist ({name} (list {self.several(scope, 0, 0, 3)}) 5) (note {name}) {body})",
            lambda: f"(do (({name} 0 (+ {name} 1)) (k 1 {name})) ((> {name} 2) (note k) {result}) {body})",
        )

    def closures_in_a_loop(self, scope: Scope, depth: int) -> str:
        """Closures that each captured the variables of their own round, called when the loop is over."""
        index, own, kept = self.fresh("i"), self.fresh("v"), self.fresh("k")
        inner = scope._replace(variables=(*scope.variables, own), blocks=())
        value = self.chance.choice((f"(+ {index} {self.form(scope.bare(), 0)})", index))
        made = self.chance.choice(
            (
                f"(lambda () {self.body(inner.bare(), depth)})",
                f"(lambda () (setq {own} (+ {own} 1)) (note (list {index} {own})) {self.form(inner.bare(), depth)})",
                f"(let ((g (lambda () (setq {own} (* 2 {own}))))) (lambda () (funcall g) {own}))",
                f"(labels ((g (n) (if (> n 0) (g (- n 1)) (note {own})))) (lambda () (g 2)))",
            )
        )
        round_ = f"(let* (({own} {value})) (setq {kept} (cons {made} {kept})) {self.several(inner, depth, 0, 1)})"
        loop = self.pick(
            lambda: f"(dotimes ({index} 3) {round_})",
            lambda: f"(dolist ({index} (list 4 5 6)) {round_})",
            lambda: (
                f"(let (({index} 0)) (tagbody again {round_} (setq {index} (+ {index} 1)) "
                f"(if (< {index} 3) (go again))))"
            ),
            lambda: f"(mapcar (lambda ({index}) {round_}) (list 1 2 3))",
        )
        calls = f"(note (mapcar (lambda (f) (funcall f)) {kept}))"
        return f"(let (({kept} nil)) {loop} {calls} {calls} (length {kept}))"

    def tags(self, scope: Scope, depth: int) -> str:
        """A TAGBODY that goes back as often as its fuel lasts, perhaps from a closure."""
        fuel, tag, end = self.fresh("fuel"), self.fresh("tag"), self.fresh("end")
        inner = scope._replace(variables=(*scope.variables, fuel))
        back = f"(if (< {fuel} 3) (progn (setq {fuel} (+ {fuel} 1)) (go {tag})))"
        back = self.chance.choice(
            (back, f"(funcall (lambda () {back}))", f"(unwind-protect {back} (note {fuel}))", f"(block b {back})")
        )
        skip = f"(if {self.test(inner, 1)} (go {end}))"
        forms = [f"(progn {self.body(inner, depth)})", skip, f"(note {fuel})"]
        self.chance.shuffle(forms)
        return f"(let (({fuel} 0)) (tagbody {tag} {' '.join(forms)} {back} (note 77) {end} (note {fuel})) {fuel})"

    # --- jumps -----------------------------------------------------------------

    def block(self, scope: Scope, depth: int) -> str:
        name = self.fresh("b")
        return f"(block {name} {self.body(scope._replace(blocks=(*scope.blocks, name)), depth)})"

    def catch(self, scope: Scope, depth: int) -> str:
        tag = self.chance.choice(("'t1", "'t2"))
        return f"(catch {tag} {self.body(scope._replace(catches=(*scope.catches, tag)), depth)})"

    def protect(self, scope: Scope, depth: int) -> str:
        return f"(unwind-protect {self.form(scope, depth)} (note {self.chance.randrange(9)}) {self.several(scope, 1)})"

    def leave(self, scope: Scope, depth: int) -> str:
        """A jump, perhaps from a closure."""
        if not scope.blocks:
            return self.block(scope, depth)
        name = self.chance.choice(scope.blocks)
        jump = f"(return-from {name} {self.several_values(scope, depth)})"
        jump = self.chance.choice((jump, f"(funcall (lambda () {jump}))"))
        return self.chance.choice((f"(if {self.test(scope, 1)} {jump} {self.form(scope, 1)})", jump))

    # --- multiple values -------------------------------------------------------

    def several_values(self, scope: Scope, depth: int) -> str:
        """A form that gives one value, or several."""
        if self.chance.randrange(2):
            return self.form(scope, depth)
        return f"(values {self.several(scope, depth, 1, 3)})"

    def receive(self, scope: Scope, depth: int) -> str:
        names = [self.fresh("v"), self.fresh("w")]
        source = self.tail(scope, depth)
        inner = scope._replace(variables=(*scope.variables, names[0]))
        return f"(multiple-value-bind ({' '.join(names)}) {source} (note {names[1]}) {self.body(inner, depth)})"

    def listed(self, scope: Scope, depth: int) -> str:
        operator = self.chance.choice(("multiple-value-list", "multiple-value-call #'list"))
        return f"(length (note ({operator} {self.tail(scope, depth)})))"

    def tail(self, scope: Scope, depth: int) -> str:
        """A form whose values come out of some tail position."""
        values = self.several_values(scope, depth)
        simple = self.form(scope, depth - 1)
        special = self.chance.choice(tuple(SPECIALS)).lower()
        variable = self.fresh("v")
        return self.chance.choice(
            (
                f"(progn {simple} {values})",
                f"(let (({variable} 1)) {values})",
                f"(let (({special} 1)) {values})",
                f"(if {self.test(scope, 1)} {values} {simple})",
                f"(cond ({self.test(scope, 1)} {values}) ({values}))",
                f"(case {simple} (1 {values}) (t {values}))",
                f"(or {values} 1)",
                f"(and {simple} {values})",
                f"(block b {values})",
                f"(block b (return-from b {values}) {simple})",
                f"(block b (funcall (lambda () (return-from b {values}))))",
                f"(catch 't3 {values})",
                f"(catch 't3 (throw 't3 {values}))",
                f"(unwind-protect {values} {simple})",
                f"(multiple-value-prog1 {values} {simple} (values 7 8 9))",
                f"(prog1 {values} {simple})",
                f"(flet ((g () {values})) (g))",
                f"(labels ((g (n) (if (> n 0) (g (- n 1)) {values}))) (g 2))",
                f"(funcall (lambda () {values}))",
                f"(apply (lambda (q) q {values}) (list 1))",
                f"(macrolet ((g () '{values})) (g))",
                f"(dolist (q (list 1 2) {values}) {simple})",
                f"(dotimes (q 2) (return {values}))",
                f"(multiple-value-call (lambda (&rest r) (values-list r)) {values} {values})",
                f"(multiple-value-bind (q) {values} q {values})",
                f"(symbol-macrolet ((q {values})) q)",
                f"(locally {values})",
                f"(the t {values})",
                f"(setq {special} {values})",
                f"(tagbody (progn {values}))",
            )
        )

    # --- functions -------------------------------------------------------------

    def local_function(self, scope: Scope, depth: int) -> str:
        name, parameter = self.fresh("g"), self.fresh("v")
        inside = scope._replace(variables=(*scope.variables, parameter), blocks=(*scope.blocks, name))
        after = scope._replace(functions=(*scope.functions, (name, 1)))
        body = self.body(inside, depth)
        return f"(flet (({name} ({parameter}) {body})) {self.called(after, depth)} {self.body(after, depth)})"

    def recursion(self, scope: Scope, depth: int) -> str:
        """Local functions that call each other, counting down."""
        one, other = self.fresh("g"), self.fresh("g")
        inside = scope._replace(variables=(*scope.variables, "m"))
        step = self.form(inside, depth)
        return (
            f"(labels (({one} (n m) (if (< n 1) {self.form(inside, depth)} (+ 1 ({other} (- n 1) {step})))) "
            f"({other} (n m) {self.form(inside, depth - 1)} ({one} (- n 1) (+ m 1)))) ({one} 3 {self.form(scope, 0)}))"
        )

    def called(self, scope: Scope, depth: int) -> str:
        if not scope.functions:
            return self.local_function(scope, depth)
        name, _ = self.chance.choice(scope.functions)
        argument = self.form(scope, depth)
        return self.chance.choice(
            (
                f"({name} {argument})",
                f"(funcall #'{name} {argument})",
                f"(apply #'{name} (list {argument}))",
                f"(length (note (mapcar #'{name} (list 1 {argument}))))",
            )
        )

    def parameters(self, scope: Scope, depth: int) -> str:
        """A lambda list with all sections, called with some arguments."""
        names = [self.fresh("v") for _ in range(3)]
        if self.chance.randrange(3) == 0:
            names[self.chance.randrange(3)] = "*a*"
        required, optional, other = names
        if len(set(names)) < 3:
            return self.let(scope, depth)
        first = scope._replace(variables=(*scope.variables, required))
        second = first._replace(variables=(*first.variables, optional))
        third = second._replace(variables=(*second.variables, other))
        supplied, rest = self.fresh("p"), self.fresh("r")
        section = self.chance.choice(
            (
                f"&key ({other} {self.form(second, depth)} q)",
                f"&rest {rest} &key ({other} {self.form(second, depth)} q)",
                f"&rest {rest} &aux ({other} {self.form(second, depth)}) (q {rest})",
                f"&aux ({other} {self.form(second, depth)}) (q {other})",
            )
        )
        body = f"(note (list {supplied} q)) {self.body(third, depth)}"
        made = f"(lambda ({required} &optional ({optional} {self.form(first, depth)} {supplied}) {section}) {body})"
        key = f":{other} {self.form(scope, depth)}"
        given = self.chance.choice(("1", "1 2", f"1 2 {key if '&key' in section else ''}"))
        return f"(funcall {made} {given})"

    # --- failures --------------------------------------------------------------

    def recovery(self, scope: Scope, depth: int) -> str:
        clauses = []
        for _ in range(self.chance.randint(1, 2)):
            cause = self.chance.choice((*CAUSES, ":general-failure", ":error", ":control-error"))
            head = self.chance.choice((cause, f"({cause} e1 e2)"))
            retries = self.chance.choice(("", ":retries 2", ":retries 3"))
            inside = scope._replace(recovering=True)
            answer = self.chance.choice(("(retry)", f"(abort {self.form(inside, 1)})", self.form(inside, 1)))
            seen = "(note (list e1 e2))" if head[0] == "(" and cause in CAUSES else ""
            clauses.append(f"({head} {retries} (note 50) {seen} {answer})")
        return f"(with-recovery-procedures ({' '.join(clauses)}) {self.body(scope, depth)})"

    def cleanup(self, scope: Scope, depth: int) -> str:
        number = self.chance.randrange(60, 70)
        return f"(with-cleanup-procedure (note {number}) {self.body(scope, depth)})"

    def fail(self, scope: Scope, depth: int) -> str:
        failure = self.chance.choice(
            (
                f"(fail {self.chance.choice(CAUSES)} {self.several(scope, 0)})",
                f"(fail {self.chance.choice(CAUSES)})",
                f"(+ nil {self.form(scope, 0)})",
                "(car 5)",
                '(error "no")',
                "(throw 'nowhere 1)",
                "(funcall (lambda (x) x))",
                "(funcall 'no-such-function 1)",
            )
        )
        return f"(if {self.test(scope, 0)} {failure} {self.form(scope, depth)})"

    def handler(self, scope: Scope, depth: int) -> str:
        return f"(handler-case {self.form(scope, depth)} (error () {self.form(scope, 1)}))"


Kind = Callable[[Writer, Scope, int], str]
PLAIN: list[Kind] = [Writer.arithmetic, Writer.note, Writer.choice, Writer.order, Writer.assignment, Writer.collected]
BINDING: list[Kind] = [Writer.let, Writer.let, Writer.closure, Writer.symbol_macro, Writer.macro, Writer.progv]
JUMPS: list[Kind] = [Writer.block, Writer.catch, Writer.protect, Writer.leave, Writer.tags, Writer.loop]
VALUES: list[Kind] = [Writer.receive, Writer.listed]
FUNCTIONS: list[Kind] = [
    Writer.local_function, Writer.recursion, Writer.called, Writer.parameters, Writer.closures_in_a_loop
]  # fmt: skip
FAILURES: list[Kind] = [Writer.recovery, Writer.recovery, Writer.cleanup, Writer.fail, Writer.fail, Writer.handler]


def program(chance: Random, depth: int = 5, *, failures: bool = True) -> str:
    """A program, as text."""
    writer = Writer(chance, failures=failures)
    scope = Scope(variables=("x", "y", "z"))
    return f"(let ((x 1) (y 2) (z 3)) {writer.body(scope, depth)} (list x y z *a* *b*))"


def programs(depth: int = 4, *, failures: bool = True) -> st.SearchStrategy[str]:
    """Programs, as text."""
    return st.randoms(use_true_random=False).map(lambda chance: program(chance, depth, failures=failures))
