"""Commands for whoever builds or installs: build, completion."""

# ruff: noqa: PLC0415 - the libraries of the search are imported where they are needed

from __future__ import annotations

from pathlib import Path

import click
from click.shell_completion import get_completion_class

from certify.cli.common import examples, fail, jobs_option, needing, progress
from certify.printable import printable


@click.command(epilog=examples("certify build --jobs 2 --root found"))
@jobs_option
@click.option(
    "--root",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder to write to; by default the checkout itself.",
)
def build(jobs: int, root: Path | None) -> None:
    """Find all certificates and proofs again.

    They are written to a folder; existing ones are replaced at the end. They prove nothing until
    they are checked.
    """
    from certify.kernel.evidence import default_root

    if root is None and default_root().name == "data":
        fail("an installed package keeps its certificates: give --root DIR", code=2)
    folder = default_root() if root is None else root
    with needing("search"):
        from certify.search.build import build as find
    with progress() as show:
        find(folder, jobs, show)
    click.echo(printable(f"174 certificates written to {folder}; certify check-all checks them"))


@click.command(epilog=examples('eval "$(certify completion bash)"'))
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> None:
    """Print a script that makes a shell complete certify's words."""
    from certify.cli import cli

    if script := get_completion_class(shell):
        click.echo(script(cli, {}, "certify", "_CERTIFY_COMPLETE").source())
