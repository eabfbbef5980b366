# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The plug-in that makes .anic files layers of OpenUSD: where it is, and how a program finds it."""
from __future__ import annotations

import json
import os
import pathlib
import sys
import warnings
from typing import List, Tuple

_USAGE = """usage: anicodec usd-plugin install | remove | path

Makes .anic files layers of OpenUSD, in every program that uses the usd-core of this Python.
  install  writes a file beside usd-core that names the plug-in, so that nothing has to be imported first
  remove   removes that file
  path     prints the folder of the plug-in, for PXR_PLUGINPATH_NAME

Without it, `import anicodec.usd` before the first stage is opened does the same for one process."""


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
    """`anicodec usd-plugin ...`: the exit status."""
    if arguments in (["-h"], ["--help"]):
        print(_USAGE)
        return 0
    if arguments not in (["install"], ["remove"], ["path"]):
        print(_USAGE, file=sys.stderr)
        return 1
    try:
        if arguments == ["path"]:
            if not releases():
                raise RuntimeError("this build of anicodec has no plug-in for USD")
            print(folder())
        elif arguments == ["install"]:
            print(install())
        else:
            remove()
    except ImportError:
        print("anicodec: USD needs the extra of the package: pip install 'anicodec[usd]'", file=sys.stderr)
        return 4
    except (OSError, RuntimeError) as error:
        print(f"anicodec: {error}", file=sys.stderr)
        return 2
    return 0
