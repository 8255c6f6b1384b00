"""Programs: order, choice, assignment, bindings and loops."""

from __future__ import annotations

from programs.words import SPECIALS, Scope, Words


class Forms(Words):
    """Writes forms that stay where they are."""

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

        return (
            self.pick(compare, joined, negated)
            if depth > 0
            else self.pick(compare, lambda: "t", lambda: "nil")
        )

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
            name = (
                self.fresh("v") if self.chance.randrange(4) else self.chance.choice(tuple(SPECIALS)).lower()
            )
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
            (
                "(note ,n)",
                "(progn (setq *a* (+ *a* ,n)) ,@(list n '*a*))",
                "(let ((*b* ,(+ n 1))) (note *b*))",
            )
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
        last = self.form(inner.bare(), depth)
        made = self.chance.choice(
            (
                f"(lambda () {self.body(inner.bare(), depth)})",
                f"(lambda () (setq {own} (+ {own} 1)) (note (list {index} {own})) {last})",
                f"(let ((g (lambda () (setq {own} (* 2 {own}))))) (lambda () (funcall g) {own}))",
                f"(labels ((g (n) (if (> n 0) (g (- n 1)) (note {own})))) (lambda () (g 2)))",
            )
        )
        round_ = (
            f"(let* (({own} {value})) (setq {kept} (cons {made} {kept})) {self.several(inner, depth, 0, 1)})"
        )
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
            (
                back,
                f"(funcall (lambda () {back}))",
                f"(unwind-protect {back} (note {fuel}))",
                f"(block b {back})",
            )
        )
        skip = f"(if {self.test(inner, 1)} (go {end}))"
        forms = [f"(progn {self.body(inner, depth)})", skip, f"(note {fuel})"]
        self.chance.shuffle(forms)
        statements = f"{tag} {' '.join(forms)} {back} (note 77) {end} (note {fuel})"
        return f"(let (({fuel} 0)) (tagbody {statements}) {fuel})"
