#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compares what bindings/generate/headers.py reads of the public headers with what libclang reads: every enumeration, struct, field,
offset, function, parameter and constant.

usage: check_generated.py CHECKOUT      exit status 77: skipped, there is no libclang (Debian: python3-clang)
"""
import pathlib
import sys

SKIPPED = 77


def spelled(text):
    """A type as both write it."""
    return text.replace("struct ", "").replace("enum ", "").replace(" ", "")


def of_clang(index, cindex, checkout, path):
    """Facts of a header, one a line."""
    unit = index.parse(str(checkout / path), ["-xc", "-std=c11", *(f"-I{checkout / module / 'include'}" for module in ("sdk", "codec"))],
                       options=cindex.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
    wrong = [str(d) for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error]
    if wrong:
        raise SystemExit("\n".join(wrong))
    kinds = cindex.CursorKind
    for cursor in unit.cursor.get_children():
        if not cursor.location.file or pathlib.Path(cursor.location.file.name).parent != (checkout / path).parent:
            continue
        if cursor.kind == kinds.ENUM_DECL:
            for constant in cursor.get_children():
                yield f"constant {constant.spelling} {constant.enum_value} of {cursor.spelling if cursor.spelling.startswith('anic_') else ''}"
        elif cursor.kind == kinds.STRUCT_DECL and cursor.is_definition():
            yield f"struct {cursor.spelling} of {cursor.type.get_size()} bytes"
            for field in cursor.type.get_fields():
                yield f"field {cursor.spelling}.{field.spelling} at {cursor.type.get_offset(field.spelling) // 8}"
        elif cursor.kind == kinds.FUNCTION_DECL:
            parameters = ", ".join(f"{spelled(p.type.spelling)} {p.spelling}" for p in cursor.get_arguments())
            yield f"function {spelled(cursor.result_type.spelling)} {cursor.spelling}({parameters})"
        elif cursor.kind == kinds.MACRO_DEFINITION:
            words = [token.spelling for token in cursor.get_tokens()]
            if len(words) == 2 and words[0].startswith("ANIC_") and words[1].isdigit():
                yield f"number {words[0]} {words[1]}"


def of_reader(interface, header):
    """The same facts, as the generators have them."""
    for e in header.enumerations:
        yield from (f"constant {c.name} {c.value} of {e.name}" for c in e.constants)
    for struct in header.structs:
        size, _, places = interface.layout(struct, 8)
        yield f"struct {struct.name} of {size} bytes"
        yield from (f"field {struct.name}.{name} at {at}" for name, at in places.items())
    for f in header.functions:
        yield f"function {spelled(f.result)} {f.name}({', '.join(f'{spelled(p.type)} {p.name}' for p in f.parameters)})"
    yield from (f"number {name} {value}" for name, value in header.numbers.items())


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    checkout = pathlib.Path(sys.argv[1]).resolve()
    try:
        from clang import cindex
        index = cindex.Index.create()
    except (ImportError, OSError) as error:
        print(f"skipped: there is no libclang (Debian: python3-clang): {error}")
        sys.exit(SKIPPED)
    sys.path.insert(0, str(checkout / "bindings" / "generate"))
    import headers
    interface = headers.read(checkout)
    faults = []
    for header in (interface.decoder, interface.encoder):
        theirs, ours = set(of_clang(index, cindex, checkout, header.path)), set(of_reader(interface, header))
        faults += [f"{header.path}: libclang alone reads: {fact}" for fact in sorted(theirs - ours)]
        faults += [f"{header.path}: headers.py alone reads: {fact}" for fact in sorted(ours - theirs)]
        print(f"{header.path}: {len(theirs & ours)} facts")
    print("\n".join(faults[:50]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
