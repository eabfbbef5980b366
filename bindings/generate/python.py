# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Python: dicts of structs, in the extension module, and the words of enumerations."""
from typing import Dict, Iterator

import headers
from headers import Enumeration, Interface, Struct

#: Structs that the library fills.
DICTS = ("anic_asset_info", "anic_clip", "anic_mesh", "anic_attribute", "anic_material", "anic_root_motion", "anic_encoding",
         "anic_live_piece", "anic_live_info")
#: Enumerations that Python has by their words.
WORDS = ("anic_up_axis", "anic_attribute_kind", "anic_domain", "anic_alpha", "anic_sampling", "anic_wrap", "anic_side", "anic_bound")

HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Structs of the C interface as dicts: numbers, bools, texts, tuples, and words of enumerations. Arrays at addresses and
// their sizes in bytes are left out. bindings/generate wrote this from the headers.
#ifndef ANICODEC_BINDINGS_PYTHON_BINDING_STRUCT_DICTS_H_
#define ANICODEC_BINDINGS_PYTHON_BINDING_STRUCT_DICTS_H_

#include "bindings/python/binding/binding.h"

#include <anicodec/encode.h>

#include <cstddef>
#include <cstdint>

// clang-format off
namespace anicodec::python {

/// A word of an enumeration; a number that this version has no word for as it is.
template <size_t kCount>
nb::object word_of(int32_t number, const char* const (&words)[kCount]) {
  if (number >= 0 && static_cast<size_t>(number) < kCount)
    return nb::str(words[number]);
  return nb::int_(number);
}

template <class Number, size_t kCount>
nb::tuple tuple_of(const Number (&numbers)[kCount]) {
  nb::list all;
  for (const Number number : numbers)
    all.append(number);
  return nb::tuple(all);
}

"""
TAIL = """\
}  // namespace anicodec::python

#endif  // ANICODEC_BINDINGS_PYTHON_BINDING_STRUCT_DICTS_H_
"""


def _table(e: Enumeration) -> str:
    return f"k{''.join(word.capitalize() for word in e.name.split('_')[1:])}Words"


def _words(e: Enumeration) -> Iterator[str]:
    words = e.words()
    assert list(words.values()) == list(range(len(words))), e.name
    listed = ", ".join(f'"{word}"' for word in words)
    yield f"inline constexpr const char* {_table(e)}[] = {{{listed}}};"


def _dict(interface: Interface, struct: Struct) -> Iterator[str]:
    yield f"inline nb::dict dict_of(const {struct.name}& s) {{"
    yield "  nb::dict d;"
    enumerations = {e.name: e for e in interface.enumerations()}
    for field in struct.fields:
        name, value = field.name, f"s.{field.name}"
        if field.type in ("size_t", ""):
            continue
        if name.endswith("_denominator"):
            name = name.removesuffix("_denominator")
            yield f'  d["{name}"] = nb::make_tuple(s.{name}_numerator, s.{name}_denominator);'
            continue
        if name.endswith("_numerator"):
            continue
        if field.type == "const char*":
            value = f"text_of({value})"
        elif field.stars:
            continue
        elif field.count:
            value = f"tuple_of({value})"
        elif field.base in enumerations:
            value = f"word_of({value}, {_table(enumerations[field.base])})"
        elif field.base == "uint8_t":
            value += " != 0"
        yield f'  d["{name}"] = {value};'
    yield "  return d;"
    yield "}"


def _numbers(interface: Interface, name: str) -> Iterator[str]:
    yield "/// Calls set(name, field) for each number of the struct."
    yield "template <class Set>"
    yield f"void each_number({name}& s, const Set& set) {{"
    enumerations = {e.name for e in interface.enumerations()}
    for field in interface.struct(name).fields:
        if field.type != "size_t" and not field.stars and not field.count and (field.base in headers.SIZES or field.base in enumerations):
            yield f'  set("{field.name}", s.{field.name});'
    yield "}"


def write(interface: Interface) -> Dict[str, str]:
    """The files, by their paths."""
    structs = [interface.struct(name) for name in DICTS]
    needed = {field.base for struct in structs for field in struct.fields}
    blocks = [_words(e) for e in interface.enumerations() if e.name in needed]
    blocks += [_dict(interface, struct) for struct in structs]
    blocks.append(_numbers(interface, "anic_encode_options"))
    words = ["# SPDX-License-Identifier: Apache-2.0", "# SPDX-FileCopyrightText: The anicodec authors",
             '"""Words of enumerations and their numbers. bindings/generate wrote this from the headers."""', ""]
    for name in WORDS:
        e = interface.enumeration(name)
        pairs = ", ".join(f'"{word}": {number}' for word, number in e.words().items())
        words.append(f"{name.removeprefix('anic_').upper()} = {{{pairs}}}")
    return {"bindings/python/binding/struct_dicts.h": HEAD + "".join("\n".join(lines) + "\n\n" for lines in blocks) + TAIL,
            "bindings/python/anicodec/_words.py": "\n".join(words) + "\n"}
