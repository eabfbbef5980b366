# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The options of encoding. bindings/generate wrote this from encode_options.py and the headers."""

#: Targets and their numbers.
GOALS = {
    "max_error": 1,
    "kg": 2,
    "rmse": 3,
    "displacement": 6,
    "sted": 7,
    "size": 4,
    "bpfv": 5,
}

#: Targets that have a name, as STED.
QUALITIES = {
    "good": 0.05,
    "better": 0.02,
    "best": 0.01,
}

#: Options that are a word: the field of anic_encode_options, and the numbers of the words.
CHOICES = {
    "basis": ("basis", {"auto": 0, "keyframes": 1, "eigenshapes": 2, "eigentrajectories": 3}),
    "keyframe_selection": ("selection", {"gas": 1, "pivot": 0, "uniform": 2}),
    "interpolation": ("interpolation", {"linear": 1, "msgi": 2, "auto": 3}),
    "keyframe_coder": ("keyframe_coder", {"native": 0, "draco": 1, "auto": 2}),
    "order": ("order", {"auto": 0, "vertices": 0, "free": 1, "all": 2}),
    "effort": ("effort", {"fast": 1, "normal": 0, "best": 2}),
    "massage": ("massage", {"off": 0, "on": 1, "auto": 2}),
}

#: Options that are a number: the field of anic_encode_options.
NUMBERS = {
    "keyframes": "keyframes",
    "massage_strength": "massage_strength",
    "massage_tolerance": "massage_tolerance",
    "uv_bits": "uv_bits",
    "colour_bits": "colour_bits",
    "store_normals": "normal_error",
}

#: Options that are on or off.
FLAGS = {
    "smallest": 64,
    "no_attributes": 8,
    "root_motion": 16,
}

#: Types of values on the command line; bool: a switch.
COMMAND = {
    "max-error": str,
    "kg": str,
    "rmse": str,
    "displacement": str,
    "sted": str,
    "quality": str,
    "size": str,
    "bpfv": str,
    "lossless": bool,
    "basis": str,
    "keyframes": int,
    "keyframe-selection": str,
    "interpolation": str,
    "keyframe-coder": str,
    "order": str,
    "effort": str,
    "smallest": bool,
    "massage": str,
    "massage-strength": float,
    "massage-tolerance": float,
    "no-attributes": bool,
    "uv-bits": int,
    "colour-bits": int,
    "attribute-error": str,
    "store-normals": float,
    "fps": str,
    "up": str,
    "unit": str,
    "root-motion": bool,
    "loop": bool,
}

# Bits of anic_encode_options.flags.
PERCENT = 1
CAP_PERCENT = 2
ERROR_PERCENT = 4
NO_ATTRIBUTES = 8
ROOT_MOTION = 16
LOSSLESS = 32
SMALLEST = 64
