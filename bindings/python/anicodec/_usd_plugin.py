# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The plug-in that makes .anic files layers of OpenUSD: where it is, and how a program finds it."""
from __future__ import annotations

import json
import os
import pathlib
import sys
import warnings
from typing import Any, Dict, List, Tuple

_ACTIONS = (["install"], ["remove"], ["path"])  # of `anicodec usd-plugin`, which the command explains


def folder() -> pathlib.Path:
    """The folder of the plug-in, where it is built."""
    return pathlib.Path(__file__).resolve().parent / "usd_plugin"


def releases() -> List[Tuple[int, ...]]:
    """Releases of OpenUSD that the plug-in is built for, as (0, 26, 8)."""
    names = (path.stem.split("_") for path in folder().glob("anicodec_usd_*.so"))
    return sorted((0, *map(int, parts[2:])) for parts in names)


def fault(version: Tuple[int, ...]) -> str:
    """Why a release of OpenUSD cannot use the plug-in; empty if it can."""
    known = releases()
    if not known:
        return "this build of anicodec has no plug-in for USD: .anic files are no layers"
    if tuple(version) not in known:
        told = ", ".join(".".join(map(str, release[1:])) for release in known)
        return f"the plug-in for USD is built for usd-core {told}, not {'.'.join(map(str, version[1:]))}: .anic files are no layers"
    return ""


def is_meant(arguments: List[str]) -> bool:
    """Whether the command line has an action of the plug-in; the command answers all others."""
    return arguments[:1] == ["usd-plugin"] and [text for text in arguments[1:] if text != "--json"] in _ACTIONS


def register() -> None:
    """Makes .anic files layers in this process; warns, in one line, where that is not possible."""
    from pxr import Plug, Sdf, Usd

    reason = fault(Usd.GetVersion())
    if not reason and not Plug.Registry().GetPluginWithName("anicodec"):
        Plug.Registry().RegisterPlugins(str(folder()))
        # The formats are counted once: asking for one before would be the same as opening a stage.
        if "anic" not in Sdf.FileFormat.FindAllFileFormatExtensions():
            reason = ("a stage was opened before anicodec.usd was imported: .anic files are no layers in this process "
                      "(`anicodec usd-plugin install` makes the order no matter)")
    if reason:
        warnings.warn(reason, stacklevel=4)


def _entry() -> pathlib.Path:
    import pxr

    return pathlib.Path(pxr.__path__[0]) / "pluginfo" / "anicodec" / "resources" / "plugInfo.json"


def install() -> pathlib.Path:
    """Writes the file that usd-core finds the plug-in by, and returns its path."""
    from pxr import Usd

    reason = fault(Usd.GetVersion())
    if reason:
        raise RuntimeError(reason)
    information = json.loads((folder() / "plugInfo.json").read_text(encoding="utf-8"))
    for plugin in information["Plugins"]:
        plugin["Root"] = str(folder())
    entry = _entry()
    entry.parent.mkdir(parents=True, exist_ok=True)
    entry.write_text(json.dumps(information, indent=4) + "\n", encoding="utf-8")
    return entry


def remove() -> None:
    """Removes what install() wrote."""
    entry = _entry()
    if entry.exists():
        entry.unlink()
        for empty in (entry.parent, entry.parent.parent):
            if not any(empty.iterdir()):
                empty.rmdir()


def main(arguments: List[str]) -> int:
    """`anicodec usd-plugin ...`, one of the actions: the exit status."""
    action, as_json = [text for text in arguments if text != "--json"][0], "--json" in arguments
    told: Dict[str, Any] = {}
    status, fault = 0, ""
    try:
        if action == "path" and not releases():
            raise RuntimeError("this build of anicodec has no plug-in for USD")
        if action == "remove":
            remove()
        else:
            told["path"] = str(folder() if action == "path" else install())
    except ImportError:
        status, fault = 4, "USD needs the extra of the package: pip install 'anicodec[usd]'"
    except (OSError, RuntimeError) as error:
        status, fault = 2, str(error)
    if fault:
        print(f"anicodec: {fault}", file=sys.stderr)
        told = {"error": fault, "status": status}
    if as_json:
        print(json.dumps(told))
    elif "path" in told:
        print(told["path"])
    return status
