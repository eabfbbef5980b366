#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Collects what the site is made of: all pages of the project, with the files that they link to, and the headers.

usage: collect.py OUT      pages go to OUT/source, what Doxygen reads to OUT/doxygen
"""
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap

SITE = pathlib.Path(__file__).resolve().parent
ROOT = SITE.parent.parent
HEADERS = {"sdk/include/anicodec/play.h": "Open, seek, write: play.h", "sdk/include/anicodec/surface.h": "Surfaces: surface.h",
           "sdk/include/anicodec/gpu.h": "Graphics cards: gpu.h", "sdk/include/anicodec/stream.h": "Streams: stream.h",
           "codec/include/anicodec/encode.h": "The encoder: encode.h"}
LINK = re.compile(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)")
DIVIDER = re.compile(r"^/\* -{4} (.+?) -+ \*/$", re.M)
STRUCT = re.compile(r"^typedef struct (\w+) \{(.*?)^\} \1;", re.M | re.S)
ROW = re.compile(r"^\|.*\|$", re.M)
DOXYFILE = """PROJECT_NAME = anicodec
INPUT = doxygen
OUTPUT_DIRECTORY = doxygen
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
OPTIMIZE_OUTPUT_FOR_C = YES
SORT_MEMBER_DOCS = NO
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = __cplusplus ANIC_API= ANIC_INT32=
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_NO_PARAMDOC = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""


def unbroken(row):
    """A row of a table whose numbers stay on one line: 31 266."""
    return re.sub(r"(?<=\d) (?=\d{3}\b)", "\u202f", row[0])


def copy_pages(source):
    """Every page at its place, so that links between pages hold; beside them what else they link to."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split()
    pages = {ROOT / name for name in listed if not (ROOT / name).is_relative_to(SITE)}
    files = set(pages)
    for page in pages:
        links = {(page.parent / link).resolve() for link in LINK.findall(page.read_text(encoding="utf-8"))}
        files |= {file for file in links if file.is_file() and file.is_relative_to(ROOT)}
    for file in files:
        place = source / file.relative_to(ROOT)
        place.parent.mkdir(parents=True, exist_ok=True)
        if file.suffix == ".md":
            place.write_text(ROW.sub(unbroken, file.read_text(encoding="utf-8")), encoding="utf-8")
        else:
            shutil.copyfile(file, place)
    for page in SITE.rglob("*.md"):
        if "node_modules" not in page.parts:
            place = source / page.relative_to(SITE)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(page, place)


def drop_empty_patterns(source):
    """Patterns in the contents take pages that come later; Sphinx warns of a pattern that finds nothing new."""
    index, listed, lines = source / "index.md", set(), []
    for line in index.read_text(encoding="utf-8").splitlines():
        if line.startswith("```"):
            listed = set()
        if "*" in line and " " not in line:
            found = {str(page.relative_to(source))[:-3] for page in source.glob(line + ".md")} - listed
            listed |= found
            if not found:
                continue
        listed.add(line.rpartition("<")[2].rstrip(">"))
        lines.append(line)
    index.write_text("\n".join(lines) + "\n", encoding="utf-8")


def grouped(text, stem):
    """A header whose dividers are groups of Doxygen, and the names and titles of these."""
    groups = []
    begin = 'extern "C" {\n#endif\n'
    before, _, after = text.partition(begin)
    if after.index("ANIC_API") < DIVIDER.search(after).start():
        text = f"{before}{begin}\n/* ---- the library ---- */{after}"

    def group(match):
        name = f"{stem}_{len(groups)}"
        groups.append((name, match[1]))
        return ("/** @} */\n" if len(groups) > 1 else "") + f"/** @defgroup {name} {match[1]}\n * @{{ */"

    text = STRUCT.sub(r"struct \1 {\2};", DIVIDER.sub(group, text))  # a name is declared once
    end = text.rindex("#ifdef __cplusplus\n}")
    return text[:end] + "/** @} */\n" + text[end:], groups


def opening_comment(text):
    """The comment at the top of a header, as Markdown: headings, lists, and indented blocks as code."""
    comment = text[text.index("*"):text.index("*/")]
    lines = [line.removeprefix(" *").removeprefix(" ") for line in comment.splitlines()[3:]]
    blocks = []
    for block in "\n".join(lines).strip("\n").split("\n\n"):
        heading, _, rest = block.partition("\n")
        if block.startswith("  "):
            block = f"```c\n{textwrap.dedent(block)}\n```"
        elif rest.startswith("- "):
            block = f"**{heading}**\n\n{rest}"
        blocks.append(block)
    return "\n\n".join(blocks) + "\n"


def write_reference(out, source):
    """A page for each header, with its groups in their order."""
    (out / "doxygen").mkdir(parents=True, exist_ok=True)
    (out / "doxygen" / "Doxyfile").write_text(DOXYFILE, encoding="utf-8")
    for path, title in HEADERS.items():
        text = (ROOT / path).read_text(encoding="utf-8")
        header, groups = grouped(text, pathlib.Path(path).stem)
        (out / "doxygen" / pathlib.Path(path).name).write_text(header, encoding="utf-8")
        page = [f"# {title}\n", opening_comment(text)]
        for name, heading in groups:
            page += [f"## {heading[0].upper() + heading[1:]}\n", f"```{{doxygengroup}} {name}\n:content-only:\n```\n"]
        (source / "reference" / f"{pathlib.Path(path).stem}.md").write_text("\n".join(page), encoding="utf-8")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[1]).resolve()
    source = out / "source"
    for folder in (source, out / "doxygen"):
        shutil.rmtree(folder, ignore_errors=True)
    copy_pages(source)
    drop_empty_patterns(source)
    (source / "reference").mkdir(exist_ok=True)
    write_reference(out, source)


if __name__ == "__main__":
    main()
