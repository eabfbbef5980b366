# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Looks of materials."""
from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

from ._words import ALPHA
from .errors import InputError


class Material(NamedTuple):
    """The look of a material, in the terms of glTF 2.0. Textures are paths or names as in the source, "" for none."""

    base_colour: Tuple[float, float, float, float] = (1, 1, 1, 1)  #: linear RGBA
    metallic: float = 0
    roughness: float = 1
    emissive: Tuple[float, float, float] = (0, 0, 0)  #: linear RGB
    alpha: str = "opaque"  #: opaque, mask or blend
    alpha_cutoff: float = 0.5  #: of mask
    double_sided: bool = False
    base_colour_texture: str = ""
    metallic_roughness_texture: str = ""
    normal_texture: str = ""
    occlusion_texture: str = ""
    emissive_texture: str = ""


def from_file(look: Optional[Dict[str, Any]]) -> Optional[Material]:
    """A material as the extension module gives it."""
    return None if look is None else Material(**{name: look[name] for name in Material._fields})


def _to_file(look: Material) -> Tuple[List[float], List[str]]:
    if len(look.base_colour) != 4 or len(look.emissive) != 3:
        raise InputError("the base colour of a material has 4 numbers, what it emits 3")
    if look.alpha not in ALPHA:
        raise InputError(f"alpha is one of {', '.join(ALPHA)}, not {look.alpha!r}")
    numbers = [*look.base_colour, look.metallic, look.roughness, *look.emissive, look.alpha_cutoff]
    return [*map(float, numbers), ALPHA[look.alpha], bool(look.double_sided)], list(look[-5:])


def to_file(looks: Sequence[Optional[Material]], names: Sequence[str]) -> List[Optional[Tuple[List[float], List[str]]]]:
    """Looks as the extension module takes them: one for each name, or none."""
    if len(looks) not in (0, len(names)):
        raise InputError(f"there are {len(looks)} looks of {len(names)} materials")
    return [None if look is None else _to_file(look) for look in looks]
