# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""C#: enumerations, structs, functions and handles of the headers."""
import textwrap
from typing import Dict, Iterator, List

from headers import Enumeration, Function, Header, Interface, Struct, Variable

TYPES = {"size_t": "UIntPtr", "ptrdiff_t": "IntPtr", "uint8_t": "byte", "char": "byte", "int16_t": "short", "int32_t": "int",
         "uint32_t": "uint", "uint64_t": "ulong", "float": "float", "double": "double", "void": "void", "int": "int"}
#: Enumerations that have another name than in C, by their prefix.
RENAMED = {"ANIC_ORDER_": "VertexOrder", "ANIC_ALPHA_": "AlphaMode", "ANIC_FORMAT_": "VertexFormat", "ANIC_VALUE_": "ValueFormat",
           "ANIC_TEXTURE_": "BasisTexture", "ANIC_OPEN_": "OpenFlags", "ANIC_ENCODE_": "EncodeFlags"}
#: Handles of the encoder that hosts see: live streams alone are for C#.
SHOWN = ("anic_goal", "anic_effort")
#: Structs that the package shows as they are, with names of its own: Structs.cs.
SHOWN_STRUCTS = {"anic_box": "Box", "anic_surface_point": "SurfacePoint", "anic_surface_frame": "SurfaceFrame", "anic_hit": "Hit",
                 "anic_correction": "Correction"}
KEYWORDS = {"event", "out", "params", "in", "ref", "object", "string", "fixed", "base", "checked", "default", "lock"}
HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// bindings/generate wrote this from {0}.
using System;
using System.Runtime.InteropServices;

namespace Anicodec
{{
"""


def camel(name: str) -> str:
    """UP_AXIS and anic_up_axis as UpAxis."""
    return "".join(word.capitalize() for word in name.removeprefix("anic_").split("_"))


def enumeration_name(e: Enumeration) -> str:
    return RENAMED.get(e.prefix) or camel(e.name)


def constant_name(e: Enumeration, constant: str) -> str:
    return "Ok" if constant == "ANIC_OK" else camel(constant.removeprefix(e.prefix))


def _summary(text: str, indent: str) -> Iterator[str]:
    text = " ".join(text.split()).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    if text:
        first = text[0].upper() if text[:2].isalpha() else text[0]
        text = f"<summary>{first}{text[1:]}{'' if text.endswith('.') else '.'}</summary>"
        yield from textwrap.wrap(text, 130, initial_indent=f"{indent}/// ", subsequent_indent=f"{indent}/// ")


def _enumeration(e: Enumeration, indent: str) -> Iterator[str]:
    yield from _summary(e.doc or f"{e.prefix}...", indent)
    if not e.name:
        yield f"{indent}[Flags]"
    yield f"{indent}public enum {enumeration_name(e)}"
    yield f"{indent}{{"
    if not e.name:
        yield f"{indent}    None = 0,"
    for constant in e.constants:
        yield from _summary(constant.doc, indent + "    ")
        yield f"{indent}    {constant_name(e, constant.name)} = {constant.value},"
    yield f"{indent}}}"


class _Writer:
    def __init__(self, interface: Interface, header: Header):
        self._header = header
        self._enumerations = {e.name: enumeration_name(e) for e in interface.enumerations()}
        self._classes = {s.name: "" if header is h else "Native." for h in (interface.decoder, interface.encoder) for s in h.structs}
        self._handles = {name: f"{camel(name)}Handle" for h in (interface.decoder, interface.encoder) for name in h.handles}
        self._closers: Dict[str, str] = {f.parameters[0].base: f.name for f in header.functions
                                         if f.name.startswith(("anic_close_", "anic_destroy_"))}

    def type_of(self, variable: Variable) -> str:
        if not variable.type or (variable.type == "void*" and variable.name == "user"):
            return "IntPtr"
        base = TYPES.get(variable.base) or self._enumerations.get(variable.base) or SHOWN_STRUCTS.get(variable.base)
        return (base or self._classes[variable.base] + variable.base) + "*" * variable.stars

    def struct(self, struct: Struct) -> Iterator[str]:
        yield "        [StructLayout(LayoutKind.Sequential)]"
        yield f"        public struct {struct.name}"
        yield "        {"
        for field in struct.fields:
            kind = self.type_of(field)
            if field.count and field.base in TYPES and not field.stars:
                yield f"            public fixed {kind} {field.name}[{field.count}];"
            elif field.count:
                yield f"            public {kind} {', '.join(f'{field.name}{i}' for i in range(field.count))};"
            else:
                yield f"            public {kind} {field.name};"
        yield "        }"

    def function(self, function: Function) -> str:
        result = self.type_of(Variable("", function.result))
        parameters = ", ".join(self._parameter(function, parameter) for parameter in function.parameters)
        return f"        [DllImport(Library)] public static extern {result} {function.name}({parameters});"

    def _parameter(self, function: Function, parameter: Variable) -> str:
        name = "@" + parameter.name if parameter.name in KEYWORDS else parameter.name
        handle = self._handles.get(parameter.base)
        if not handle:
            return f"{self.type_of(parameter)} {name}"
        if function.name in self._closers.values():
            return f"IntPtr {name}"
        return f"{'out ' if parameter.stars == 2 else ''}{handle} {name}"

    def handle(self, name: str, native: str) -> List[str]:
        return textwrap.indent(textwrap.dedent(f"""\
            internal sealed partial class {self._handles[name]} : SafeHandle
            {{
                public {self._handles[name]}() : base(IntPtr.Zero, true) {{ }}
                public override bool IsInvalid {{ get {{ return handle == IntPtr.Zero; }} }}

                /// <summary>Runs behind the release, for handles that keep others open.</summary>
                partial void Released();

                protected override bool ReleaseHandle()
                {{
                    {native}.{self._closers[name]}(handle);
                    Released();
                    return true;
                }}
            }}"""), "    ").split("\n")


def _native(interface: Interface, header: Header, name: str) -> str:
    writer = _Writer(interface, header)
    blocks = [writer.handle(handle, name) for handle in header.handles]
    body: List[List[str]] = []
    if header is interface.encoder:
        body += [list(_enumeration(e, " " * 8)) for e in header.enumerations if e.name not in SHOWN]
    body += [list(writer.struct(struct)) for struct in header.structs if struct.name not in SHOWN_STRUCTS]
    body.append([writer.function(function) for function in header.functions])
    blocks.append([f"    internal static unsafe partial class {name}", "    {",
                   "\n\n".join("\n".join(lines) for lines in body), "    }"])
    return HEAD.format(header.path) + "\n\n".join("\n".join(lines) for lines in blocks) + "\n}\n"


def write(interface: Interface) -> Dict[str, str]:
    """The files, by their paths."""
    shown = [e for h in (interface.decoder, interface.encoder) for e in h.enumerations if h is interface.decoder or e.name in SHOWN]
    folder = "bindings/csharp/Runtime"
    enumerations = "\n\n".join("\n".join(_enumeration(e, "    ")) for e in shown)
    return {f"{folder}/Enumerations.cs": HEAD.format("the headers").replace("using System.Runtime.InteropServices;\n", "") + enumerations + "\n}\n",
            f"{folder}/Native.cs": _native(interface, interface.decoder, "Native"),
            f"{folder}/NativeEncoder.cs": _native(interface, interface.encoder, "NativeEncoder")}
