"""The command line: parse, call, print. What is true is decided in certify/kernel alone.

One module for each group of commands: :mod:`checking`, :mod:`evidence`, :mod:`exporting`,
:mod:`auditing`, :mod:`reading`, :mod:`drawing`, :mod:`meshing`, :mod:`splitting`, :mod:`counting`,
:mod:`doubting`, :mod:`building`; what they share is in :mod:`common`.
"""

import os
import sys
from errno import EDQUOT, EFBIG, ENOSPC
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from certify import __version__
from certify.cli import (
    auditing,
    building,
    checking,
    counting,
    doubting,
    drawing,
    evidence,
    exporting,
    meshing,
    reading,
    splitting,
)
from certify.cli.common import fail

__all__ = ["cli", "main"]

NO_ROOM = (EDQUOT, EFBIG, ENOSPC)
"""What a system says when a disk is full; no other words to the command would help."""


class _Commands(click.Group):
    """Commands that end with one line on standard error when they cannot go on."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Run a command, and exit."""
        kwargs["standalone_mode"] = False
        try:
            code = super().main(*args, **kwargs)
        except click.exceptions.NoArgsIsHelpError as error:
            click.echo(error.format_message(), err=True)
            sys.exit(2)
        except click.UsageError as error:
            command = error.ctx.command_path if error.ctx else "certify"
            message = " ".join(error.format_message().split()).rstrip(".")
            fail(f"{message}. See '{command} --help'.", code=2)
        except click.ClickException as error:
            fail(error.format_message(), code=error.exit_code)
        except (click.Abort, KeyboardInterrupt):
            fail("interrupted", code=130)
        except FileExistsError as error:
            fail(f"{error.filename} is not a folder", code=2)
        except OSError as error:
            # What the user named cannot be used; or the output not be written, or a process died.
            reason = error.strerror or str(error)
            code = 1 if error.errno in NO_ROOM or not error.filename else 2
            fail(f"{error.filename}: {reason}" if error.filename else reason, code)
        except Exception as error:
            if _sympy_fails():
                fail(f"sympy cannot be imported: {error}", code=1)
            raise
        sys.exit(code if isinstance(code, int) else 0)

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click passes it
        """Return the commands in the order of their registration, from common to rare."""
        return list(self.commands)


def _sympy_fails() -> bool:
    """Is sympy what cannot be imported? One bad variable in the environment is enough."""
    try:
        import_module("sympy")
    except Exception:
        return True
    return False


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 80},
    epilog="""\b
    Examples:
      certify check-all            replay everything
      certify show 8_E             one pattern, with its evidence
      certify audit --only corrected
    """,
)
@click.version_option(__version__, "-V", "--version", message="certify %(version)s")
def cli() -> None:
    """Exact audit of the 174 subdivisions of the hexahedron into tetrahedra.

    Exit code 0: all is accepted. 1: something was rejected. 2: usage error. 130: interrupted.
    """


for command in (
    checking.check_all,
    checking.check,
    evidence.show,
    evidence.list_,
    auditing.audit,
    reading.explain,
    drawing.draw,
    drawing.atlas,
    exporting.export,
    splitting.split,
    meshing.triangulate,
    meshing.name,
    counting.census,
    checking.replay,
    auditing.spheres,
    doubting.attack,
    doubting.trust,
    building.build,
    building.completion,
):
    cli.add_command(command)


def main() -> None:
    """Run the command line; whatever a terminal cannot show is written as an escape."""
    if sys.stderr is None:  # closed before the start
        sys.stderr = Path(os.devnull).open("w")  # noqa: SIM115 - for as long as the program runs
    if sys.stdout is None:
        fail("standard output is closed", code=1)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    cli(prog_name="certify")
