"""The exceptions of this package."""
from __future__ import annotations


class CairnError(RuntimeError):
    """What went wrong, as a sentence: the base of this package's exceptions."""


class MapError(CairnError):
    """A saved map cannot be read or written; the text names the file, and the table where it is damaged."""


class ModuleError(CairnError):
    """A module (planner, detector, ...) failed; the text names it."""


class FileError(CairnError):
    """A mistake in a file that a person wrote.

    file: str, "" where the mistake is in none; line, column: int from 1, 0 where there is none.
    """

    def __init__(self, text: str, file: str = "", line: int = 0, column: int = 0) -> None:
        super().__init__(text)
        self.file = file
        self.line = line
        self.column = column
