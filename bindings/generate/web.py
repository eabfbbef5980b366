# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""JavaScript: words of enumerations, where fields of structs are in the memory of the module, and TypeScript's declarations."""
import re
import textwrap
from typing import Dict, Iterator, List

from headers import Enumeration, Interface, Struct, Variable

POINTER = 4  # wasm32
#: Structs that JavaScript reads, and their names in TypeScript; those inside of others first.
STRUCTS = {"anic_failure": "Failure", "anic_asset_info": "AssetInfo", "anic_clip": "NamedClip", "anic_event": "NamedTime",
           "anic_root_motion": "RootMotion", "anic_mesh": "MeshInfo", "anic_polygons": "Polygons", "anic_attribute": "AttributeInfo",
           "anic_material": "Look", "anic_box": "Box", "anic_surface_point": "SurfacePoint", "anic_surface_frame": "SurfaceFrame",
           "anic_hit": "Hit", "anic_render_info": "RenderInfo", "anic_basis": "Basis", "anic_part": "Part", "anic_parts": "Parts",
           "anic_stream_info": "StreamInfo"}
#: Enumerations that functions of JavaScript take or give, and their names in TypeScript.
WORDS = {"anic_sampling": "Sampling", "anic_wrap": "Wrap", "anic_side": "Side"}
#: Fields that have another name than in C: every count of things is theirs alone.
RENAMED = {"mesh_count": "meshes", "segment_count": "segments", "frame_count": "frames", "closed": "closedLoop", "open": "isOpen",
           "base_colour_texture": "baseColourImage", "metallic_roughness_texture": "metallicRoughnessImage",
           "normal_texture": "normalImage", "occlusion_texture": "occlusionImage", "emissive_texture": "emissiveImage"}
RENAMED_IN = ("anic_asset_info", "anic_clip", "anic_material")
KINDS = {"uint8_t": "bool", "int16_t": "i16", "int32_t": "i32", "uint32_t": "u32", "size_t": "u32", "uint64_t": "u64", "float": "f32",
         "double": "f64"}
HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// bindings/generate wrote this from the headers.
"""


def _camel(name: str) -> str:
    return re.sub(r"_(\w)", lambda m: m.group(1).upper(), name)


def _upper(struct: Struct) -> str:
    return struct.name.removeprefix("anic_").upper()


def _quoted(words: List[str]) -> List[str]:
    return ["undefined" if word == "unknown" else f"'{word}'" for word in words]


class _Field:
    """A field as JavaScript sees it: a name, a kind, a place; count 0: no array."""

    def __init__(self, interface: Interface, struct: Struct, field: Variable, at: int):
        enumerations: Dict[str, Enumeration] = {e.name: e for e in interface.enumerations()}
        self.at, self.count, self.doc = at, field.count, field.doc
        self.name = RENAMED.get(field.name) if struct.name in RENAMED_IN else None
        self.name = self.name or _camel(field.name)
        if field.type == "const char*":
            self.kind, self.type = "'text'", "string"
        elif field.stars:
            self.name += "At"
            self.kind, self.type = "'u32'", "number"
        elif field.base == "char":
            self.kind, self.type, self.count = "'chars'", "string", 0
        elif field.name.endswith("_numerator"):
            self.name, self.kind, self.type = _camel(field.name.removesuffix("_numerator")), "'ratio'", "number"
        elif field.base in enumerations and field.base != "anic_status":
            words = _quoted(list(enumerations[field.base].words()))
            self.kind, self.type = f"[{', '.join(words)}]", " | ".join(words)
        elif field.base in STRUCTS:
            self.kind, self.type = field.base.removeprefix("anic_").upper(), STRUCTS[field.base]
        else:
            self.kind = f"'{KINDS.get(field.base, 'i32')}'"
            self.type = "boolean" if field.base == "uint8_t" else "number"
        if self.count and self.count <= 4:
            self.type = f"[{', '.join([self.type] * self.count)}]"
        elif self.count:
            self.type += "[]"

    def entry(self) -> str:
        return f"['{self.name}', {self.kind}, {self.at}{f', {self.count}' if self.count else ''}]"


def _fields(interface: Interface, struct: Struct) -> Iterator[_Field]:
    _, _, places = interface.layout(struct, POINTER)
    for field in struct.fields:
        if field.name != "struct_size" and not field.name.endswith("_denominator"):
            yield _Field(interface, struct, field, places[field.name])


def _doc(text: str, indent: str) -> Iterator[str]:
    text = " ".join(text.split()).replace("*/", "* /")
    if text:
        text = (text[0].upper() if text[:2].isalpha() else text[0]) + text[1:] + ("" if text.endswith(".") else ".")
        lines = textwrap.wrap(text, 120 - len(indent))
        if len(lines) == 1:
            yield f"{indent}/** {lines[0]} */"
        else:
            yield f"{indent}/**"
            yield from (f"{indent} * {line}" for line in lines)
            yield f"{indent} */"


def _script(interface: Interface, structs: List[Struct]) -> str:
    lines = []
    statuses = [f"{c.value}:\0'{c.name}'" for c in interface.enumeration("anic_status").constants if c.value]
    lines += ["", "/** Statuses by number. */", "export const STATUS = {"]
    lines += textwrap.wrap(", ".join(statuses) + ",", 120, initial_indent="  ", subsequent_indent="  ", break_on_hyphens=False)
    lines += ["};", "", "// Words and their numbers."]
    for name in WORDS:
        pairs = [(f"'{word}'" if "-" in word else word, number) for word, number in interface.enumeration(name).words().items()]
        words = ", ".join(f"{word}: {number}" for word, number in pairs)
        lines.append(f"export const {name.removeprefix('anic_').upper()} = {{ {words} }};")
    flags = interface.enumeration("ANIC_OPEN_")
    lines += ["", "// Flags of opening."]
    lines += [f"export const {c.name.removeprefix('ANIC_')} = {c.value};" for c in flags.constants]
    lines += ["", "// Structs, for Decoder.read(): bytes, and each field with its name, kind, place and count. A pointer is an address."]
    for struct in structs:
        size, _, _ = interface.layout(struct, POINTER)
        lines.append(f"export const {_upper(struct)} = {{")
        lines.append(f"  size: {size}, fields: [")
        lines += textwrap.wrap(", ".join(f.entry().replace(" ", "\0") for f in _fields(interface, struct)) + ",", 120,
                               initial_indent="    ", subsequent_indent="    ", break_on_hyphens=False, break_long_words=False)
        lines += ["  ],", "};"]
    return HEAD + "\n".join(lines).replace("\0", " ") + "\n"


def _types(interface: Interface, structs: List[Struct]) -> str:
    lines = [""]
    for name, kind in WORDS.items():
        e = interface.enumeration(name)
        lines += [*_doc(e.doc, ""), f"export type {kind} = {' | '.join(_quoted(list(e.words())))};", ""]
    for struct in structs:
        lines += [*_doc(struct.doc, ""), f"export interface {STRUCTS[struct.name]} {{"]
        for field in _fields(interface, struct):
            lines += [*_doc(field.doc, "  "), f"  readonly {field.name}: {field.type};"]
        lines += ["}", ""]
    return HEAD + "\n".join(lines[:-1]) + "\n"


def _layout(interface: Interface, structs: List[Struct]) -> str:
    lines = ["/* SPDX-License-Identifier: Apache-2.0", " * SPDX-FileCopyrightText: The anicodec authors", " *",
             " * Places of fields that interface.js relies on: another compiler of C stops here. bindings/generate wrote this from the headers. */",
             "#ifndef ANICODEC_BINDINGS_WEB_BINDING_STRUCT_LAYOUT_H_", "#define ANICODEC_BINDINGS_WEB_BINDING_STRUCT_LAYOUT_H_", "",
             "#include <anicodec/anicodec.h>", "", "#include <stddef.h>", "", "/* clang-format off */",
             "#define AT(type, field, place) typedef char at_##type##_##field[offsetof(type, field) == (place) ? 1 : -1]",
             "#define SIZE(type, bytes) typedef char size_##type[sizeof(type) == (bytes) ? 1 : -1]"]
    for struct in structs:
        size, _, places = interface.layout(struct, POINTER)
        lines += [f"SIZE({struct.name}, {size});"]
        lines += [f"AT({struct.name}, {name}, {at});" for name, at in places.items()]
    return "\n".join([*lines, "#undef AT", "#undef SIZE", "", "#endif"]) + "\n"


def write(interface: Interface) -> Dict[str, str]:
    """The files, by their paths."""
    structs = [interface.struct(name) for name in STRUCTS]
    return {"bindings/web/interface.js": _script(interface, structs), "bindings/web/interface.d.ts": _types(interface, structs),
            "bindings/web/binding/struct_layout.h": _layout(interface, structs)}
