"""The logical database of one interpreter: facts, rules, and the answers to queries.

Which names are Lisp functions, and how they are called, is told from outside:
this room knows no Lisp. Queries of one shape share a plan; plans are dropped
when a rule or a declaration changes what they rest on.
"""

from __future__ import annotations

from eslang.base.failure import WRONG_NUMBER_OF_ARGUMENTS, Failure
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.symbols import Symbol, Value
from eslang.facts.goals import NOTHING_GIVEN, Atom, Constants, Given, Tokens, read_query
from eslang.facts.relations import Relation
from eslang.facts.rules import Name, Rule, Rules, read_rule
from eslang.facts.shapes import END, Shapes, behind
from eslang.facts.store import MANY, Store
from eslang.facts.views import Pauses
from eslang.facts.watching import Reads, woken_by_rules

if TYPE_CHECKING:  # what plans is loaded when something is asked for the first time
    from eslang.facts.explain import Explanation
    from eslang.facts.plans import Call, Plan, Solution, Solutions


class Facts(Store):
    """A store that can be asked."""

    def __init__(self, is_call: Callable[[Symbol], bool], call: Call) -> None:
        super().__init__()
        self.is_call = is_call
        self.call = call
        self.declared: dict[Symbol, list[int]] = {}  # names, and the arities they were declared with
        self.arguments: dict[Name, tuple[Symbol, ...]] = {}  # what they are called, where that is declared
        self.rules = Rules(self.is_test)
        self.definitions = 0  # how often rules were defined or forgotten
        self.pauses = Pauses(lambda: self.is_telling)
        self.plans = Shapes()
        self.guesses: dict[Tokens, Plan] = {}  # plans with names that nobody defined yet
        self.guessed: dict[Symbol, None] = {}  # these names, while a plan is made

    def declare(self, name: Symbol, arity: int | None = None, arguments: tuple[Symbol, ...] = ()) -> None:
        """Let NAME be a relation, of ARITY if that is told, whose ARGUMENTS are called so if that is."""
        self.check_name(name)
        if arguments:
            self.arguments[name, len(arguments)] = arguments
        arities = self.declared.setdefault(name, [])
        if arity is not None and arity not in arities:
            arities.append(arity)
            self._forget_unused(name)
        self.became_relation(name)

    def declare_property(self, name: Symbol) -> None:
        """Let NAME be a relation whose last argument is unique for the others."""
        self.declared.setdefault(name, [])
        super().declare_property(name)
        self._forget_plans()

    def relation(self, name: Symbol, arity: int) -> Relation:
        """The relation of that name and arity; fails if NAME was declared with others only."""
        self._check_arity(name, arity)
        return super().relation(name, arity)

    def is_relation(self, name: Symbol) -> bool:
        """Whether NAME was declared, or has rules, or has or had facts."""
        return name in self.known or name in self.declared or name in self.rules.arities

    def is_test(self, name: Symbol) -> bool:
        """Whether NAME in a query is a call of Lisp."""
        return not self.is_relation(name) and self.is_call(name)

    def became_coded(self, relation: Relation) -> None:
        """Rows of RELATION may hold codes from now on, which plans did not reckon with."""
        super().became_coded(relation)
        self._forget_plans()

    def rows_moved(self) -> None:
        """The rows of some relation are another dict from now on, which runs that are kept do not know."""
        for plan in (*self.plans.values(), *self.guesses.values()):
            plan.forget_runs()

    def became_relation(self, name: Symbol) -> None:
        """NAME is a relation from now on, even if plans took it for a function."""
        self.guesses.clear()
        if any(name in plan.tests for plan in self.plans.values()):
            self.plans.clear()

    def define_rule(self, head: Value, body: Value) -> bool:
        """Derive HEAD from the goals in the list BODY, too; false if that is known."""
        rule = read_rule(head, body)
        self.check_name(rule.name[0])
        for name in (rule.name, *(need.name for need in rule.needs if not self.is_test(need.name[0]))):
            self._check_arity(*name)
        is_new = self.rules.define(rule)
        if is_new:
            self._rules_changed([rule.name])
        return is_new

    def forget_rules(self, name: Symbol) -> bool:
        """Derive no facts of NAME any more; false if there were no rules."""
        names = self.rules.forget(name)
        self._rules_changed(names)
        return bool(names)

    def all(self, query: Value, given: Given = NOTHING_GIVEN) -> list[Solution]:
        """All solutions of QUERY; the variables that are GIVEN have their values."""
        constants: Constants = []
        plan = None if given else behind(self.plans.root, query, constants).get(END)
        if plan is None:
            plan, constants = self.plan(query, given)
        run = plan.run_all
        return plan.all(constants) if run is None else run(*constants)

    def alists(self, query: Value, complete: Callable[[Value], Value]) -> Value:
        """All solutions of QUERY, as Lisp has them; COMPLETE puts in what stands for something else."""
        constants: Constants = []
        plan = behind(self.plans.root, query, constants).get(END)
        if plan is None:
            plan, constants = self.plan(complete(query))
        run = plan.run_alists
        return plan.alists(constants) if run is None else run(*constants)

    def first(self, query: Value, given: Given = NOTHING_GIVEN) -> Solution | None:
        """The first solution of QUERY; None if there is none."""
        constants: Constants = []
        plan = None if given else behind(self.plans.root, query, constants).get(END)
        if plan is None:
            plan, constants = self.plan(query, given)
        run = plan.run_first
        return plan.first(constants) if run is None else run(*constants)

    def solutions(self, query: Value, given: Given = NOTHING_GIVEN) -> Solutions:
        """The solutions that QUERY has now, found one at a time, whatever is changed meanwhile."""
        plan, constants = self._planned(query, given)
        return plan.solutions(constants)

    def ask(self, query: Value, given: Given = NOTHING_GIVEN) -> tuple[Solution | None, Reads]:
        """The first solution of QUERY, if any, and what was read to know that."""
        plan, constants = self._planned(query, given)
        return self._noted(plan.noting, constants)

    def ask_all(self, query: Value) -> tuple[list[Solution], Reads]:
        """All solutions of QUERY, and what was read to know them."""
        plan, constants = self._planned(query, NOTHING_GIVEN)
        return self._noted(plan.noting_all, constants)

    def _noted(self, answer: Callable[[Constants, Reads], Any], constants: Constants) -> tuple[Any, Reads]:
        reads, definitions = Reads(), self.definitions
        found = answer(constants, reads)
        reads.overtaken = reads.overtaken or self.definitions != definitions
        return found, reads

    def explain(self, query: Value, given: Given = NOTHING_GIVEN) -> Explanation:
        """How QUERY is answered."""
        plan, constants = self.plan(query, given)
        return plan.explain(constants)

    def plan(self, query: Value, given: Given = NOTHING_GIVEN) -> tuple[Plan, Constants]:
        """How QUERY is answered, and its constants."""
        tokens, constants = read_query(query, given)
        plan: Plan | None = self.plans.by_tokens.get(tokens) or self.guesses.get(tokens)
        if plan is None or any(map(self.is_call, plan.guessed)):
            from eslang.facts.plans import make_plan

            self.guessed.clear()
            if len(self.plans) + len(self.guesses) >= MANY:
                self._forget_plans()
            plan = make_plan(self._resolve, self._rules_of, tokens, constants, self.call, self.pauses)
            plan.guessed = tuple(self.guessed)
            if plan.guessed:
                self.guesses[tokens] = plan
            else:
                self.plans.put(tokens, plan)
        return plan, constants

    def _planned(self, query: Value, given: Given) -> tuple[Plan, Constants]:
        """The same, quickly if it can be; where a call counts, the lines of this stand themselves."""
        constants: Constants = []
        plan: Plan | None = None if given else behind(self.plans.root, query, constants).get(END)
        return self.plan(query, given) if plan is None else (plan, constants)

    def _forget_plans(self) -> None:
        self.plans.clear()
        self.guesses.clear()

    def _resolve(self, atom: Atom) -> Relation | None:
        """The relation that ATOM is about; None if it is a call."""
        if not self.is_relation(atom.name):
            if self.is_call(atom.name):
                return None
            self.guessed[atom.name] = None
        return self.relation(atom.name, len(atom.terms))

    def _rules_of(self, name: Name) -> list[Rule]:
        return self.rules.by_name.get(name, [])

    def _rules_changed(self, names: list[Name]) -> None:
        """Forget the plans, and wake who asked these relations."""
        self.definitions += 1
        self._forget_plans()
        asked = [self.relations[name] for name in names if name in self.relations]
        woken = dict.fromkeys(watch for relation in asked for watch in woken_by_rules(relation))
        self._calls += [(watch.wake, None) for watch in woken]
        self._deliver()

    def _check_arity(self, name: Symbol, arity: int) -> None:
        """Fail if NAME was declared with other arities only, unless facts or rules were there before."""
        arities = self.declared.get(name)
        if arities and arity not in arities and not self._is_used(name, arity):
            expected = " or ".join(map(str, sorted(arities)))
            plural = "" if arities == [1] else "s"
            message = f"takes {expected} argument{plural} but {arity} {'was' if arity == 1 else 'were'} given"
            raise Failure(WRONG_NUMBER_OF_ARGUMENTS, name, message)

    def _is_used(self, name: Symbol, arity: int) -> bool:
        return (name, arity) in self.relations or (name, arity) in self.rules.by_name

    def _forget_unused(self, name: Symbol) -> None:
        """Forget relations called NAME that are only spoken of, with other arities than declared."""
        for relation in self.named(name):
            is_used = relation.rows or relation.watched
            if not is_used and relation.arity not in self.declared[name]:
                del self.relations[name, relation.arity]
        self._forget_plans()
        self._patterns.clear()
