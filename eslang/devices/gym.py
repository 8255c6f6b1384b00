"""Worlds that others wrote: the environments of Gymnasium.

An environment is known to plans by its name. What its sensors tell are facts,
and so are how its episode stands and what it scored; an action goes to it by
environment-step (stdlib/environments.esl). Gymnasium is an optional extra,
and imported when a plan first makes an environment.
"""

from __future__ import annotations

from eslang.base.border import Text, to_lisp
from eslang.base.failure import Failure, type_error
from eslang.base.hints import TYPE_CHECKING, Any
from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol, lisp_name

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter

SENSED, EPISODE, SCORE = (Symbol.intern(name, "ESL") for name in ("SENSED", "EPISODE", "SCORE"))
RUNNING, TERMINATED, TRUNCATED = (Keyword(name) for name in ("RUNNING", "TERMINATED", "TRUNCATED"))
EXTRA = "pip install 'eslang[gym]'"
SEEDS = 2**31


class Environment:
    """One environment: the world that Gymnasium made, what its sensors are called, and its episode."""

    def __init__(self, name: Any, world: Any, sensors: list[Any]) -> None:
        self.name = name
        self.world = world
        self.sensors = sensors
        self.episode = RUNNING
        self.score = 0.0

    def begin(self, seed: int | None) -> list[Any]:
        """Begin an episode; the facts of its beginning."""
        observation, _ = self.world.reset(seed=seed)
        self.episode, self.score = RUNNING, 0.0
        return [*self.sensed(observation), [EPISODE, self.name, RUNNING]]

    def step(self, action: Any) -> tuple[float, list[Any]]:
        """Do ACTION, which is one of the world's own; the reward, and the facts that there are now."""
        observation, reward, terminated, truncated, _ = self.world.step(action)
        self.score += float(reward)
        facts = self.sensed(observation)
        if terminated or truncated:
            self.episode = TERMINATED if terminated else TRUNCATED
            facts += [[EPISODE, self.name, self.episode], [SCORE, self.name, self.score]]
        return float(reward), facts

    def sensed(self, observation: Any) -> list[Any]:
        """The facts that OBSERVATION makes: one for each of its parts."""
        parts = parts_of(observation)
        names = [*self.sensors, *[name for name, _ in parts[len(self.sensors) :]]]
        return [[SENSED, self.name, name, value] for name, (_, value) in zip(names, parts, strict=False)]


class Environments:
    """The environments of one interpreter."""

    def __init__(self, agent: Interpreter) -> None:
        self.agent = agent
        self.named: dict[Any, Environment] = {}

    def make_environment(
        self, kind: str, *, name: Any = None, seed: int | None = None, sensors: Any = None, **options: Any
    ) -> Any:
        """Make an environment of Gymnasium, and begin its first episode.

        KIND is Gymnasium's word for it, such as "LunarLander-v3". NAME is what
        plans call it from now on: that keyword, :lunarlander-v3, unless given.
        SENSORS names the parts of an observation, in order; those without are
        0, 1 and so on, or what Gymnasium calls them. SEED makes chance in it
        repeatable; unless given, it is drawn from the seed of the run. All
        other options are Gymnasium's own: :render-mode "human" shows it.

        Facts tell of it from now on: (sensed NAME SENSOR VALUE) and
        (episode NAME STATE), where STATE is :running, or :terminated or
        :truncated when it is over; then there is (score NAME TOTAL), too.

        Returns: NAME.
        Fails:   :no-such-package, with its name and how to install it, if
                 Gymnasium is not there; :no-such-environment, with KIND and
                 what Gymnasium says of it.

        Source: ours; Gymnasium's make and reset.
        """
        name = Keyword(kind) if name is None else name
        if isinstance(name, list):
            raise type_error(to_lisp(name), "ATOM", Symbol.intern("MAKE-ENVIRONMENT", "ESL"))
        world = make_world(kind, options)
        self.agent.call("esl::%declare-environments")
        if name in self.named:
            self.environment_close(name)
        self.named[name] = Environment(plain(name), world, list(map(plain, sensors or [])))
        return self.environment_reset(name, seed=self.agent.chance.randrange(SEEDS) if seed is None else seed)

    def environment_reset(self, environment: Any, *, seed: int | None = None) -> Any:
        """Begin a new episode of ENVIRONMENT, which need not be over.

        Without SEED, chance in it goes on where it is.

        Returns: ENVIRONMENT.
        Fails:   :no-such-environment, with the nearest name there is.

        Source: ours; Gymnasium's reset.
        """
        begun = self.known(environment)
        self.agent.facts.remove([SCORE, begun.name, "?_"])
        self.agent.facts.add_all(begun.begin(seed))
        return environment

    def step(self, environment: Any, action: Any) -> float:
        """What ENVIRONMENT-STEP does."""
        stepped = self.known(environment)
        if stepped.episode is not RUNNING:
            raise Failure("episode-over", environment, stepped.episode)
        reward, facts = stepped.step(as_action(stepped.world.action_space, action))
        self.agent.facts.add_all(facts)
        return reward

    def environment_score(self, environment: Any) -> float:
        """Tell the sum of all rewards in this episode of ENVIRONMENT.

        Returns: a number.
        Fails:   :no-such-environment, with the nearest name there is.

        Source: ours.
        """
        return self.known(environment).score

    def environment_close(self, environment: Any) -> Any:
        """Close ENVIRONMENT, and the window that shows it; forget its facts.

        Returns: ENVIRONMENT.
        Fails:   :no-such-environment, with the nearest name there is.

        Source: ours; Gymnasium's close.
        """
        closed = self.known(environment)
        closed.world.close()
        del self.named[environment]
        for relation, others in ((SENSED, 2), (EPISODE, 1), (SCORE, 1)):
            self.agent.facts.remove([relation, closed.name, *["?_"] * others])
        return environment

    def known(self, environment: Any) -> Environment:
        """The environment of that name."""
        try:
            return self.named[environment]
        except (KeyError, TypeError):
            names = {str(name).lower(): name for name in self.named}
            near = nearest(str(environment).lower(), names)
            raise Failure("no-such-environment", environment, near and names[near]) from None


def make_world(kind: str, options: dict[str, Any]) -> Any:
    """The world of that KIND. Raises Failure."""
    from warnings import catch_warnings, simplefilter

    with catch_warnings():
        simplefilter("ignore")  # some worlds are libraries in C, and die of a warning that is an error
        try:
            import gymnasium
        except ImportError:
            raise Failure("no-such-package", "gymnasium", EXTRA) from None
        try:
            return gymnasium.make(kind, disable_env_checker=True, **options)
        except gymnasium.error.DependencyNotInstalled as error:
            raise Failure("no-such-package", str(error), EXTRA) from None
        except (gymnasium.error.Error, ModuleNotFoundError) as error:
            raise Failure("no-such-environment", kind, str(error)) from None


def as_action(space: Any, action: Any) -> Any:
    """ACTION as the world of that action SPACE has it. Raises Failure."""
    made = action
    if getattr(space, "dtype", None) is not None and space.shape is not None:
        import numpy

        try:
            made = numpy.asarray(action, None if space.dtype.kind in "iu" else space.dtype)
            if made.dtype.kind == space.dtype.kind:
                made = made.astype(space.dtype).reshape(space.shape)[()]
        except (TypeError, ValueError):
            made = None
    if made is None or not space.contains(made):
        raise Failure("no-such-action", action, str(space))
    return made


def parts_of(observation: Any) -> list[tuple[Any, Any]]:
    """The parts of OBSERVATION, each with what it is called: its place, or its name."""
    if isinstance(observation, dict):
        return [(Keyword(lisp_name(name)), plain(part)) for name, part in observation.items()]
    is_row = isinstance(observation, tuple) or getattr(observation, "ndim", None) == 1
    return list(enumerate(map(plain, observation if is_row else [observation])))


def plain(value: Any) -> Any:
    """VALUE as facts are to have it: text that is no name, and numbers that are not numpy's."""
    if isinstance(value, str):
        return Text(value)
    return value.tolist() if hasattr(value, "tolist") else value


def install(agent: Interpreter) -> None:
    """Give an interpreter its environments, of which there are none yet."""
    here = Environments(agent)
    signature = "(esl::make-environment kind &key name seed sensors &allow-other-keys)"
    agent.primitive(signature=signature, outside=False)(here.make_environment)
    agent.primitive(signature="(esl::environment-reset environment &key seed)", outside=False)(
        here.environment_reset
    )
    agent.primitive(signature="(esl::%environment-step environment action)", outside=False)(here.step)
    agent.primitive(signature="(esl::environment-close environment)", outside=False)(here.environment_close)
    agent.primitive(signature="(esl::environment-score environment)", outside=False)(here.environment_score)
