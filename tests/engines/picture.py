# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Pictures that engines draw, compared with what they drew when somebody looked: mean brightness in a grid, as text, so that
another renderer's edges make no difference and a missing or misplaced object does."""
import os
import pathlib

COLUMNS, ROWS = 32, 18
MOST, MEAN = 24, 2.5  # of 255: difference of one field, and of all of them
FOLDER = pathlib.Path(__file__).resolve().parent / "pictures"


def read_ppm(path):
    """Width, height and bytes of a binary PPM."""
    data = pathlib.Path(path).read_bytes()
    words, at = [], 0
    while len(words) < 4:
        end = at
        while data[end:end + 1] not in (b" ", b"\n"):
            end += 1
        words.append(data[at:end])
        at = end + 1
    assert words[0] == b"P6" and words[3] == b"255", words
    return int(words[1]), int(words[2]), data[at:]


def grid(width, height, pixels):
    """Mean brightness of fields, row by row from the top, from 0 to 255."""
    rows = []
    for r in range(ROWS):
        sums, counts = [0] * COLUMNS, [0] * COLUMNS
        for y in range(r * height // ROWS, (r + 1) * height // ROWS):
            line = pixels[3 * width * y:3 * width * (y + 1)]
            for c in range(COLUMNS):
                part = line[3 * (c * width // COLUMNS):3 * ((c + 1) * width // COLUMNS)]
                sums[c] += sum(part)
                counts[c] += len(part)
        rows.append([round(s / n) for s, n in zip(sums, counts)])
    return rows


def compare(path, name):
    """Nothing if a PPM looks like pictures/NAME.txt, else a sentence. ANICODEC_UPDATE_PICTURES=1 writes the text anew."""
    found = grid(*read_ppm(path))
    reference = FOLDER / f"{name}.txt"
    if os.environ.get("ANICODEC_UPDATE_PICTURES"):
        reference.write_text("\n".join(" ".join(f"{x:3}" for x in row) for row in found) + "\n", encoding="utf-8")
    expected = [[int(word) for word in line.split()] for line in reference.read_text(encoding="utf-8").splitlines()]
    differences = [abs(a - b) for one, other in zip(found, expected) for a, b in zip(one, other)]
    most, mean = max(differences), sum(differences) / len(differences)
    print(f"{name}: differs by {most} in a field, {mean:.2f} on average")
    if most > MOST or mean > MEAN:
        return f"{path} does not look like {reference}: {most} in a field, {mean:.2f} on average"
    return None
