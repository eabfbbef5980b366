#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes the gallery: clips of the corpus, encoded, each with a poster and a page that plays it.

usage: gallery.py COMMAND OUT      posters and players go to OUT/clips, the page to OUT/source/gallery.md
"""
import json
import pathlib
import subprocess
import sys

#: Name, options of `corpus`, what one sees.
CLIPS = [("limb", ["--vertices", "6000", "--frame-count", "120"], "A limb that bends and twists, skinned by three bones."),
         ("cloth", ["--vertices", "6000", "--frame-count", "96"], "Cloth in the wind; the pinned edge is exactly still."),
         ("face", ["--vertices", "4000", "--frame-count", "120"], "A mask of ten local blend shapes."),
         ("helix", ["--vertices", "4000", "--frame-count", "96"], "A straight rod winds up; geometry interpolation keeps its length."),
         ("rigid", [], "Seven boxes that tumble and bounce: a motion each, not vertices."),
         ("waves", ["--vertices", "4000", "--frame-count", "96"], "A sheet that spans exactly thirty shapes."),
         ("sliding", ["--vertices", "3000", "--frame-count", "72"], "A limb whose vertices slide over it, as if captured."),
         ("noisy", ["--vertices", "3000", "--frame-count", "72"], "Cloth with noise in every vertex: the hard case."),
         ("moebius", [], "A strip that cannot be oriented."),
         ("painted_box", [], "Materials, colours, texture coordinates and hard edges."),
         ("heated", [], "Colours and texture coordinates that move.")]
ENTRY = """<figure class="clip">
<a href="{name}.html" data-title="{name}, playing"><img src="{name}.png" width="640" height="480" loading="lazy" alt="{text}"></a>
<figcaption><b>{name}</b> {text}<br>{vertices} vertices, {frames} frames: {size} of {raw} as float32, {ratio} times smaller</figcaption>
</figure>
"""


def in_bytes(count):
    return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{count / 1e3:.1f} kB"


def is_newer(files, sources):
    """Whether files are there and were made after their sources."""
    return all(file.exists() for file in files) and min(f.stat().st_mtime for f in files) > max(s.stat().st_mtime for s in sources)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    command, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    clips, work = out / "clips", out / "corpus"
    for folder in (clips, work):
        folder.mkdir(parents=True, exist_ok=True)

    def run(*arguments):
        return subprocess.run([command, *map(str, arguments)], cwd=work, check=True, stdout=subprocess.PIPE, text=True).stdout

    entries, commands = [], []
    for name, options, text in CLIPS:
        made = [["corpus", name, *options, "-o", f"{name}.pc2"], ["encode", f"{name}.obj", f"{name}.pc2", "-o", f"{name}.anic", "--fps", "24"],
                ["render", f"{name}.anic", "-o", f"{name}.html"]]
        commands += ["anicodec " + " ".join(step) for step in made]
        files = [clips / f"{name}.html", clips / f"{name}.png"]
        if not is_newer(files, [command, pathlib.Path(__file__)]):
            for step in made:
                run(*step, "-f", "-q")
            (work / f"{name}.html").replace(files[0])
        info = json.loads(run("info", f"{name}.anic", "--json").splitlines()[0])
        frames, vertices = info["frames"], sum(mesh["vertices"] for mesh in info["meshes"])
        if not is_newer(files, [command, pathlib.Path(__file__)]):
            run("render", f"{name}.anic", "-f", "-q", "-o", files[1], "--frames", frames // 3, "--resolution", "640x480", "--camera", "30,15")
        size, raw = (work / f"{name}.anic").stat().st_size, 12 * frames * vertices
        entries.append(ENTRY.format(name=name, text=text, vertices=vertices, frames=frames, size=in_bytes(size), raw=in_bytes(raw),
                                    ratio=f"{raw / size:.0f}"))
    page = ["# Gallery\n", "Clips of the project's own corpus, as `anicodec encode` makes them: no vertex is further off than 0.05 % of the size. A",
            "picture turns into the player when it is clicked: one page with the decoder, in WebAssembly, and the clip inside.\n",
            '<div class="gallery">', "".join(entries) + "</div>\n", "## Commands\n", "```sh", *commands, "```"]
    (out / "source" / "gallery.md").write_text("\n".join(page) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
