"""What a notebook shows: pictures as data, the 3-D view in a frame; nothing from files becomes markup."""
from __future__ import annotations

import base64
import os
import tempfile
from html import escape
from typing import Callable

from ._core import output_path
from ._tables import Path


def file_html(write: Callable[[str], None], end: str, title: str) -> str:
    """A picture that `write` puts into a file whose name has this end ("png", "svg"), as an <img> of data."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture." + end)
        write(path)
        with open(path, "rb") as file:
            return picture_html(file.read(), end, title)


def picture_html(content: bytes, end: str, title: str) -> str:
    kind = "svg+xml" if end == "svg" else end
    return f'<img alt="{escape(title)}" style="max-width: 480px" src="data:image/{kind};base64,{base64.b64encode(content).decode()}">'


class View:
    """The interactive 3-D view of grains: a whole page that needs no network. A notebook shows it in a frame of its own."""

    def __init__(self, page: bytes, title: str) -> None:
        self.page = page
        self.title = title

    def write(self, path: Path) -> None:
        """Writes the page."""
        with open(output_path("path", path), "wb") as file:
            file.write(self.page)

    def __repr__(self) -> str:
        return f"<clast.View of {len(self.page) // 1000} kB>"

    def _repr_html_(self) -> str:
        page = escape(self.page.decode("utf-8", "replace")).encode("ascii", "xmlcharrefreplace").decode()  # in a page of any encoding
        return (f'<iframe title="{escape(self.title)}" width="100%" height="500" style="border: 0" sandbox="allow-scripts" '
                f'srcdoc="{page}"></iframe>')
