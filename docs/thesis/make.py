#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes README.md of this folder and its pictures: the figures and tables of the thesis that clips of the corpus can show.

usage: make.py ANICODEC [FOLDER]
ANICODEC is the command, as build/release/tools/anicodec. FOLDER (default: this one) gets README.md and the pictures. Takes
about a minute.
"""
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SIZE = "220x220"


class Page:
    """Text with the results of commands in it."""

    def __init__(self, command, folder, work):
        self.command, self.folder, self.work = command, folder, work
        self.lines = []

    def run(self, *arguments):
        """The output of a command."""
        result = subprocess.run([self.command, *map(str, arguments)], cwd=self.work, text=True, capture_output=True,
                                check=False)
        if result.returncode != 0:
            sys.exit(f"anicodec {' '.join(map(str, arguments))}: {result.stderr.strip()}")
        return result.stdout

    def say(self, text):
        """Adds a paragraph."""
        self.lines += [text.strip(), ""]

    def shown(self, command):
        """Adds a command as the reader can type it."""
        self.lines += ["```", "anicodec " + command, "```", ""]

    def table(self, head, rows):
        """Adds a table; numbers with four digits."""
        def cell(value):
            return f"{value:.4g}" if isinstance(value, float) else str(value)
        self.lines += ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
        self.lines += ["| " + " | ".join(map(cell, row)) + " |" for row in rows] + [""]

    def pictures(self, head, *columns):
        """Adds pictures side by side, each a name, a text and the arguments that draw it."""
        for name, _, arguments in columns:
            self.run("render", *arguments, "-q", "-f", "-o", self.folder / f"{name}.png", "--resolution", SIZE)
        self.table([text for _, text, _ in columns],
                   [[f"![{head}: {text}]({name}.png)" for name, text, _ in columns]])


def read_obj(path):
    """Lines of vertices as numbers, and the other lines."""
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    return [list(map(float, line.split()[1:4])) for line in lines if line.startswith("v ")], \
        [line for line in lines if not line.startswith("v ")]


def write_obj(path, vertices, rest):
    pathlib.Path(path).write_text("\n".join([f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in vertices] + rest) + "\n",
                                  encoding="utf-8")


def clips(page):
    """The corpus, and single poses of it."""
    for name in ("limb", "helix", "sliding", "cloth", "face"):
        page.run("corpus", name, "-q", "-f", "-o", f"{name}.pc2")
    for name, clip, frame in (("straight", "limb", 0), ("bent", "limb", 18), ("rod", "helix", 0), ("wound", "helix", 30)):
        page.run("interpolate", f"{clip}.pc2@{frame}", f"{clip}.pc2@{frame + 1}", "--method", "linear", "--frame-count", 2, "-q",
                 "-f", "-o", f"{name}_%d.obj")
        (page.work / f"{name}_0.obj").rename(page.work / f"{name}.obj")


def between(page, a, b, method, name, *options):
    """A clip between two meshes, its mesh beside it."""
    page.run("interpolate", a, b, "--method", method, "-q", "-f", "-o", f"{name}.pc2", *options)
    (page.work / f"{name}.obj").write_bytes((page.work / pathlib.Path(a).with_suffix(".obj")).read_bytes())
    return f"{name}.pc2"


def errors(page, a, b, frames, *options):
    """Rows of interpolate --compare."""
    told = json.loads(page.run("interpolate", a, b, "--frame-count", frames, "--compare", "--json", *options))
    return [[m["method"], m["length_percent"], m["largest_length_percent"], m["angle_degrees"], m["volume_percent"],
             m["folded"] + m["collapsed"]] for m in told["methods"]]


ERRORS = ["method", "length %", "largest %", "angle in degrees", "volume %", "folded or collapsed"]


def chapter_3(page):
    page.say("## Chapter 3: Mesh Massage")
    page.say("""### Texture transfer: figures 3.6 and 3.7

The thesis gives every frame of a sequence the triangle shapes of its first frame, on its own surface: a texture then keeps its
look. *sliding* is a limb whose vertices slide over it in every frame, as those of a capture do. Distortion is 1 where a
triangle has the shape, or the area, that it has in the first frame.""")
    page.shown("massage sliding.pc2 -o massaged.pc2")
    told = json.loads(page.run("massage", "sliding.pc2", "-q", "-f", "-o", "massaged.pc2", "--json"))
    page.table(["", "conformal distortion, mean", "area distortion, mean"],
               [["as it is", told["before"]["conformal_mean"] + 0.0, told["before"]["area_mean"]],
                ["massaged", told["after"]["conformal_mean"], told["after"]["area_mean"]]])
    page.say(f"The surface moved by {told['hausdorff_mean_percent']:.3f} % of the diagonal on average and by "
             f"{told['hausdorff_percent']:.2f} % at most (Hausdorff distance).")

    page.say("""### Remeshing: figure 3.9 and table 3.1

A decimated mesh has its vertices on the surface and its faces inside. Optimising vertices for distance and shape at once about
halves the largest distance, the thesis says. Distances in per cent of the diagonal.""")
    page.shown("massage remesh limb.obj --vertices 25% -o coarse.obj")
    rows = []
    for share in ("50%", "25%", "12%", "6%"):
        told = json.loads(page.run("massage", "remesh", "limb.obj", "--vertices", share, "-q", "-f", "-o", "coarse.obj",
                                   "--json"))
        before, after = told["before"], told["after"]
        rows.append([f"{told['vertices']} ({share})", before["hausdorff_percent"], after["hausdorff_percent"],
                     after["hausdorff_percent"] / before["hausdorff_percent"], before["hausdorff_mean_percent"],
                     after["hausdorff_mean_percent"], after["radius_ratio"]])
    page.table(["vertices", "largest, decimated", "largest, fitted", "ratio", "mean, decimated", "mean, fitted",
                "radius ratio"], rows)

    page.say("""### Cross-parametrisation: figures 3.11 to 3.13

One mesh takes the shape of another of other faces, by landmarks; the map is then improved by copying the shapes of its
triangles. Here the straight limb takes the shape of a bent one that was remeshed with even triangles, by 24 landmarks.
The thesis has maps over a coarse base domain, which gain; landmarks as close as here leave nothing to gain.""")
    page.run("massage", "remesh", "bent.obj", "--method", "isotropic", "--vertices", "60%", "-q", "-f", "-o", "even.obj")
    page.shown("massage map straight.obj even.obj --landmarks pairs.txt -o mapped.obj")
    bent, even = read_obj(page.work / "bent.obj")[0], read_obj(page.work / "even.obj")[0]
    pairs = [(v, min(range(len(even)), key=lambda w, at=bent[v]: math.dist(at, even[w])))
             for v in range(0, len(bent), len(bent) // 24)]
    (page.work / "pairs.txt").write_text("".join(f"{v} {w}\n" for v, w in pairs), encoding="utf-8")
    told = json.loads(page.run("massage", "map", "straight.obj", "even.obj", "--landmarks", "pairs.txt", "-q", "-f", "-o",
                               "mapped.obj", "--json"))
    page.table(["", "conformal, mean", "largest", "area, mean", "largest"],
               [[when, *(told[when][key] for key in ("conformal_mean", "conformal_max", "area_mean", "area_max"))]
                for when in ("before", "after")])
    page.pictures("map", *((f"map_{name}", text, [f"{name}.obj"]) for name, text in
                           (("straight", "A"), ("even", "B"), ("mapped", "A in the shape of B"))))

    page.say("""### Connectivity transfer: figure 3.15 and table 4.2

Meshes of different faces get those of the first, as the chapter on interpolation needs it. Hausdorff distance of the result
in per cent of the diagonal.""")
    page.run("massage", "remesh", "limb.obj", "--method", "isotropic", "--vertices", "60%", "-q", "-f", "-o", "even.obj")
    page.shown("massage transfer limb.obj even.obj -o carried.pc2")
    told = json.loads(page.run("massage", "transfer", "limb.obj", "even.obj", "-q", "-f", "-o", "carried.pc2", "--json"))
    page.table(["largest", "mean"], [[told["hausdorff_percent"], told["hausdorff_mean_percent"]]])


def chapter_4(page):
    page.say("## Chapter 4: interpolation")
    page.say("""### Straight lines and deformation gradients: figures 2.8 and 4.1

Half way between a straight and a bent limb: vertices on straight lines shorten it; deformation gradients keep it.""")
    page.shown("interpolate straight.obj bent.obj --method linear --frame-count 3 -o between.pc2")
    page.pictures("limb", ("limb_a", "A", ["straight.obj", "--frames", "0:1"]),
                  *((f"limb_{m}", m, [between(page, "straight.obj", "bent.obj", m, f"limb_{m}", "--frame-count", 3),
                                      "--frames", "1:2"]) for m in ("linear", "gradients", "msgi")),
                  ("limb_b", "B", ["bent.obj", "--frames", "0:1"]))
    page.table(ERRORS, errors(page, "straight.obj", "bent.obj", 9))

    page.say("""### Several full turns: figures 4.2, 4.13, 4.16 and 4.23 to 4.25

A rod that winds up. Rotations of more than half a turn are ambiguous for deformation gradients; tracking them over the mesh
(breadth first, by priority, with normals) helps as long as the track is right, and fails here, which the thesis shows on its helix
too. Multi-scale interpolation of lengths and angles never sees a rotation. Errors are against the lengths, angles and volume
that lie half way, means over nine frames.""")
    page.pictures("helix", ("helix_a", "A", ["rod.obj"]),
                  *((f"helix_{m}", m, [between(page, "rod.obj", "wound.obj", m, f"helix_{m}", "--frame-count", 3),
                                       "--frames", "1:2"]) for m in ("gradients", "pml", "pmln", "msgi")),
                  ("helix_b", "B", ["wound.obj"]))
    page.table(ERRORS, errors(page, "rod.obj", "wound.obj", 9))

    page.say("""### Blending of vertices and of edges: figures 4.18 and 4.19

In the tables above *msgi-v* blends the vertices of aligned patches and *msgi* their edges: the latter has the smaller largest
error of lengths, for which the thesis prefers it. Patches of a real body fit less well than those of a limb: between poses of a
galloping horse *msgi-v* tears at the shoulder, where long bands of patches meet, by several edges, whatever the size of patches;
*msgi* does not.""")

    page.say("""### Extrapolation: figures 4.26 and 4.27

Half as far again in either direction, linear and multi-scale.""")
    page.shown("interpolate straight.obj bent.obj --range -0.5:1.5 --frame-count 3 -o beyond.pc2")
    page.pictures("extrapolated", *(
        (f"beyond_{m}_{i}", f"{m}, {t}", [between(page, "straight.obj", "bent.obj", m, f"beyond_{m}", "--frame-count", 3,
                                                 "--range", "-0.5:1.5"), "--frames", f"{i}:{i + 1}"])
        for m in ("linear", "msgi") for i, t in ((0, "-0.5"), (2, "1.5"))))

    page.say("""### Constrained interpolation: figure 4.28

Half way once more, with the far end held where A has it: the rest follows by lengths and angles.""")
    page.shown("interpolate straight.obj bent.obj --pin 12,13,14=held.txt --frame-count 3 -o held.pc2")
    straight, bent = read_obj(page.work / "straight.obj")[0], read_obj(page.work / "bent.obj")[0]
    far = sorted(range(len(straight)), key=lambda v: -math.dist(straight[v], bent[v]))[:12]
    (page.work / "held.txt").write_text("".join(f"{x:.7g} {y:.7g} {z:.7g}\n" for x, y, z in (straight[v] for v in sorted(far))),
                                        encoding="utf-8")
    pins = ",".join(map(str, sorted(far))) + "=held.txt"
    page.pictures("held", *(
        (f"held_{name}", text, [between(page, "straight.obj", "bent.obj", "msgi", f"held_{name}", "--frame-count", 3, *options),
                                "--frames", "1:2"])
        for name, text, options in (("free", "free", ()), ("pinned", "far end held", ("--pin", pins)))))

    page.say("""### Several inputs: figure 4.21

Frames 0, 12, 24 and 36 of the face, each with a weight of a quarter.""")
    (page.work / "quarters.txt").write_text("0.25 0.25 0.25 0.25\n", encoding="utf-8")
    page.run("interpolate", "face.pc2@0", "face.pc2@12", "face.pc2@24", "face.pc2@36", "--weights", "quarters.txt", "-q", "-f",
             "-o", "mixed.pc2")
    (page.work / "mixed.obj").write_bytes((page.work / "face.obj").read_bytes())
    page.pictures("face", *((f"face_{f}", f"frame {f}", ["face.pc2", "--frames", f"{f}:{f + 1}"]) for f in (0, 12, 24, 36)),
                  ("face_mixed", "mixed", ["mixed.pc2", "--frames", "0:1"]))

    page.say("""### Noise and skinny triangles: figures 4.29 and 4.30

The rod once more: with noise of 0.2 % of its length on every vertex of both inputs, and stretched ten times across, so that
triangles are needles. The method stays what it was; its errors are against inputs that are as bad.""")
    numbers = random.Random(1)
    rod, _ = read_obj(page.work / "rod.obj")
    length = max(math.dist(rod[0], v) for v in rod)
    rows = []
    for change in ("noise", "needles"):
        for name in ("rod", "wound"):
            vertices, rest = read_obj(page.work / f"{name}.obj")
            if change == "noise":
                vertices = [[x + numbers.gauss(0, 0.002 * length) for x in v] for v in vertices]
            else:
                vertices = [[x * 10 if axis == 2 else x for axis, x in enumerate(v)] for v in vertices]
            write_obj(page.work / f"{name}_{change}.obj", vertices, rest)
        rows += [[change, *row] for row in errors(page, f"rod_{change}.obj", f"wound_{change}.obj", 5)
                 if row[0] in ("linear", "pml", "msgi")]
    page.table(["inputs", *ERRORS], rows)

    page.say("""### Irregular tessellation: figures 4.31 and 4.32

The straight limb decimated to two fifths of its vertices, by edge collapses, and carried to the bent one: distances of both
meshes from the originals, in per cent of the diagonal, and the methods on what has become of the triangles.""")
    page.shown("massage transfer straight.obj bent.obj --vertices 40% -o irregular.pc2")
    told = json.loads(page.run("massage", "transfer", "straight.obj", "bent.obj", "--vertices", "40%", "-q", "-f", "-o",
                               "irregular.pc2", "--json"))
    page.table(["segments", "largest", "mean"],
               [[len(told["files"]), told["hausdorff_percent"], told["hausdorff_mean_percent"]]])
    page.table(ERRORS, errors(page, "irregular.pc2@0", "irregular.pc2@1", 9))
    page.say("`anicodec interpolate A B --frame-count N --study page.html` makes such tables with charts over the frames and pictures, of any meshes.")


def chapter_5(page):
    page.say("## Chapter 5: thinning")
    page.say("""### Key-frames against principal components: figures 5.6, 5.7 and 5.12, table 5.1

KG errors in per cent of a clip rebuilt from K exact key-frames by least squares, or from K principal components. The thesis picks
key-frames by Neural Gas (*gas*); *pivot* is the selection that anicodec uses. Components are the lower bound for any choice
of key-frames with free weights.""")
    page.shown("analyze limb.pc2 --counts 2,5,10,20 --csv")
    counts = (2, 5, 10, 20)
    for clip in ("limb", "cloth", "face"):
        found = {}
        for line in page.run("analyze", f"{clip}.pc2", "--counts", ",".join(map(str, counts)), "--csv").splitlines()[1:]:
            method, k, kg, _ = line.split(",")
            found[method, int(k)] = float(kg)
        methods = ["uniform-linear", "gas-linear", "gas-rigid", "pivot-linear", "pivot-rigid", "pca"]
        page.table([f"{clip}, K", *map(str, counts)],
                   [[m, *(found.get((m, k), "") for k in counts)] for m in methods if any((m, k) in found for k in counts)])

    page.say("""### Where the error is: figures 5.9 and 5.10

The limb from 5 key-frames: the original, the file, and the error of each vertex, from grey over yellow and red to black.""")
    page.shown("encode limb.pc2 --keyframes 5 --keyframe-selection gas -o few.anic")
    page.run("encode", "limb.pc2", "--keyframes", 5, "--keyframe-selection", "gas", "-q", "-f", "-o", "few.anic")
    page.pictures("five key-frames", *(
        (f"few_{v}", v, ["few.anic", "--against", "limb.pc2", "--view", v, "--frames", "30:31"])
        for v in ("original", "clip", "error")))

    page.say("""### Shape spaces: figures 5.11 and 5.13

Principal components of positions, of edge lengths and dihedral angles, and of deformation gradients. The other spaces need fewer
components where parts turn, and more numbers for each.""")
    page.shown("analyze limb.pc2 --spaces --counts 1,2,5 --csv")
    rows = [line.split(",") for line in page.run("analyze", "limb.pc2", "--spaces", "--counts", "1,2,5", "--csv").splitlines()[1:]]
    page.table(["space", "K", "KG error in per cent", "numbers of a component", "bytes as float32"],
               [[space, k, float(kg), numbers, size] for space, k, kg, numbers, size, _ in rows])

    page.say("""### Massaged sequences: figure 5.14 and table 5.5

Vertices that slide cost components. KG error of *sliding* in K principal components, as it is and massaged.""")
    page.shown("analyze sliding.pc2 --massage-study --csv")
    rows = [line.split(",") for line in page.run("analyze", "sliding.pc2", "--massage-study", "--csv").splitlines()[1:]]
    page.table(["K", "as it is", "massaged"], [[x, float(a), float(b)] for series, x, a, b in rows if series == "pca"])
    page.table(["KG error asked for", "bytes as it is", "bytes massaged"],
               [[x, a, b] for series, x, a, b in rows if series == "bytes"])


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) == 3 else HERE).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        page = Page(pathlib.Path(sys.argv[1]).resolve(), folder, pathlib.Path(work))
        page.say("""# The thesis, played through

Figures and tables of Tim Winkler's *Processing Mesh Animations* (Università della Svizzera italiana, 2011) in kind: made by
anicodec from clips of its own corpus, with what the thesis finds beside them. `python3 docs/thesis/make.py
build/release/tools/anicodec` makes this page anew; [code.md](code.md) says where each section is implemented.""")
        clips(page)
        chapter_3(page)
        chapter_4(page)
        chapter_5(page)
        page.say("""## Left out

Timings (tables 3.4 and 4.1; `anicodec_bench msgi` measures), sharp features (figures 3.16 and 3.17), semantic deformation transfer (4.22), the comparison with Key-Probe (table 5.3) and the figures whose models are not free.""")
    (folder / "README.md").write_text("\n".join(page.lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
