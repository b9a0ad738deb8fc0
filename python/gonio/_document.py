"""Documents of gonio."""

import json as _json
import os as _os
from typing import Any, Union

Path = Union[str, "_os.PathLike[str]"]


class Document(dict[str, Any]):
    """A document of gonio: a ``dict`` of what the JSON holds, and ``text``, the JSON as the program prints it.

    ``write`` leaves it as a file that the program reads.
    """

    text: str

    def __init__(self, text: str) -> None:
        super().__init__(_json.loads(text))
        self.text = text

    def write(self, path: Path) -> None:
        """Writes ``text`` to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.text)
