"""Text from outside, fit to print: one line, which controls no terminal."""


def printable(text: str) -> str:
    """Return the text with escapes for what could control a terminal or break a line."""
    return "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)
