"""The logical database (ESL §5): what is asserted, derived, and asked.

Facts and queries are data. In them, #?x stands for its binding.
"""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import Any
from eslang.base.lists import Cons, items, lisp_list
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value, truth
from eslang.base.text import String
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.queries import in_force

QUOTE = Symbol.intern("QUOTE", CL)
DEFINE_RELATION, DEFINE_PROPERTY, DEFINE_RULE = (
    Symbol.intern(name, ESL) for name in ("%DEFINE-RELATION", "%DEFINE-PROPERTY", "%DEFINE-RULE")
)

# --- facts ---------------------------------------------------------------------------


@function("(assert fact)", ESL)
def assert_fact(fact: Value) -> Value:
    """Hold FACT from now on; a fact that is held already stays where it is.

    A new value of a property takes the place of the old.

    Returns: FACT.
    Fails:   :type-error if FACT is no list that begins with a symbol;
             :unbound-logic-variable if a variable stands in it;
             :wrong-number-of-arguments if another number is declared.

    Example:
        ? (assert '(is-a w1 widget))
        (IS-A W1 WIDGET)
        ? (db-query '(is-a ?x widget))
        (((?X . W1)))

    Source: ESL §5; ARM §2.
    """
    fact = in_force(fact)
    running.session.database.add(fact)
    return fact


@function("(retract pattern)", ESL)
def retract(pattern: Value) -> Value:
    """Give up all facts that match PATTERN.

    What rules derive is not held, and stays.

    Returns: how many facts there were.

    Example:
        ? (progn (assert '(mass w1 3)) (assert '(mass w2 5)))
        (MASS W2 5)
        ? (retract '(mass ?x ?n))
        2

    Source: ESL §5; ARM §2.
    """
    return running.session.database.retract(in_force(pattern))


@function("(update pattern fact)", ESL)
def update(pattern: Value, fact: Value) -> Value:
    """Let FACT take the place of all facts that match PATTERN, as one change.

    Returns: FACT.

    Example:
        ? (assert '(position cup table))
        (POSITION CUP TABLE)
        ? (update '(position cup ?_) '(position cup tray))
        (POSITION CUP TRAY)
        ? (db-query '(position cup ?where))
        (((?WHERE . TRAY)))

    Source: language reference §5.
    """
    fact = in_force(fact)
    running.session.database.update(in_force(pattern), fact)
    return fact


@function("(db-query query)", ESL)
def db_query(query: Value) -> Value:
    """Give all bindings under which QUERY holds, each once.

    A query is a pattern; AND, OR or NOT of queries; or the call of a Lisp
    function as a test, such as (> ?x 10). ?_ matches anything.

    Returns: a list of alists ((?VAR . VALUE)...), in the order of assertion;
             NIL if QUERY does not hold.
    Fails:   :unbound-logic-variable if a variable has no value where NOT or
             a test needs one; :unbounded-rules if rules might make ever
             larger terms.

    Example:
        ? (progn (assert '(mass w1 3)) (assert '(mass w2 12)))
        (MASS W2 12)
        ? (db-query '(and (mass ?x ?n) (> ?n 10)))
        (((?X . W2) (?N . 12)))

    Source: ESL §5; ARM §2. Alists: language reference §5. Values: decision 26.
    """
    return running.session.database.alists(query, in_force)


# --- declarations --------------------------------------------------------------------


@macro("(defrelation name &optional arguments documentation)", ESL)
def defrelation(form: Cons, environment: Any) -> Value:
    """Declare NAME to be a relation, so that conditions take it for one.

    ARGUMENTS, a list of names or a number, tells how many there are: facts
    and queries with another number of them are refused. A relation may be
    declared with several numbers.

    Returns: NAME.
    Fails:   :type-error if NAME is no symbol; or means something else in every
             query: AND, OR, NOT, FUNCALL, comparisons.

    Example:
        ? (defrelation connected-to (thing other))
        CONNECTED-TO
        ? (db-query '(connected-to ?x ?y))
        NIL

    Source: ARM §4 tells properties from other assertions; language reference §3.
    """
    return _definition(DEFINE_RELATION, form)


@macro("(defproperty name &optional arguments documentation)", ESL)
def defproperty(form: Cons, environment: Any) -> Value:
    """Declare NAME to be a property: a relation whose final value is unique.

    A fact that is asserted takes the place of the one that differs from it
    in the last argument only.

    Returns: NAME.
    Fails:   :type-error if NAME is no symbol.

    Example:
        ? (defproperty power-state)
        POWER-STATE
        ? (progn (assert '(power-state w1 :off)) (assert '(power-state w1 :on)))
        (POWER-STATE W1 :ON)
        ? (db-query '(power-state w1 ?s))
        (((?S . :ON)))

    Source: ARM §4.
    """
    return _definition(DEFINE_PROPERTY, form)


def _definition(operator: Symbol, form: Cons) -> Value:
    parts = items(form.cdr)
    return lisp_list(operator, *[lisp_list(QUOTE, part) for part in parts])


@function("(%define-relation name &optional arguments documentation)", ESL)
def define_relation(name: Value, arguments: Value = None, documentation: Value = None) -> Value:
    """Declare the relation NAME."""
    _declare(name, arguments)
    return name


@function("(%define-property name &optional arguments documentation)", ESL)
def define_property(name: Value, arguments: Value = None, documentation: Value = None) -> Value:
    """Declare the property NAME."""
    _declare(name, arguments)
    running.session.database.declare_property(name)
    return name


def _declare(name: Value, arguments: Value) -> None:
    """Let NAME be a relation with ARGUMENTS: a list of names, their number, or nothing."""
    if not isinstance(name, Symbol):
        raise type_error(name, "SYMBOL")
    if arguments is None or arguments.__class__ is String:
        running.session.database.declare(name)
    elif arguments.__class__ is int and arguments >= 0:
        running.session.database.declare(name, arguments)
    elif arguments.__class__ is Cons and all(map(_is_name, items(arguments))):
        names = tuple(items(arguments))
        running.session.database.declare(name, len(names), names)
    else:
        raise type_error(arguments, "LIST")


def _is_name(argument: Value) -> bool:
    return isinstance(argument, Symbol) and not argument.name.startswith("&")


@macro("(defrule head &body body)", ESL)
def defrule(form: Cons, environment: Any) -> Value:
    """Derive HEAD whenever all queries in BODY hold.

    Several rules may derive one relation, and a rule may ask what it derives:
    a question ends even if facts lead around in circles. The same rule again
    changes nothing; FORGET-RULES takes rules back. If BODY leaves a variable
    without the value that HEAD, NOT or a test needs, and the question does not
    give it either, asking fails with :unbound-logic-variable.

    Returns: the relation of HEAD.
    Fails:   :unstratified-rules, with the relations on the way around, if HEAD
             would depend on its own absence; :type-error if HEAD or an element
             of BODY is no query.

    Example:
        ? (defrule (reaches ?x ?y) (path ?x ?y))
        REACHES
        ? (defrule (reaches ?x ?z) (reaches ?x ?y) (path ?y ?z))
        REACHES
        ? (progn (assert '(path a b)) (assert '(path b c)) (assert '(path c a)))
        (PATH C A)
        ? (db-query '(reaches b ?where))
        (((?WHERE . C)) ((?WHERE . A)) ((?WHERE . B)))

    Source: language reference §5.
    """
    head, body = form.cdr.car, form.cdr.cdr
    if body.__class__ is Cons and body.car.__class__ is String:  # a documentation
        body = body.cdr
    return lisp_list(DEFINE_RULE, lisp_list(QUOTE, head), lisp_list(QUOTE, body))


@function("(%define-rule head body)", ESL)
def define_rule(head: Value, body: Value) -> Value:
    """Derive HEAD from BODY."""
    running.session.database.define_rule(in_force(head), in_force(body))
    return head.car


@function("(forget-rules name)", ESL)
def forget_rules(name: Value) -> Value:
    """Derive no facts of the relation NAME any more.

    Returns: T, or NIL if there were no rules.

    Example:
        ? (defrule (idle ?x) (is-a ?x robot) (not (works ?x ?_)))
        IDLE
        ? (forget-rules 'idle)
        T

    Source: language reference §5.
    """
    if not isinstance(name, Symbol):
        raise type_error(name, "SYMBOL", Symbol.intern("FORGET-RULES", ESL))
    return truth(running.session.database.forget_rules(name))
