"""One pytest session for many mutants: each is tried in a forked copy of it.

A function that has not been called by the time the tests are collected may as well have been
another one from the start. So its mutants are tried in a copy of a process that has collected the
tests already (:class:`Warm`). The others have a copy of a process that knows nothing of this
project: it imports the mutated module and collects the tests anew (:class:`Cold`).
"""

import faulthandler
import gc
import json
import os
import resource
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import _lru_cache_wrapper, partial
from importlib.abc import InspectLoader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_loader
from itertools import zip_longest
from math import inf
from pathlib import Path
from types import CodeType, FrameType, FunctionType
from typing import Any

import pytest
from _pytest.runner import runtestprotocol

from tests.mutation.operators import Mutant, Source

CHECKOUT = Path(__file__).resolve().parents[2]

SUITE = (
    *("hexahedron", "triangulation", "chirotope", "embedding", "jacobian", "orientations"),
    *("refutation", "validity", "completeness", "evidence", "certificate_reading", "check"),
    *("certificates", "theorems", "kernel_door", "cli_files", "opinions_formulas"),
)
"""The modules of tests that ask for the kernel's verdicts in the same process."""

NEAR = {
    "certificate": ("certificate_reading",),
    "check": ("check", "certificates", "certificate_reading"),
    "cube": ("theorems",),
    "evidence": ("evidence", "certificate_reading"),
    "__main__": ("kernel_door",),
    "names": ("theorems",),
}
"""Module of the kernel -> what tests it above all, where that is not the module of its name."""

ARGUMENTS = [
    *("-o", "addopts=", "-m", "not slow", "-qq", "-s", "--strict-markers"),
    *("-p", "no:cacheprovider", "-p", "no:xdist", "--tb=native"),
]

MEMORY = 1 << 30
"""How many bytes a mutant may use beyond what is there at the start."""

Unit = tuple[str, int]
"""A function of the kernel: module, and first line."""


@dataclass
class Cost:
    """What is known of one test from a run of the unchanged kernel."""

    shared: float
    """Seconds of processor time that its fixtures take which it shares with other tests."""
    own: float
    """Seconds of processor time of the test itself."""
    units: set[Unit] = field(default_factory=set)
    """The functions that are called in it or in its fixtures."""


def write_costs(path: Path, costs: dict[str, Cost]) -> None:
    record = {test: [cost.shared, cost.own, sorted(cost.units)] for test, cost in costs.items()}
    path.write_text(json.dumps(record))


def read_costs(path: Path) -> dict[str, Cost]:
    record = json.loads(path.read_text())
    return {
        test: Cost(shared, own, {(module, first) for module, first in units})
        for test, (shared, own, units) in record.items()
    }


def files(suite: Iterable[str]) -> list[str]:
    """Return modules of tests as arguments for pytest."""
    return [str(CHECKOUT / "tests" / f"test_{name}.py") for name in suite]


def near(mutant: Mutant) -> tuple[str, ...]:
    """Return the modules of tests that are above all about the mutant's module."""
    return NEAR.get(mutant.module, (mutant.module,))


# Watching what is called.


class Watch:
    """Notes which functions of the kernel are called."""

    def __init__(self, sources: Iterable[Source]) -> None:
        self._sources = {source.path: source for source in sources}
        self._units: dict[CodeType, Unit | None] = {}
        self.called: set[Unit] = set()
        """What was called since this was emptied."""

    def start(self) -> None:
        """Note every call from now on, slowly."""
        sys.settrace(self._on_call)

    def stop(self) -> None:
        sys.settrace(None)

    def _on_call(self, frame: FrameType, _event: str, _arg: object) -> None:
        code = frame.f_code
        if code not in self._units:
            self._units[code] = self.unit(code)
        if unit := self._units[code]:
            self.called.add(unit)

    def unit(self, code: CodeType) -> Unit | None:
        """Return the function of the kernel that this is code of, if it is."""
        source = self._sources.get(code.co_filename)
        first = source and source.unit_at(code.co_firstlineno)
        return (source.module, first) if source and first else None

    def instrument(self, functions: Iterable[FunctionType]) -> None:
        """Let these functions themselves note that they are called, which takes less time."""
        codes = {
            path: {place(part): part for part in parts(source.reporting("note_call"))}
            for path, source in self._sources.items()
        }
        for function in functions:
            source = self._sources[function.__code__.co_filename]
            function.__globals__["note_call"] = partial(self._note, source.module)
            function.__code__ = codes[source.path][place(function.__code__)]

    def _note(self, module: str, first: int) -> None:
        self.called.add((module, first))


# Trying one mutant, in a process of its own.

SURVIVED, KILLED, TIMED_OUT, NOT_TRIED = 0, 1, 2, 3


@dataclass(frozen=True)
class Trial:
    """How one mutant fared."""

    outcome: int
    by: str
    """The test that killed it, or in which time ran out."""


def in_a_copy(run: Callable[[Path], int]) -> tuple[int, Path]:
    """Fork; run in the copy, silent and with a folder of its own; return its id and the folder."""
    folder = Path(tempfile.mkdtemp(prefix="mutant-"))
    pid = os.fork()
    if pid:
        return pid, folder
    code = NOT_TRIED
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        faulthandler.disable()
        nowhere = os.open(os.devnull, os.O_RDWR)
        for descriptor in (0, 1, 2):
            os.dup2(nowhere, descriptor)
        code = run(folder)
    finally:
        os._exit(code)


def alone(run: Callable[[Path], int]) -> None:
    """Run in a copy of this process, and wait for it."""
    pid, folder = in_a_copy(run)
    finished(folder, os.waitpid(pid, 0)[1])


def finished(folder: Path, status: int) -> Trial:
    """Return how the mutant in a process that has ended fared."""
    note = folder / "test"
    by = note.read_text() if note.exists() else "collection"
    shutil.rmtree(folder, ignore_errors=True)
    code = os.waitstatus_to_exitcode(status)
    outcome = {
        SURVIVED: SURVIVED,
        KILLED: KILLED,
        -signal.SIGVTALRM: TIMED_OUT,
        -signal.SIGALRM: TIMED_OUT,
        -signal.SIGSEGV: KILLED,
        -signal.SIGABRT: KILLED,
    }.get(code)
    if outcome is None:
        raise RuntimeError(f"a process ended with {code}, not by the mutant, in {by}")
    return Trial(outcome, "" if outcome == SURVIVED else by)


def limit_memory() -> None:
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    most = pages * resource.getpagesize() + MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (most, most))


def limit_time(expected: float) -> None:
    """End this process once it has run far longer than the unchanged kernel has."""
    signal.setitimer(signal.ITIMER_VIRTUAL, 4 + 10 * expected)
    signal.alarm(int(120 + 100 * expected))


def run_items(
    items: Sequence[pytest.Item], folder: Path, costs: dict[str, Cost], patience: float
) -> int:
    """Run tests in this order until one fails, or the cost of the next ones is too great."""
    started: set[float] = set()
    for item, following in zip_longest(items, items[1:]):
        cost = costs.get(item.nodeid, Cost(0, 0))
        expected = cost.own + (cost.shared if cost.shared not in started else 0)
        started.add(cost.shared)
        patience -= expected
        if patience < 0:
            return SURVIVED
        (folder / "test").write_text(item.nodeid)
        limit_time(cost.own + cost.shared)
        try:
            reports = runtestprotocol(item, log=False, nextitem=following)
        except BaseException:  # such as KeyboardInterrupt, which no test is expected to let out
            return KILLED
        if any(report.failed for report in reports):
            return KILLED
    return SURVIVED


def in_order(
    items: Iterable[pytest.Item], mutant: Mutant, costs: dict[str, Cost], killers: list[str]
) -> list[pytest.Item]:
    """Return the tests that may notice a mutant, those that soon will first.

    First come the killers of other mutants of the function; then new tests, of which nothing is
    known; then those of the module that call the function, then others that call it. Quick ones
    come first, and of those that differ in their parameters alone not too many at a time. Where it
    is not known what calls it, the tests of the module are followed by those that ask for all
    verdicts, for which they share a fixture.
    """
    alike: Counter[str] = Counter()
    places = {test: place for place, test in enumerate(killers)}
    unit = (mutant.module, mutant.unit)
    own = {f"tests/test_{name}.py" for name in near(mutant)}

    def key(item: pytest.Item) -> tuple[float, bool, bool, float]:
        known = item.nodeid in costs
        cost = costs.get(item.nodeid, Cost(0, 0))
        of_module = item.nodeid.partition("::")[0] in own
        calls = unit in cost.units if mutant.unit else of_module
        # About ten tests share what they share.
        share = cost.own + cost.shared / 10 if calls else cost.own - cost.shared
        place = places.get(item.nodeid, inf)
        function = item.nodeid.partition("[")[0]
        alike[function] += 1
        number = alike[function]
        share = share * number if share > 0 else share / number
        return place, known and not calls, known and not of_module, share

    return sorted(items, key=key)


def use_folder(session: pytest.Session, folder: Path) -> None:
    """Let the fixture tmp_path make its folders in this one."""
    session.config._tmp_path_factory._basetemp = folder  # type: ignore[attr-defined]


# The unchanged kernel.


class Measure:
    """Runs every test once, and notes its cost and what it calls."""

    def __init__(self, watch: Watch) -> None:
        self._watch = watch
        self._fixtures: dict[tuple[str, str], Cost] = {}
        self._shared = 0.0

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(
        self, fixturedef: pytest.FixtureDef[Any]
    ) -> Generator[None, object, object]:
        if fixturedef.scope == "function":
            return (yield)
        before, self._watch.called = self._watch.called, set()
        start = time.process_time()
        try:
            return (yield)
        finally:
            spent = time.process_time() - start
            self._shared += spent
            where = (fixturedef.baseid, fixturedef.argname)
            self._fixtures[where] = Cost(0, spent, self._watch.called)
            self._watch.called = before | self._watch.called

    def run(
        self, items: Sequence[pytest.Item], caches: Sequence["_lru_cache_wrapper[Any]"]
    ) -> dict[str, Cost]:
        """Return the cost of each test with empty caches; raise RuntimeError if one fails."""
        measured = {}
        for item, following in zip_longest(items, items[1:]):
            for cache in caches:  # so that each test calls what it needs
                cache.cache_clear()
            self._watch.called = set()
            self._shared, start = 0.0, time.process_time()
            reports = runtestprotocol(item, log=False, nextitem=following)
            if any(report.failed for report in reports):
                raise RuntimeError(f"{item.nodeid} fails without any mutant")
            own = max(0.0, time.process_time() - start - self._shared)
            measured[item.nodeid] = Cost(0, own, self._watch.called)
        for item in items:
            cost = measured[item.nodeid]
            for (base, name), fixture in self._fixtures.items():
                if name in getattr(item, "fixturenames", ()) and item.nodeid.startswith(base):
                    cost.shared += fixture.own
                    cost.units |= fixture.units
        return measured


# The two ways.


class Warm:
    """Plugin: collects the tests, then lets a function try mutants."""

    def __init__(self, sources: Sequence[Source], use: Callable[["Warm"], None]) -> None:
        self._watch = Watch(sources)
        self._measure = Measure(self._watch)
        self._use = use
        self.early: set[Unit] = set()
        """The functions that are called before the tests are collected."""

    def start(self) -> None:
        self._watch.start()
        pytest.main([*ARGUMENTS, *files(SUITE)], plugins=[self, self._measure])

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        self._watch.stop()
        self.early = self._watch.called
        self._session = session
        everything = gc.get_objects()
        self._functions = [
            thing
            for thing in everything
            if isinstance(thing, FunctionType) and self._watch.unit(thing.__code__)
        ]
        self._caches = [
            thing
            for thing in everything
            if isinstance(thing, _lru_cache_wrapper)
            and thing.__wrapped__.__module__.startswith(("certify.", "tests."))
        ]
        gc.freeze()  # so that a copy need not copy what is never changed
        self._use(self)
        return True

    def measure(self) -> dict[str, Cost]:
        """Return what each test costs and calls with the unchanged kernel."""
        self._watch.instrument(self._functions)
        return self._measure.run(self._session.items, self._caches)

    def try_mutant(
        self,
        costs: dict[str, Cost],
        patience: float,
        killers: Callable[[Mutant], list[str]],
        mutant: Mutant,
        folder: Path,
    ) -> int:
        """Put the mutant in place of the function, and run the tests that call it."""
        limit_memory()
        use_folder(self._session, folder)
        changed = {place(part): part for part in parts(mutant.compile())}
        unit = (mutant.module, mutant.unit)
        for function in self._functions:
            if self._watch.unit(function.__code__) == unit:
                function.__code__ = changed[place(function.__code__)]
        items = [
            item
            for item in self._session.items
            if item.nodeid not in costs or unit in costs[item.nodeid].units
        ]
        items = in_order(items, mutant, costs, killers(mutant))
        return run_items(items, folder, costs, patience)


def parts(code: CodeType) -> Iterator[CodeType]:
    """Yield a module's code and that of all functions in it."""
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from parts(constant)


def place(code: CodeType) -> tuple[int, str]:
    return code.co_firstlineno, code.co_qualname


class Cold(MetaPathFinder, InspectLoader):
    """Plugin, and finder of one mutated module."""

    def __init__(
        self,
        costs: dict[str, Cost],
        patience: float,
        killers: Callable[[Mutant], list[str]],
        mutant: Mutant,
        folder: Path,
    ) -> None:
        self._mutant = mutant
        self._name = f"certify.kernel.{mutant.module}"
        self._costs = costs
        self._killers = killers(mutant)
        self._folder = folder
        self._patience = patience
        self._outcome = KILLED

    def find_spec(self, name: str, *_: object) -> ModuleSpec | None:
        if name != self._name:
            return None
        spec = spec_from_loader(name, self, origin=self._mutant.source.path)
        if spec:
            spec.has_location = True
        return spec

    def get_code(self, _: str) -> CodeType:
        return self._mutant.compile()

    def get_source(self, _: str) -> str:
        return "\n".join(self._mutant.source.lines)

    def start(self) -> int:
        limit_memory()
        limit_time(20)
        sys.meta_path.insert(0, self)
        for suite in (near(self._mutant), SUITE):  # to collect few tests takes less time
            self._outcome = KILLED
            pytest.main([*ARGUMENTS, *files(suite)], plugins=[self])
            if self._outcome != SURVIVED:
                break
        return self._outcome

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        use_folder(session, self._folder)
        if session.testsfailed:
            return True
        self._outcome = NOT_TRIED  # unless all below goes well
        items = in_order(session.items, self._mutant, self._costs, self._killers)
        self._outcome = run_items(items, self._folder, self._costs, self._patience)
        return True


def in_copies(
    jobs: int, mutants: Iterable[Mutant], attempt: Callable[[Mutant, Path], int]
) -> Iterator[tuple[Mutant, Trial]]:
    """Try mutants, each in a copy of this process, and yield how they fared as they are done."""
    running: dict[int, tuple[Mutant, Path]] = {}

    def next_done() -> tuple[Mutant, Trial]:
        pid, status = os.wait()
        mutant, folder = running.pop(pid)
        return mutant, finished(folder, status)

    for mutant in mutants:
        if len(running) >= jobs:
            yield next_done()
        pid, folder = in_a_copy(partial(attempt, mutant))
        running[pid] = (mutant, folder)
    while running:
        yield next_done()
