"""Programs: jumps, multiple values, functions and failures."""

from __future__ import annotations

from programs.forms import Forms
from programs.words import CAUSES, SPECIALS, Scope


class Calls(Forms):
    """Writes forms that come from somewhere else, or go there."""

    # --- jumps -----------------------------------------------------------------

    def block(self, scope: Scope, depth: int) -> str:
        name = self.fresh("b")
        return f"(block {name} {self.body(scope._replace(blocks=(*scope.blocks, name)), depth)})"

    def catch(self, scope: Scope, depth: int) -> str:
        tag = self.chance.choice(("'t1", "'t2"))
        return f"(catch {tag} {self.body(scope._replace(catches=(*scope.catches, tag)), depth)})"

    def protect(self, scope: Scope, depth: int) -> str:
        cleanup = f"(note {self.chance.randrange(9)}) {self.several(scope, 1)}"
        return f"(unwind-protect {self.form(scope, depth)} {cleanup})"

    def leave(self, scope: Scope, depth: int) -> str:
        """A jump, perhaps from a closure."""
        if not scope.blocks:
            return self.block(scope, depth)
        name = self.chance.choice(scope.blocks)
        jump = f"(return-from {name} {self.several_values(scope, depth)})"
        jump = self.chance.choice((jump, f"(funcall (lambda () {jump}))"))
        return self.chance.choice((f"(if {self.test(scope, 1)} {jump} {self.form(scope, 1)})", jump))

    # --- multiple values -------------------------------------------------------

    def receive(self, scope: Scope, depth: int) -> str:
        names = [self.fresh("v"), self.fresh("w")]
        source = self.tail(scope, depth)
        inner = scope._replace(variables=(*scope.variables, names[0]))
        return (
            f"(multiple-value-bind ({' '.join(names)}) {source} (note {names[1]}) {self.body(inner, depth)})"
        )

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
            f"({other} (n m) {self.form(inside, depth - 1)} ({one} (- n 1) (+ m 1)))) "
            f"({one} 3 {self.form(scope, 0)}))"
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
        default = self.form(first, depth)
        made = f"(lambda ({required} &optional ({optional} {default} {supplied}) {section}) {body})"
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
