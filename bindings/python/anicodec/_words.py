# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Words of enumerations and their numbers. bindings/generate wrote this from the headers."""

UP_AXIS = {"unknown": 0, "y": 1, "z": 2}
ATTRIBUTE_KIND = {"uv": 0, "normal": 1, "tangent": 2, "colour": 3, "custom": 4, "material": 5, "part": 6}
DOMAIN = {"vertices": 0, "corners": 1, "polygons": 2}
ALPHA = {"opaque": 0, "mask": 1, "blend": 2}
SAMPLING = {"step": 0, "linear": 1, "cubic": 2}
WRAP = {"clamp": 0, "loop": 1, "ping-pong": 2}
SIDE = {"any": 0, "front": 1, "back": 2}
BOUND = {"usual": 0, "units": 1, "percent": 2, "exact": 3}
