"""The program as a whole: help, usage errors, terminals, interrupts."""

import json
import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from certify import __version__
from certify.cli import cli
from certify.kernel import check as checking
from certify.kernel import evidence
from tests.commands import CHECKOUT, five_a, run, spawn, write

HELP = Path(__file__).parent / "help.txt"
"""All help pages at 80 columns. To renew it: python -m tests.test_cli_program."""


def help_pages() -> str:
    """Return the help pages of the program and of all commands."""
    pages = []
    for args in ([], *([name] for name in cli.commands)):
        result = CliRunner(env={"COLUMNS": "80"}).invoke(cli, [*args, "-h"])
        assert result.exit_code == 0
        pages.append(f"$ {' '.join(('certify', *args, '--help'))}\n{result.stdout}")
    return "\n".join(pages).replace("Usage: cli", "Usage: certify")


def test_help_pages_stay_as_they_are() -> None:
    assert help_pages() == HELP.read_text()
    assert all(len(line) <= 80 for line in HELP.read_text().splitlines())


@pytest.mark.parametrize("command", cli.commands)
def test_help_has_an_example(command: str) -> None:
    result = CliRunner().invoke(cli, [command, "--help"])
    assert f"certify {command}" in result.output.partition("Example")[2]


def test_no_command_prints_the_help() -> None:
    result = CliRunner(env={"COLUMNS": "80"}).invoke(cli, [])
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.splitlines()[1:] == HELP.read_text().split("\n\n$ ")[0].splitlines()[2:]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion(shell: str) -> None:
    result = CliRunner().invoke(cli, ["completion", shell])
    assert result.exit_code == 0
    assert "_CERTIFY_COMPLETE" in result.stdout
    assert CliRunner().invoke(cli, ["completion", "tcsh"]).exit_code == 2


def test_patterns_are_completed() -> None:
    words = {"COMP_WORDS": "certify show 15_", "COMP_CWORD": "2"}
    environment = os.environ | words | {"_CERTIFY_COMPLETE": "bash_complete"}
    command = [sys.executable, "-c", "from certify.cli import main; main()"]
    result = subprocess.run(
        command, cwd=CHECKOUT, env=environment, capture_output=True, text=True, check=False
    )
    assert result.stdout.split() == [f"plain,15_{letter}" for letter in "ABCDEFGHIJK"]


@pytest.mark.parametrize(
    "args", [["frobnicate"], ["check"], ["show", "5_A", "6_A"], ["list", "-x"]]
)
def test_usage_errors(args: list[str]) -> None:
    result = CliRunner().invoke(cli, args)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith("certify: ")
    assert len(result.stderr.splitlines()) == 1


def test_interrupt(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(checking, "shelling", interrupt)
    assert run(root, "check", "5_A") == (130, "", "\ncertify: interrupted\n")


def test_default_root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert evidence.default_root() == CHECKOUT
    monkeypatch.setattr(evidence, "__file__", str(tmp_path / "certify" / "kernel" / "evidence.py"))
    (tmp_path / "certify" / "data").mkdir(parents=True)
    assert evidence.default_root() == tmp_path / "certify" / "data"


def test_version_and_help_do_without_sympy() -> None:
    result = spawn("--version", capture_output=True)
    assert (result.returncode, result.stdout) == (0, f"certify {__version__}\n")
    code = (
        "import sys\nfrom certify.cli import main\nsys.argv = ['certify', '--help']\n"
        "try:\n    main()\nexcept SystemExit:\n    sys.exit('sympy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], cwd=CHECKOUT, check=False).returncode == 0


def test_program_uses_its_own_certificates() -> None:
    result = spawn("check", "5_A", capture_output=True)
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.startswith("ok: 5_A: realizable yes")


def test_program_writes_to_any_terminal(root: Path) -> None:
    write(root, five_a() | {"\u4e2d": 1})
    environment = os.environ | {"PYTHONIOENCODING": "latin-1", "COLUMNS": "20"}
    result = spawn("list", "--root", str(root), capture_output=True, env=environment)
    assert (result.returncode, result.stderr) == (1, "")
    assert r"unknown key '\u4e2d'" in result.stdout
    rows = [line.replace("|", " ").split() for line in result.stdout.splitlines()]
    assert ["15_A", "15", "g", "24", "no", "no", "no"] in rows


def test_progress_goes_to_a_terminal_on_standard_error(root: Path) -> None:
    command = [sys.executable, "-m", "certify", "check-all", "--json", "--root", str(root)]
    parent, child = pty.openpty()
    with (root / "out").open("wb") as out:
        process = subprocess.Popen(
            [*command, "--jobs", "2"], cwd=CHECKOUT, stdout=out, stderr=child
        )
    os.close(child)
    assert "checking" in drained(parent)
    assert process.wait() == 1
    assert json.loads((root / "out").read_text())["patterns"] == 2


def drained(terminal: int) -> str:
    """Return what is written to a terminal until its other end is closed."""
    content = b""
    try:
        while chunk := os.read(terminal, 1 << 12):
            content += chunk
    except OSError:  # so Linux says that the other end is closed
        pass
    os.close(terminal)
    return content.decode()


def test_program_survives_a_closed_pipe(root: Path) -> None:
    read, write_ = os.pipe()
    os.close(read)
    for args in (["check", "5_A"], ["list"], ["check-all", "--json"], ["--help"]):
        root_args = [] if args == ["--help"] else ["--root", str(root)]
        result = spawn(*args, *root_args, stdout=write_, stderr=subprocess.PIPE)
        assert "Traceback" not in result.stderr
        assert "Exception" not in result.stderr
    os.close(write_)


if __name__ == "__main__":
    HELP.write_text(help_pages())
