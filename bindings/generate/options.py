# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The options of encoding: what the command declares, what the C interface makes of them, and the words of Python."""
from typing import Dict, Iterator, List

from encode_options import EXCLUDED, GROUPS, QUALITIES, Choice, Option
from headers import Interface

NOTICE = "// SPDX-License-Identifier: Apache-2.0\n// SPDX-FileCopyrightText: The anicodec authors\n//\n// {}\n" \
         "// bindings/generate wrote this from encode_options.py.\n"


def _all() -> List[Option]:
    return [option for _, options in GROUPS for option in options]


def _camel(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("-"))


def _table(option: Option) -> str:
    return option.choice.table or f"k{_camel(option.name)}Words"


def _type(choice: Choice) -> str:
    return f"std::optional<{choice.type}>" if choice.optional else choice.type


def _member(option: Option) -> str:
    if option.choice and option.choice.optional:
        return f"{_type(option.choice)} {option.variable};"
    if option.choice:
        return f"{option.choice.type} {option.variable} = {option.choice.type}::{option.start or option.choice.words[0][1]};"
    if option.number:
        return f"{option.number} {option.variable} = {option.start};"
    if not option.value:
        return f"bool {option.variable} = false;"
    return f"{'std::vector<std::string>' if option.repeats else 'std::string'} {option.variable};"


def _declaration(option: Option) -> str:
    names, place, text = f'"--{option.name}"', f"c.{option.variable}", f'"{option.text}"'
    if option.choice:
        return f"options.choice({names}, {place}, {{{_table(option)}}},\n                 {text});"
    if option.number:
        return f'options.number({names}, {place}, "{option.value}", {option.bounds},\n                 {text});'
    if not option.value:
        return f"options.flag({names}, {place},\n               {text});"
    return f'options.{"repeated" if option.repeats else "option"}({names}, {place}, "{option.value}",\n                 {text});'


def _comment(text: str, column: int = 100) -> Iterator[str]:
    line = "///"
    for word in text.split():
        if len(line) + 1 + len(word) > column:
            yield line
            line = "///"
        line += " " + word
    yield line


def _command_header() -> str:
    lines = [NOTICE.format("The options of encoding on the command line."),
             "#ifndef ANICODEC_TOOLS_INPUTS_ENCODE_CHOICES_H_\n#define ANICODEC_TOOLS_INPUTS_ENCODE_CHOICES_H_\n",
             '#include "codec/plan/encode_options.h"\n#include "codec/sequence/mesh_sequence.h"\n'
             '#include "tools/options/options.h"\n#include "tools/words/word_table.h"\n',
             "#include <cstdint>\n#include <optional>\n#include <string>\n#include <vector>\n",
             "// clang-format off\nnamespace anicodec::tools {\n"]
    for option in _all():
        choice = option.choice
        if choice and choice.declared:
            lines += [*_comment(choice.declared), f"enum class {choice.type} : uint8_t {{ {', '.join(w[1] for w in choice.words)} }};\n"]
    for option in _all():
        choice = option.choice
        if choice and choice.words:
            words = ",\n    ".join(f'{{{choice.type}::{enumerator}, "{word}"}}' for word, enumerator, _ in choice.words)
            lines.append(f"inline constexpr Word<{_type(choice)}> {_table(option)}[] = {{\n    {words}}};\n")
    steds = ", ".join(str(sted) for sted in QUALITIES.values())
    lines += ["/// The STED of each Quality.", f"inline constexpr double kQualitySteds[] = {{{steds}}};\n",
              "/// Their values. Texts are read by the command.", "struct EncodeChoices {",
              *(f"  {_member(option)}" for option in _all()), "};\n",
              "/// Declares them, which write to `choices`.", "void add_encode_choices(Options& options, EncodeChoices& choices);\n",
              "/// Declares those of a clip that is added to a file.", "void add_clip_choices(Options& options, EncodeChoices& choices);\n",
              "/// Sets the encoder's options that they are one to one.", "void copy_choices(const EncodeChoices& choices, EncodeOptions* options);\n",
              "}  // namespace anicodec::tools\n", "#endif  // ANICODEC_TOOLS_INPUTS_ENCODE_CHOICES_H_\n"]
    return "\n".join(lines)


def _adder(name: str, of_clip: bool) -> Iterator[str]:
    yield f"void {name}(Options& options, EncodeChoices& c) {{"
    for group, every in GROUPS:
        options = [option for option in every if option.of_clip or not of_clip]
        if options:
            yield f'  options.group("{group}");'
        yield from (f"  {_declaration(option)}" for option in options)
        names = {option.name for option in options}
        for excluded in EXCLUDED:
            if names.issuperset(excluded):
                yield f"  options.exclude({{{', '.join(chr(34) + '--' + name + chr(34) for name in excluded)}}});"
    yield "}\n"


def _command_source() -> str:
    lines = [NOTICE.format("The options of encoding on the command line."),
             '#include "tools/inputs/encode_choices.h"\n', '#include "format/records.h"\n#include "tools/words/names.h"\n',
             "// clang-format off\nnamespace anicodec::tools {\n", *_adder("add_encode_choices", False), *_adder("add_clip_choices", True),
             "void copy_choices(const EncodeChoices& c, EncodeOptions* options) {"]
    for option in _all():
        if option.sets:
            lines.append(f"  options->{option.sets} = {'!' if option.inverted else ''}c.{option.variable};")
    return "\n".join([*lines, "}\n", "}  // namespace anicodec::tools\n"])


def _host_header(interface: Interface) -> str:
    known = " |\n    ".join(c.name for c in interface.enumeration("ANIC_ENCODE_").constants)
    fields = {field.name: field for field in interface.struct("anic_encode_options").fields}
    lines = [NOTICE.format("The options of a host, of which each is one of the encoder's."),
             "#ifndef ANICODEC_CODEC_API_HOST_CHOICES_H_\n#define ANICODEC_CODEC_API_HOST_CHOICES_H_\n",
             '#include "codec/api/encoder_objects.h"\n#include "codec/api/host_values.h"\n', "#include <cstdint>\n#include <optional>\n",
             "// clang-format off\nnamespace anicodec {\n", "/// Flags that this version knows.",
             f"inline constexpr uint64_t kKnownFlags =\n    {known};\n", "/// Throws EncoderFailure(ANIC_E_ARGUMENT).",
             "inline void set_choices(const anic_encode_options& host, EncodeOptions* options) {"]
    for option in _all():
        sets = option.host_sets or option.sets
        if not sets:
            continue
        if option.flag:
            test = "==" if option.inverted else "!="
            lines.append(f"  options->{sets} = (host.flags & {option.flag}) {test} 0;")
        elif option.choice:
            constants = interface.enumeration(fields[option.field].base).constants
            kind = option.choice.host_type or option.choice.type
            ours = {constant: f"{kind}::{enumerator}" for _, enumerator, constant in reversed(option.choice.words)}
            table = f"k{_camel(option.name)}"
            if option.choice.host_type:  # words of the command that choose among them
                ours = {c: f"{kind}::{e}" for _, e, c in option.choice.words if e != "kAuto"}
            listed = ", ".join(ours.get(c.name, "std::nullopt") for c in constants)
            assert [c.value for c in constants] == list(range(len(constants))), option.field
            lines += [f"  constexpr {'std::optional<' + kind + '>' if option.choice.optional else kind} {table}[] = {{\n      {listed}}};",
                      f'  options->{sets} = chosen(host.{option.field}, {table}, "{option.field}");']
        elif option.most:
            lines.append(f'  options->{sets} = within(host.{option.field}, options->{sets}, {option.most}, "{option.field}");')
        else:
            lines.append(f'  if (amount(host.{option.field}, "{option.field}") > 0)\n    options->{sets} = host.{option.field};')
    return "\n".join([*lines, "}\n", "}  // namespace anicodec\n", "#endif  // ANICODEC_CODEC_API_HOST_CHOICES_H_\n"])


def _python(interface: Interface) -> str:
    numbers = {c.name: c.value for e in interface.enumerations() for c in e.constants}
    lines = ["# SPDX-License-Identifier: Apache-2.0", "# SPDX-FileCopyrightText: The anicodec authors",
             '"""The options of encoding. bindings/generate wrote this from encode_options.py and the headers."""', ""]

    def table(name: str, comment: str, rows: Iterator[str]) -> None:
        lines.extend([f"#: {comment}", f"{name} = {{", *(f"    {row}," for row in rows), "}", ""])
    options = _all()
    table("GOALS", "Targets and their numbers.", (f'"{o.keyword}": {numbers[o.goal]}' for o in options if o.goal))
    table("QUALITIES", "Targets that have a name, as STED.", (f'"{word}": {sted}' for word, sted in QUALITIES.items()))
    choices = [o for o in options if o.choice and o.field]
    table("CHOICES", "Options that are a word: the field of anic_encode_options, and the numbers of the words.", (
        f'"{o.keyword}": ("{o.field}", {{' + ", ".join(f'"{w}": {numbers[c]}' for w, _, c in o.choice.words) + "})" for o in choices))
    table("NUMBERS", "Options that are a number: the field of anic_encode_options.", (
        f'"{o.keyword}": "{o.field}"' for o in options if o.field and not o.choice and o.name != "attribute-error"))
    table("FLAGS", "Options that are on or off.", (f'"{o.keyword}": {numbers[o.flag]}' for o in options if o.flag and o.name != "lossless"))
    types = {field.name: {"double": "float", "uint32_t": "int"}.get(field.base) for field in interface.struct("anic_encode_options").fields}
    table("COMMAND", "Types of values on the command line; bool: a switch.", (
        f'"{o.name}": ' + ("bool" if not (o.value or o.choice) else types.get(o.field) if o.field and o.name != "attribute-error" and not o.choice
                           else "str") for o in options if o.python))
    flags = interface.enumeration("ANIC_ENCODE_").constants
    lines.append("# Bits of anic_encode_options.flags.")
    lines += [f"{c.name.removeprefix('ANIC_ENCODE_')} = {c.value}" for c in flags]
    return "\n".join(lines) + "\n"


def write(interface: Interface) -> Dict[str, str]:
    """The files, by their paths."""
    return {"tools/inputs/encode_choices.h": _command_header(), "tools/inputs/encode_choices.cpp": _command_source(),
            "codec/api/host_choices.h": _host_header(interface), "bindings/python/anicodec/_options.py": _python(interface)}
