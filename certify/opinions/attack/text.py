"""Forged files: bytes of certificates and proofs changed, and the structure of the JSON."""

import json
from collections.abc import Callable
from hashlib import sha256
from random import Random
from typing import Any

from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.opinions.attack.corpus import Corpus, Draft, Forgery, Mutator, Record


def _flip(random: Random, content: bytearray) -> None:
    """A bit changes, or a digit."""
    i = random.randrange(len(content))
    if random.random() < 0.5:
        digits = [k for k, byte in enumerate(content) if chr(byte).isdigit()]
        content[random.choice(digits)] = random.choice(b"0123456789")
    else:
        content[i] ^= 1 << random.randrange(8)


def _cut(random: Random, content: bytearray) -> None:
    """Some bytes are missing."""
    i = random.randrange(len(content))
    del content[i : i + random.choice((1, 1, 2, 10, len(content)))]


def _insert(random: Random, content: bytearray) -> None:
    """Some bytes are new."""
    new = random.choice(
        (b" ", b"\n", b"0", b"-", b",", b"1 ", b".0", b"e0", b"\xff", b"\xef\xbb\xbf")
    )
    i = random.choice((0, len(content), random.randrange(len(content))))
    content[i:i] = new


_BYTES: dict[str, Callable[[Random, bytearray], None]] = {
    "flipped": _flip,
    "cut": _cut,
    "inserted": _insert,
}


def _changing_certificate(change: Callable[[Random, bytearray], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        made = Draft.of(corpus, random.choice(PATTERN_NAMES), random.choice(QUESTIONS)).finished()
        content = bytearray(made.certificate)
        change(random, content)
        return Forgery(made.pattern, bytes(content), made.proofs)

    return forge


def _changing_proof(change: Callable[[Random, bytearray], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers["no"])
        draft = Draft.of(corpus, name, question)
        content = bytearray(draft.proofs[question].encode())
        change(random, content)
        draft.record[question]["sha256"] = sha256(content).hexdigest()
        certificate = json.dumps(draft.record).encode()
        return Forgery(name, certificate, {draft.record[question]["proof"]: bytes(content)})

    return forge


def _hash_changed(random: Random, corpus: Corpus) -> Forgery:
    """The stated SHA-256 is another one."""
    name, question = random.choice(corpus.answers["no"])
    made = Draft.of(corpus, name, question).finished()
    record = json.loads(made.certificate)
    digits = list(record[question]["sha256"])
    digits[random.randrange(64)] = random.choice("0123456789abcdefABCDEF")
    record[question]["sha256"] = "".join(digits)
    return Forgery(name, json.dumps(record).encode(), made.proofs)


def _places(value: Any) -> list[tuple[Any, Any]]:
    """Return everything in a JSON value, as (object or list, key or index)."""
    inner = value.items() if isinstance(value, dict) else enumerate(value)
    found = [(value, key) for key, _ in inner]
    for container, key in list(found):
        if isinstance(container[key], dict | list):
            found += _places(container[key])
    return found


def _key_dropped(random: Random, record: Record) -> None:
    """A key or an item is missing."""
    container, key = random.choice(_places(record))
    del container[key]


def _key_renamed(random: Random, record: Record) -> None:
    """A key has another name."""
    objects = [container for container, _ in _places(record) if isinstance(container, dict)]
    chosen = random.choice(objects)
    key = random.choice(list(chosen))
    chosen[random.choice((key.upper(), key + " ", key[:-1], "answer", "valid"))] = chosen.pop(key)


def _key_added(random: Random, record: Record) -> None:
    """There is one more key or item."""
    container, key = random.choice(_places(record))
    if isinstance(container, dict):
        container[random.choice(("comment", "points", "1234", ""))] = container[key]
    else:
        container.append(container[key])


def _type_changed(random: Random, record: Record) -> None:
    """A value has another type, or another size."""
    container, key = random.choice(_places(record))
    value = container[key]
    others: list[Any] = [
        None,
        True,
        False,
        0,
        -1,
        0.0,
        1.5,
        10**41,
        "",
        "1/0",
        "01/2",
        "2/2",
        "open",
    ]
    others += [str(value), [value], {"answer": value}, [], {}]
    if isinstance(value, int):
        others += [float(value), value == 1, f"{value}/1", f"{2 * value}/2", f"{value}/01"]
    container[key] = random.choice(others)


_STRUCTURE: dict[str, Callable[[Random, Record], None]] = {
    "key dropped": _key_dropped,
    "key renamed": _key_renamed,
    "key added": _key_added,
    "type changed": _type_changed,
}


def _changing_structure(change: Callable[[Random, Record], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name = random.choice(PATTERN_NAMES)
        made = Draft.of(corpus, name, random.choice(QUESTIONS)).finished()
        record = json.loads(made.certificate)
        change(random, record)
        return Forgery(name, json.dumps(record).encode(), made.proofs)

    return forge


def _key_doubled(random: Random, corpus: Corpus) -> Forgery:
    """A key occurs twice in an object, with the same or another value."""
    name, question = random.choice(corpus.answers["yes"] + corpus.answers["no"])
    made = Draft.of(corpus, name, question).finished()
    text = made.certificate.decode()
    record = json.loads(text)
    key = random.choice([key for container, key in _places(record) if isinstance(container, dict)])
    value = random.choice((json.dumps(record.get(key, "yes")), "null", '"open"', "[]"))
    text = text.replace(f'"{key}":', f'"{key}": {value}, "{key}":', 1)
    return Forgery(name, text.encode(), made.proofs)


KINDS: dict[str, Mutator] = {
    **{f"certificate: bytes {n}": _changing_certificate(change) for n, change in _BYTES.items()},
    **{f"proof: bytes {name}": _changing_proof(change) for name, change in _BYTES.items()},
    "proof: hash changed": _hash_changed,
    **{f"structure: {name}": _changing_structure(c) for name, c in _STRUCTURE.items()},
    "structure: key doubled": _key_doubled,
}
"""Kind -> how one forgery of it is made."""
