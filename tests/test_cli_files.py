"""What a file says or is called is printed so that it cannot control a terminal."""

from pathlib import Path

import pytest

from certify.kernel import check as checking
from tests.commands import assert_rejects, five_a, run, write


def test_unreadable_certificate(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    assert_rejects(run(root, "check", "5_A"), "5_A.json", "cannot be read: Permission denied")


@pytest.mark.parametrize(
    "key", ["\x1b[31m[bold red]x", "\ud800", "a\nb", "\u202e:smile:", "\x9b2J"]
)
def test_hostile_text_is_escaped(root: Path, key: str) -> None:
    write(root, five_a() | {key: 1})
    for command in (["check", "5_A"], ["show", "5_A"], ["list"], ["check-all"]):
        _, out, err = run(root, *command)
        assert ascii(key)[1:-1] in out
        assert all(char.isprintable() for char in (out + err).replace("\n", ""))


def test_hostile_file_name_is_escaped(root: Path) -> None:
    (root / "certificates" / "\x1b[2J[red]\n.json").touch()
    code, out, _ = run(root, "check-all")
    assert code == 1
    assert r"rejected: certificates/\x1b[2J[red]\n.json: the file is not named" in out


def test_a_kernel_that_breaks_off_rejects(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def break_off(*_: object) -> None:
        raise RuntimeError("out of order")

    monkeypatch.setattr(checking, "shelling", break_off)
    fault = "RuntimeError('out of order')"
    assert_rejects(run(root, "check", "5_A"), "certificates/5_A.json", fault)
