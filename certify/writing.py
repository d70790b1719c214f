"""Files are written whole or not at all. Nothing here is trusted."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from errno import EEXIST
from pathlib import Path
from tempfile import TemporaryDirectory


@contextmanager
def written_to(folder: Path) -> Iterator[Path]:
    """Give a scratch folder; at the end its files take their places below ``folder``.

    They begin to do so when all of them are complete. Each takes its place by a rename: whoever
    looks sees the old file or the new one, never a part of one, and never none. Whatever goes wrong
    before that, a full disk or an interrupt, changes nothing and leaves nothing behind. A process
    that is killed leaves a hidden folder, .certify-..., beside the files; one that is stopped
    between two renames leaves some files new and the others old.

    Raises:
        OSError: The files cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise FileExistsError(EEXIST, "it is not a folder", str(folder))
    folder.parent.mkdir(parents=True, exist_ok=True)
    beside = folder if folder.exists() else folder.parent  # on the same disk, as renames need it
    try:
        with TemporaryDirectory(dir=beside, prefix=".certify-") as name:
            yield Path(name)
            for file in sorted(path for path in Path(name).rglob("*") if path.is_file()):
                place = folder / file.relative_to(name)
                place.parent.mkdir(parents=True, exist_ok=True)
                file.replace(place)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(folder)) from error


def write_files(folder: Path, contents: Mapping[str, bytes]) -> list[Path]:
    """Write the contents to files, by their paths below a folder; return the files."""
    with written_to(folder) as scratch:
        for name, content in contents.items():
            (scratch / name).parent.mkdir(parents=True, exist_ok=True)
            (scratch / name).write_bytes(content)
    return [folder / name for name in contents]


def write_file(path: Path, content: bytes) -> None:
    """Write one file, that to which ``path`` leads. A pipe or a terminal is written to as it is."""
    if path.exists() and not path.is_file():
        path.write_bytes(content)
    else:
        target = path.resolve()
        write_files(target.parent, {target.name: content})
