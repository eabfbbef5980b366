# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Reads the public headers of C. They are regular, so a hundred lines read them on any machine; a test compares with libclang."""
import dataclasses
import pathlib
import re
from typing import Dict, List, Optional, Tuple

#: Bytes of a type; 0: those of a pointer.
SIZES = {"size_t": 0, "ptrdiff_t": 0, "char": 1, "uint8_t": 1, "int16_t": 2, "int32_t": 4, "uint32_t": 4, "uint64_t": 8, "float": 4,
         "double": 8}
HEADERS = ("sdk/include/anicodec/anicodec.h", "codec/include/anicodec/encode.h")
INCLUDE = re.compile(r"^#include <anicodec/(\w+\.h)>.*$", re.MULTILINE)
TOKEN = re.compile(r'(?P<doc>/\*\*.*?\*/)|(?P<comment>/\*.*?\*/)|(?P<word>\w+)|(?P<text>"[^"]*")|(?P<sign>[^\s\w])', re.DOTALL)


@dataclasses.dataclass
class Variable:
    """A field or a parameter."""

    name: str
    type: str  #: of C, without the name: "const char* const*"; empty: a callback
    count: int = 0  #: of a fixed array; 0: it is none
    doc: str = ""

    @property
    def base(self) -> str:
        """The type without const and stars."""
        return re.sub(r"\bconst\b|\*", "", self.type).strip()

    @property
    def stars(self) -> int:
        return self.type.count("*")


@dataclasses.dataclass
class Constant:
    name: str
    value: int
    doc: str = ""


@dataclasses.dataclass
class Enumeration:
    name: str  #: empty: of flags
    constants: List[Constant]
    doc: str = ""

    @property
    def prefix(self) -> str:
        """The prefix of its constants: ANIC_WRAP_."""
        names = [constant.name for constant in self.constants if constant.name != "ANIC_OK"]
        length = next((i for i, letters in enumerate(zip(*names)) if len(set(letters)) > 1), len(names[0]))
        return names[0][:names[0].rfind("_", 0, length) + 1]

    def words(self) -> Dict[str, int]:
        """Its constants as languages with words have them: {"ping-pong": 2}."""
        return {c.name.removeprefix(self.prefix).lower().replace("_", "-"): c.value for c in self.constants}


@dataclasses.dataclass
class Struct:
    name: str
    fields: List[Variable]
    doc: str = ""


@dataclasses.dataclass
class Function:
    name: str
    result: str
    parameters: List[Variable]
    doc: str = ""


@dataclasses.dataclass
class Header:
    path: str
    enumerations: List[Enumeration] = dataclasses.field(default_factory=list)
    structs: List[Struct] = dataclasses.field(default_factory=list)
    handles: Dict[str, str] = dataclasses.field(default_factory=dict)  #: opaque types and what is said of them
    functions: List[Function] = dataclasses.field(default_factory=list)
    numbers: Dict[str, int] = dataclasses.field(default_factory=dict)  #: #define NAME 1


@dataclasses.dataclass
class Interface:
    decoder: Header
    encoder: Header

    def struct(self, name: str) -> Struct:
        return next(s for s in self.structs() if s.name == name)

    def structs(self) -> List[Struct]:
        return self.decoder.structs + self.encoder.structs

    def enumerations(self) -> List[Enumeration]:
        return self.decoder.enumerations + self.encoder.enumerations

    def enumeration(self, name: str) -> Enumeration:
        """By its name, or the prefix of its constants."""
        return next(e for e in self.enumerations() if name in (e.name, e.prefix))

    def layout(self, struct: Struct, pointer: int) -> Tuple[int, int, Dict[str, int]]:
        """Size and alignment of a struct and where its fields are, on a machine whose pointers have so many bytes."""
        at, widest, places = 0, 1, {}
        for field in struct.fields:
            if field.stars or not field.type:
                size = alignment = pointer
            elif field.base in SIZES:
                size = alignment = SIZES[field.base] or pointer
            elif any(field.base == e.name for e in self.enumerations()):
                size = alignment = 4
            else:
                size, alignment, _ = self.layout(self.struct(field.base), pointer)
            at = (at + alignment - 1) // alignment * alignment
            places[field.name] = at
            at += size * max(field.count, 1)
            widest = max(widest, alignment)
        return (at + widest - 1) // widest * widest, widest, places


def _as_c(text: str) -> str:
    """The lines that a compiler of C sees, without those of the preprocessor."""
    kept, branches = [], [True]
    for line in text.replace("\\\n", " ").split("\n"):
        words = line.split()
        if line.startswith("#if"):
            branches.append(words[:2] != ["#ifdef", "__cplusplus"])
        elif line.startswith("#else"):
            branches[-1] = words[0] == "#else" and not branches[-1]
        elif line.startswith("#endif"):
            branches.pop()
        elif not line.startswith("#") and all(branches):
            kept.append(line)
    return "\n".join(kept)


def _doc(comment: str) -> str:
    """The text of a comment, a line for each paragraph or point."""
    text = re.sub(r"^/\*\*<?|\*/$", "", comment)
    lines = [re.sub(r"^\s*\*? ?", "", line).rstrip() for line in text.split("\n")]
    out = [""]
    for line in lines:
        if not line.strip() or line.startswith("- "):
            out.append(line.strip())
        else:
            out[-1] = f"{out[-1]} {line.strip()}".strip()
    return "\n".join(line for line in out if line)


def _type(words: List[str]) -> str:
    return re.sub(r"\s*\*", "*", " ".join(words)).replace("*const", "* const")


class _Reader:
    def __init__(self, text: str, numbers: Dict[str, int]):
        self._tokens = [(m.lastgroup, m.group()) for m in TOKEN.finditer(_as_c(text)) if m.lastgroup != "comment"]
        self._at, self._numbers, self._pending = 0, numbers, ""

    def read(self, header: Header) -> None:
        while self._at < len(self._tokens):
            kind, token = self._tokens[self._at]
            if kind == "doc":
                self._at += 1
                self._pending = _doc(token)
                continue
            doc, self._pending = self._pending, ""
            if token == "enum":
                header.enumerations.append(self._enumeration(doc))
            elif token == "typedef" and self._word(1) == "struct" and self._word(3) == "{":
                header.structs.append(self._struct(doc))
            else:
                words = self._until(";")
                if words[:2] == ["typedef", "struct"]:
                    header.handles[words[2]] = doc
                elif words[0] == "ANIC_API":
                    header.functions.append(self._function(words[1:], doc))
                elif words[0] != "typedef":
                    raise ValueError(f"{header.path}: {' '.join(words[:12])} is nothing that the reader knows")

    def _word(self, ahead: int) -> str:
        return self._tokens[self._at + ahead][1]

    def _until(self, end: str) -> List[str]:
        """Words up to a sign, which is taken, without documents."""
        words, depth = [], 0
        while True:
            kind, token = self._tokens[self._at]
            self._at += 1
            if token == end and depth == 0:
                return words
            depth += (token in "({[") - (token in ")}]") if kind == "sign" else 0
            if kind != "doc":
                words.append(token)

    def _after(self) -> Optional[str]:
        """A document that follows what it is of."""
        kind, token = self._tokens[self._at]
        if kind != "doc" or not token.startswith("/**<"):
            return None
        self._at += 1
        return _doc(token)

    def _before(self) -> str:
        doc = ""
        while self._tokens[self._at][0] == "doc":
            doc = _doc(self._tokens[self._at][1])
            self._at += 1
        return doc

    def _enumeration(self, doc: str) -> Enumeration:
        head = self._until("{")
        made = Enumeration(head[1] if len(head) > 1 else "", [], doc)
        while True:
            before = self._before()
            if self._word(0) == "}":
                self._at += 1
                break
            made.constants.append(Constant(self._word(0), int(self._word(2)), before))
            self._at += 3
            made.constants[-1].doc = self._after() or made.constants[-1].doc
            if self._word(0) == ",":
                self._at += 1
                made.constants[-1].doc = self._after() or made.constants[-1].doc
        self._until(";")
        return made

    def _struct(self, doc: str) -> Struct:
        made = Struct(self._word(2), [], doc)
        self._at += 4
        while True:
            before = self._before()
            if self._word(0) == "}":
                self._at += 1
                break
            fields = self._variables(self._until(";"))
            after = self._after() or before
            for field in fields:
                field.doc = after
            made.fields += fields
        self._until(";")
        return made

    def _variables(self, words: List[str]) -> List[Variable]:
        if "(" in words:  # a callback
            return [Variable(words[words.index("(") + 2], "")]
        made, type_ = [], []
        for part in " ".join(words).split(" , "):
            part = part.split()
            count = 0
            if part[-1] == "]":
                size = part[-2]
                count = int(size) if size.isdigit() else self._numbers[size]
                part = part[:-3]
            type_ = part[:-1] or type_  # float min[3], max[3]
            made.append(Variable(part[-1], _type(type_), count))
        return made

    def _function(self, words: List[str], doc: str) -> Function:
        opening = words.index("(")
        inside = " ".join(words[opening + 1:-1])
        parameters = [] if inside == "void" else [v for part in inside.split(" , ") for v in self._variables(part.split())]
        return Function(words[opening - 1], _type(words[:opening - 1]), parameters, doc)


def text_of(header: pathlib.Path) -> str:
    """The text of a header, with those of its folder that it includes in their places, once each."""
    seen = {header.name}

    def expanded(text: str) -> str:
        def included(match: "re.Match[str]") -> str:
            path = header.parent / match[1]
            if not path.exists():
                return match[0]
            if path.name in seen:
                return ""
            seen.add(path.name)
            return expanded(path.read_text(encoding="utf-8"))
        return INCLUDE.sub(included, text)

    return expanded(header.read_text(encoding="utf-8"))


def read(checkout: pathlib.Path) -> Interface:
    """Both headers of a checkout. Raises ValueError for what the reader does not know."""
    numbers: Dict[str, int] = {}
    headers = []
    for path in HEADERS:
        text = text_of(checkout / path)
        header = Header(path)
        header.numbers = {name: int(number) for name, number in re.findall(r"^#define (ANIC_\w+) (\d+)$", text, re.MULTILINE)}
        numbers.update(header.numbers)
        _Reader(text, numbers).read(header)
        headers.append(header)
    return Interface(*headers)
