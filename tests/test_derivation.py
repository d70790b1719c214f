"""The 174 classes a second time: from the spheres with nine vertices."""

from certify.kernel.check import Verdict
from certify.opinions.derivation import second_derivation


def test_the_same_174_classes(verdicts: dict[str, Verdict]) -> None:
    lines: list[str] = []
    derivation = second_derivation(lines.append)
    assert derivation.agrees
    assert derivation.spheres == 1296
    assert derivation.graphs == 174
    assert derivation.hexahedra == {min(verdict.instances) for verdict in verdicts.values()}
    assert lines[-1] == "174 classes of hexahedra, 174 of decomposition graphs"
