"""Every pattern is found again, however its vertices are called; nothing else is."""

from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from certify.kernel.certificate import PATTERN_NAMES, read_certificate
from certify.kernel.evidence import Evidence
from certify.kernel.hexahedron import FACETS, image, simplex
from certify.mesh.naming import NotNamed, Reading, readings
from tests.commands import CHECKOUT
from tests.geometry import simplices

Solids = list[list[str]]

AS_BARE = (("11_X", "11_AI"), ("13_O", "13_X"), ("14_H", "14_Q"), ("15_A", "15_B", "15_J"),
           ("15_D", "15_K"))  # fmt: skip
"""Patterns with the same tetrahedra, if no facets are marked."""


def tetrahedra(pattern: str) -> list[tuple[int, ...]]:
    content = Evidence(CHECKOUT).certificate(pattern)
    return [*read_certificate(pattern, content).tetrahedra]


def renamed(pattern: str, names: str) -> Solids:
    return [[names[v - 1] for v in t] for t in tetrahedra(pattern)]


def carried(reading: Reading, solids: Solids) -> set[tuple[int, ...]]:
    return {simplex(tuple(reading.names[name] for name in solid)) for solid in solids}


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_a_pattern_is_found_with_its_facets(pattern: str) -> None:
    random = Random(pattern)
    names = "".join(random.sample("abcdefgh", 8))
    solids = renamed(pattern, names)
    random.shuffle(solids)
    facets = [[names[v - 1] for v in facet] for facet in FACETS]
    (found,) = readings(solids, facets)
    assert found.pattern == pattern
    assert carried(found, solids) == {*tetrahedra(pattern)}
    assert {frozenset(f) for f in found.facets()} == {frozenset(f) for f in facets}


@pytest.mark.parametrize("pattern", PATTERN_NAMES)
def test_without_facets_all_readings_are_found(pattern: str) -> None:
    solids = renamed(pattern, "hgfedcba")
    found = readings(solids)
    expected = next((group for group in AS_BARE if pattern in group), (pattern,))
    assert tuple(dict.fromkeys(reading.pattern for reading in found)) == expected
    for reading in found:
        assert carried(reading, solids) == {*tetrahedra(reading.pattern)}
    assert len({frozenset(map(frozenset, own.facets())) for own in found}) == len(found)


def test_names_may_be_long() -> None:
    names = [f"node {k}" for k in (10, 9, 8, 100, 5, 7, 1, 2)]
    (found,) = readings([[names[v - 1] for v in t] for t in tetrahedra("8_E")])
    assert found.pattern == "8_E"
    assert {*found.names} == {*names}


def drop(solids: Solids) -> Solids:
    return solids[:-1]


def repeat(solids: Solids) -> Solids:
    return [*solids, solids[0][::-1]]


def pinch(solids: Solids) -> Solids:
    return [[*solids[0][:3], solids[0][0]], *solids[1:]]


def ninth(solids: Solids) -> Solids:
    return [*solids, [*solids[0][:3], "9"]]


def apart(_: Solids) -> Solids:
    return [[*"1234"], [*"5678"]]


def seven(_: Solids) -> Solids:
    return [[*"1234"], [*"2345"], [*"3456"], [*"4567"]]


def far_from_a_ball(_: Solids) -> Solids:
    words = "1235 1257 1267 1348 1357 1378 1568 1678 2357"
    return [[*map(str, solid)] for solid in simplices(words)]


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (drop, "the boundary's twelve triangles make no hexahedron"),
        (apart, "8 triangles lie in exactly one tetrahedron, and the boundary of a hexahedron"),
        (repeat, "a tetrahedron is there twice"),
        (pinch, "1, 2, 3 are not four different vertices"),
        (ninth, "the tetrahedra have 9 vertices, and a hexahedron has 8"),
        (seven, "the tetrahedra have 7 vertices"),
        (far_from_a_ball, "no shelling"),
    ],
)
def test_what_is_no_pattern(spoil: Callable[[Solids], Solids], message: str) -> None:
    with pytest.raises(NotNamed, match=message):
        readings(spoil(renamed("8_E", "12345678")))


def test_a_boundary_tetrahedron_is_said() -> None:
    """With a tetrahedron on a facet, that facet's diagonal changes."""
    cube = simplices("1235 1345 2356 3458 3567 3578")
    solids = [[*map(str, t)] for t in [*cube, (1, 2, 3, 4)]]
    with pytest.raises(NotNamed, match="1234 is a boundary tetrahedron"):
        readings(solids, [[*map(str, facet)] for facet in FACETS])


def test_other_facets_are_refused() -> None:
    turned = (2, 1, 3, 4, 5, 6, 7, 8)
    facets = [[*map(str, image(turned, simplex(facet)))] for facet in FACETS]
    with pytest.raises(NotNamed, match="with the marked facets"):
        readings(renamed("5_A", "12345678"), facets)


def test_a_missing_certificate_is_said(tmp_path: Path, root: Path) -> None:
    (root / "certificates" / "5_A.json").write_text("{}")
    with pytest.raises(ValueError, match="5_A"):
        readings(renamed("5_A", "12345678"), root=root)
