#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Holds the binary interface of a library against that of a release, by libabigail.

usage: check_abi.py LIBRARY HEADERS REFERENCE [--write]
       check_abi.py --try-rules C++-COMPILER

LIBRARY has debug information, HEADERS is the folder of its public headers, REFERENCE the description of the release, which
--write makes. New functions and constants are allowed, and new fields behind the end of a struct that begins with struct_size.
--try-rules shows by small libraries that all else is refused. Exit status 77: skipped, for the reason printed.
"""
import pathlib
import platform
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

SKIPPED = 77

# Types of the standard library and those behind handles are nobody's interface.
PUBLIC_TYPES_ONLY = """[suppress_type]
  name_not_regexp = ^anic_
  drop = yes
"""


def describe(library, headers, work):
    """The description of a library as XML."""
    rules = work / "public_types.ini"
    rules.write_text(PUBLIC_TYPES_ONLY, encoding="utf-8")
    result = subprocess.run(["abidw", "--suppressions", rules, "--exported-interfaces-only", "--headers-dir", headers,
                             "--drop-private-types", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs",
                             "--no-elf-needed", "--type-id-style", "hash", library], text=True, capture_output=True)
    if result.returncode != 0:
        sys.exit(f"abidw: {result.stderr}")
    tree = ElementTree.fromstring(result.stdout)
    for unit in tree.iter("abi-instr"):
        unit.set("path", "interface")  # of the machine that compiled it
    return tree


def structs(tree):
    """The structs of a description, by name."""
    return {node.get("name"): node for node in tree.iter("class-decl") if node.get("size-in-bits")}


def may_grow(struct):
    first = struct.find("data-member/var-decl")
    return first is not None and first.get("name") == "struct_size"


def cut_growth(now, before):
    """Takes fields behind the former end out of structs that may grow. libabigail's rule for that lets swapped fields pass."""
    older = structs(before)
    for name, struct in structs(now).items():
        end = int(older[name].get("size-in-bits")) if name in older else None
        if end is None or not may_grow(struct) or int(struct.get("size-in-bits")) < end:
            continue
        for member in struct.findall("data-member"):
            if int(member.get("layout-offset-in-bits")) >= end:
                struct.remove(member)
        struct.set("size-in-bits", str(end))


def difference(now, reference, work):
    """Changes that break programs built with the reference; empty if none does."""
    cut_growth(now, ElementTree.parse(reference).getroot())
    description = work / "now.abi"
    ElementTree.ElementTree(now).write(description)
    result = subprocess.run(["abidiff", "--no-added-syms", reference, description], text=True, capture_output=True)
    return result.stdout + result.stderr if result.returncode else ""


BASE = """#include <stddef.h>
#include <stdint.h>
extern "C" {
enum anic_kind : int32_t { ANIC_A = 0, ANIC_B = 1 };
struct anic_point { float x, y; };
struct anic_options { size_t struct_size; uint32_t count; anic_point point; uint8_t last; };
int anic_open(anic_kind kind, anic_options* options);
int anic_move(const anic_point* point);
}
"""
ALLOWED = {"a function": ("int anic_move", "int anic_turn(void);\nint anic_move"),
           "a constant": ("ANIC_B = 1", "ANIC_B = 1, ANIC_C = 2"),
           "a field at the end": ("uint8_t last;", "uint8_t last; uint64_t more;")}
REFUSED = {"a function less": ("int anic_move(const anic_point* point);", ""),
           "other parameters": ("anic_kind kind, anic_options* options", "anic_options* options, anic_kind kind"),
           "another number of a constant": ("ANIC_B = 1", "ANIC_B = 2"),
           "a field of a fixed struct": ("float x, y;", "float x, y, z;"),
           "fields in another order": ("uint32_t count; anic_point point;", "anic_point point; uint32_t count;"),
           "a field of another type": ("uint32_t count;", "float count;"),
           "a field in the middle": ("uint32_t count;", "uint32_t count, other;"),
           "a field less": ("uint8_t last;", ""),
           "a field in the padding": ("uint8_t last;", "uint8_t last, more;")}


def make_library(compiler, header, work):
    """A library of empty functions, its headers' folder beside it."""
    headers = work / "include"
    headers.mkdir(exist_ok=True)
    (headers / "toy.h").write_text(header, encoding="utf-8")
    bodies = "".join(line.replace(";", " { return 0; }\n") for line in header.splitlines() if line.startswith("int anic_"))
    (work / "toy.cpp").write_text('#include "toy.h"\n' + bodies, encoding="utf-8")
    library = work / "libtoy.so"
    subprocess.run([compiler, "-g", "-shared", "-fPIC", "-I", headers, work / "toy.cpp", "-o", library], check=True)
    return describe(library, headers, work)


def try_rules(compiler, work):
    reference = work / "reference.abi"
    ElementTree.ElementTree(make_library(compiler, BASE, work)).write(reference)
    failures = []
    for changes, wanted in ((ALLOWED, False), (REFUSED, True)):
        for name, (old, new) in changes.items():
            assert old in BASE, name
            found = bool(difference(make_library(compiler, BASE.replace(old, new, 1), work), reference, work))
            if found != wanted:
                failures.append(f"{name}: {'refused' if found else 'allowed'}")
    if failures:
        sys.exit("\n".join(failures))
    print(f"{len(ALLOWED)} changes allowed, {len(REFUSED)} refused")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if not (shutil.which("abidw") and shutil.which("abidiff")):
        print("skipped: abidw and abidiff are not installed (Debian: abigail-tools)")
        sys.exit(SKIPPED)
    if platform.machine() != "x86_64":
        print(f"skipped: the descriptions are of x86-64, this is {platform.machine()}")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        if sys.argv[1] == "--try-rules":
            return try_rules(sys.argv[2], work)
        library, headers, reference = sys.argv[1:4]
        now = describe(library, headers, work)
        if "--write" in sys.argv[4:]:
            ElementTree.ElementTree(now).write(reference)
            return
        functions = len(list(now.iter("function-decl")))
        report = difference(now, reference, work)
        if report:
            sys.exit(f"{library} breaks programs built with {reference} (docs/stability.md):\n{report}")
        print(f"{functions} functions and {len(structs(now))} structs: as in {pathlib.Path(reference).name}")


if __name__ == "__main__":
    main()
