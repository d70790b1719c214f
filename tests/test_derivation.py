"""The 174 classes a second time: from the spheres with nine vertices."""

from dataclasses import replace

import pytest

from certify.kernel.theorems import Outcome
from certify.opinions import derivation
from certify.opinions.derivation import second_derivation


def test_the_same_174_classes(outcome: Outcome, monkeypatch: pytest.MonkeyPatch) -> None:
    lines: list[str] = []
    found = second_derivation(outcome, lines.append)
    assert found.agrees
    assert (found.spheres, found.graphs) == (1296, 174)
    assert found.hexahedra == {min(verdict.instances) for verdict in outcome.verdicts}
    assert lines[-1] == "174 classes of hexahedra, 174 of decomposition graphs"
    # With one accepted pattern less, or one class less, the two lists differ.
    fewer = replace(outcome, verdicts=outcome.verdicts[1:])
    monkeypatch.setattr(derivation, "spheres", lambda *_: range(1296))
    monkeypatch.setattr(derivation, "hexahedra", lambda _: sorted(found.hexahedra))
    assert second_derivation(outcome, lines.append).agrees
    assert not second_derivation(fewer, lines.append).agrees
    monkeypatch.setattr(derivation, "hexahedra", lambda _: sorted(found.hexahedra)[1:])
    assert not second_derivation(outcome, lines.append).agrees
