#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Finds riddles in the project's English: sentences that open with a reference word (`Where`, `What`, `Of`, `Those`,
`That which`, `Whichever of`), and chains of such words (`that of what`, `of those that`). It reads comments and docstrings of sources,
texts that the command and the libraries print, and Markdown pages; questions, code and headings may have any words.

usage: check_prose.py CHECKOUT [PATH...]      prints PLACE: FINDING: SENTENCE for each; exit status 1 if there is one
"""
import io
import pathlib
import re
import subprocess
import sys
import tokenize

C_LIKE = {".h", ".hpp", ".c", ".cpp", ".js", ".mjs", ".ts", ".jsx", ".tsx", ".rs", ".cs", ".ush", ".wesl", ".wgsl", ".glsl", ".gdshader", ".hlsl", ".shader"}
HASHED = {".sh", ".cmake", ".yml", ".toml"}
# Files of others, and some that bindings/generate writes from fragments in the headers.
FOREIGN = ("bindings/web/interface.d.ts", "bindings/csharp/Runtime/Enumerations.cs", "bindings/csharp/Runtime/Native.cs",
           "bindings/csharp/Runtime/NativeEncoder.cs", "tests/golden/", "tests/conformance/files/", "node_modules/", "bindings/web/dist/", "build/", "corpus/data/")
PRINTED = ("format/", "sdk/", "codec/", "tools/", "bindings/")  # string literals of their C++ and Python are messages and help

OPENING = re.compile(r"(?:Where|What|Of|Those|That which|Whichever of)\b")
IN_ANY_CASE = re.compile(OPENING.pattern, re.I)  # in public headers: other languages' references open with their words
CHAINS = [re.compile(pattern, re.I) for pattern in (
    r"\b(?:that|those) of (?:what|that|those|it|which)\b",
    r"\bhow what\b",
    r"\bwhat (?:that|those)\b",
    r"\bof (?:those|it|that|them|what) (?:that|which|whose)\b",
    r"\b(?:that|those) (?:which|what|whose)\b",
    r"\b(?:of|in|by|to|with|for|from|than|as|at|on) (?:what|that|those|which) (?:of|in|by|to|with|for|from) (?:what|that|those|it|which)\b",
)]
REFERENCE = re.compile(r"\b(?:that|what|which|those|of it|of them|of one)\b", re.I)
MOST = 3  # reference words of one clause that are a chain


def paragraphs_of_lines(lines):
    """Joins (number, text) of adjacent lines into (number, paragraph); an empty text or a list item ends one."""
    start, words, last = 0, [], None
    for number, text in lines:
        text = "" if text.strip().startswith("SPDX-") else text.strip()
        fresh = not text or re.match(r"(?:[-*+]|\d+\.) |@|\\", text) or (last is not None and number > last + 1)
        if fresh and words:
            yield start, " ".join(words)
            words = []
        if text:
            if not words:
                start = number
            words.append(re.sub(r"^(?:[-*+]|\d+\.) ", "", text))
        last = number
    if words:
        yield start, " ".join(words)


C_TOKEN = re.compile(r"""//(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/|R"(?P<tag>[^\s()\\]{0,16})\((?P<raw>.*?)\)(?P=tag)"
                         |"(?P<string>(?:\\.|[^"\\\n])*)"|(?P<quote>'(?:\\.[^'\n]*|[^'\\\n])')|`(?:\\.|[^`\\])*`""", re.S | re.X)


def c_texts(path, text):
    """Yields paragraphs of comments and, of PRINTED sources, of strings."""
    suffix = pathlib.PurePath(path).suffix
    comments, strings, end_of_string, last_column = [], [], None, None
    number, at = 1, 0
    for token in C_TOKEN.finditer(text):
        if token.group(0).startswith("`") and suffix in (".h", ".hpp", ".c", ".cpp", ".rs", ".cs"):
            continue
        number += text.count("\n", at, token.start())
        at = token.start()
        if token.group("line") is not None:
            column = at - text.rfind("\n", 0, at)
            if text[at - column + 1:at].strip() or column != last_column:  # beside code, or below such a comment
                comments.append((number - 0.5, ""))
            last_column = column
            comments.append((number, re.sub(r"^[/!<]*|</?\w+[^>]*>", "", token.group("line"))))
        elif token.group("block") is not None:
            comments.append((number, ""))
            for i, line in enumerate(token.group("block").split("\n")):
                comments.append((number + i, re.sub(r"^\s*[*!<]+|\*+$", "", line)))
            comments.append((number + i, ""))
        elif path.startswith(PRINTED) and suffix in (".h", ".cpp", ".c") and (token.group("string") or token.group("raw")):
            between = text[end_of_string:at].strip() if end_of_string is not None else "."
            value = token.group("raw") or token.group("string").replace("\\n", "\n").replace('\\"', '"')
            if between == "" and strings:
                strings[-1][1] += value
            else:
                strings.append([number, value])
            end_of_string = token.end()
    yield from paragraphs_of_lines(comments)
    for number, value in strings:
        if value.count(" ") >= 2:
            yield from ((number, p) for _, p in paragraphs_of_lines(enumerate(value.split("\n"))))


def python_texts(path, text):
    """Yields paragraphs of comments and docstrings and, of PRINTED sources, of strings."""
    comments, docs, strings, adjacent = [], [], [], False
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                if token.line[:token.start[1]].strip():
                    comments.append((token.start[0] - 0.5, ""))
                comments.append((token.start[0], token.string.lstrip("#!:")))
            elif token.type == tokenize.STRING and '"""' in token.string[:4]:
                inner = token.string[token.string.index('"""') + 3:-3]
                docs.extend((token.start[0] + i, line) for i, line in enumerate(inner.split("\n")))
                docs.append((token.end[0], ""))
            elif token.type == tokenize.STRING and path.startswith(PRINTED):
                value = re.sub(r"^\w*['\"]|['\"]$", "", token.string)
                if adjacent:
                    strings[-1][1] += value
                else:
                    strings.append([token.start[0], value])
            adjacent = token.type == tokenize.STRING or adjacent and token.type == tokenize.NL
    except (tokenize.TokenError, SyntaxError):
        pass
    yield from paragraphs_of_lines(comments)
    yield from paragraphs_of_lines(docs)
    yield from ((number, value) for number, value in strings if value.count(" ") >= 2)


def hashed_texts(text):
    lines = []
    for number, line in enumerate(text.split("\n"), 1):
        found = re.match(r"(?:.*\s)?#(?!!)\s*(.*)", line)
        if found and '"' not in line.split("#")[0]:
            if line.split("#")[0].strip():
                lines.append((number - 0.5, ""))
            lines.append((number, found.group(1)))
    yield from paragraphs_of_lines(lines)


def markdown_texts(text):
    lines, fenced = [], False
    all_lines = text.split("\n")
    for number, line in enumerate(all_lines, 1):
        if line.lstrip().startswith(("```", "~~~")):
            fenced = not fenced
            lines.append((number, ""))
        elif fenced or line.startswith("    ") and not lines[-1][1] or line.startswith(("#", "<")):
            lines.append((number, ""))
        elif line.lstrip().startswith("|"):
            header = number < len(all_lines) and re.match(r"\s*\|[\s:|-]+$", all_lines[number])
            for cell in [] if header else re.split(r"(?<!\\)\|", line):
                yield number, cell.strip()
            lines.append((number, ""))
        else:
            lines.append((number, line))
    yield from paragraphs_of_lines(lines)


def masked(match):
    return "X" * len(match.group(0))


def sentences(paragraph):
    """Yields (sentence, the same with an X for each character of code, targets of links, and quotations)."""
    plain = re.sub(r"`[^`]*`|(?<=\])\([^)\s]*\)|\"[^\"]*\"", masked, paragraph)
    at = 0
    for end in re.finditer(r"(?<=[.!?])[\])\"']*(?:\*\*)?\s+(?=[\"'(\[*]*[A-Z`])|$", plain):
        if plain[at:end.end()].strip():
            yield paragraph[at:end.end()].strip(), plain[at:end.end()].strip()
        at = end.end()


def findings(path, text):
    suffix = pathlib.PurePath(path).suffix
    if suffix in C_LIKE:
        texts = c_texts(path, text)
    elif suffix == ".py":
        texts = python_texts(path, text)
    elif suffix == ".md":
        texts = markdown_texts(text)
    elif suffix in HASHED or path.endswith("CMakeLists.txt"):
        texts = hashed_texts(text)
    else:
        return
    for number, paragraph in texts:
        for sentence, plain in sentences(paragraph):
            if plain.endswith("?"):
                continue
            opening = (IN_ANY_CASE if "include/anicodec/" in path else OPENING).match(plain.lstrip("[(\"'* "))
            if opening:
                yield number, f"opens with {opening.group(0)}", sentence
            chains = [found.group(0) for chain in CHAINS for found in chain.finditer(plain)]
            for clause in re.split(r"[,;:.()]\s", plain):
                words = REFERENCE.findall(clause)
                if len(words) >= MOST:
                    chains.append(" ".join(words))
            if chains and not opening:
                yield number, "chain of " + ", ".join(chains), sentence


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=root,
                            capture_output=True, text=True, check=False).stdout.split("\n")
    paths = [p for p in listed if p] or [str(p.relative_to(root)) for p in root.rglob("*") if p.is_file()]
    count = 0
    for path in sorted(paths):
        if any(part in path for part in FOREIGN) or (sys.argv[2:] and not path.startswith(tuple(sys.argv[2:]))):
            continue
        file = root / path
        if not file.is_file() or file.is_symlink():
            continue
        try:
            text = file.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        for number, finding, sentence in findings(path, text):
            print(f"{path}:{int(number)}: {finding}: {sentence}")
            count += 1
    print(f"{count} riddles" if count else "no riddles")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
