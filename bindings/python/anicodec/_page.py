# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips in the viewer's page."""
from __future__ import annotations

import html
import os
import subprocess
import sys
import tempfile
import webbrowser
from typing import Any, Optional, Union

from .errors import UnsupportedError


def page(data: bytes, name: str, against: Optional[bytes] = None) -> str:
    """The HTML that the command writes for `anicodec render CLIP -o clip.html`. Raises UnsupportedError."""
    with tempfile.TemporaryDirectory() as folder:
        def put(stem: str, content: bytes) -> str:
            path = os.path.join(folder, stem + ".anic")
            with open(path, "wb") as file:
                file.write(content)
            return path

        out = os.path.join(folder, "page.html")
        arguments = ["render", put("".join(c if c.isalnum() else "_" for c in name) or "clip", data), "-o", out]
        if against is not None:
            arguments += ["--against", put("against", against)]
        result = subprocess.run([sys.executable, "-m", "anicodec", *arguments, "-q"], stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)
        if result.returncode != 0:
            raise UnsupportedError(result.stderr.strip())
        with open(out, encoding="utf-8") as file:
            return file.read()


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    return shell is not None and hasattr(shell.get_ipython(), "kernel")


def show(text: str, height: Union[int, str]) -> Any:
    """Shows a page in the notebook that runs this, else in the browser; returns what a notebook displays or the
    path of the page."""
    if _in_notebook():
        from IPython.display import HTML
        size = f"{height}px" if isinstance(height, int) else height
        return HTML(f'<iframe srcdoc="{html.escape(text)}" style="width: 100%; height: {html.escape(size)}; border: 0" '
                    'allow="fullscreen"></iframe>')
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", prefix="anicodec-", suffix=".html", delete=False) as file:
        file.write(text)
    webbrowser.open("file://" + file.name)
    return file.name
