# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Looks of materials: those of clips are in the terms of glTF, those of Blender nodes."""
import anicodec

_MASK, _BLEND = "CLIP", "BLEND"


def apply(material, look):
    """Gives a material of Blender the values of a clip's."""
    if not material.use_nodes:
        material.use_nodes = True
    shader = _shader(material)
    if shader is None:
        return
    _set(shader, ("Base Color",), look.base_colour)
    _set(shader, ("Metallic",), look.metallic)
    _set(shader, ("Roughness",), look.roughness)
    _set(shader, ("Alpha",), look.base_colour[3])
    _set(shader, ("Emission Color", "Emission"), (*look.emissive, 1))
    _set(shader, ("Emission Strength",), 1 if any(look.emissive) else 0)
    material.diffuse_color = look.base_colour
    material.metallic, material.roughness = look.metallic, look.roughness
    material.use_backface_culling = not look.double_sided
    if hasattr(material, "blend_method"):
        material.blend_method = {"mask": _MASK, "blend": _BLEND}.get(look.alpha, "OPAQUE")
        material.alpha_threshold = look.alpha_cutoff


def look_of(material):
    """The look of a material of Blender; None of none."""
    if material is None:
        return None
    shader = _shader(material) if material.use_nodes else None
    if shader is None:
        red, green, blue, alpha = material.diffuse_color
        return anicodec.Material((red, green, blue, alpha), material.metallic, material.roughness,
                                 alpha="blend" if alpha < 1 else "opaque",
                                 double_sided=not material.use_backface_culling)
    alpha = _get(shader, ("Alpha",), 1.0)
    strength = _get(shader, ("Emission Strength",), 1.0)
    emission = _get(shader, ("Emission Color", "Emission"), (0, 0, 0))
    method = getattr(material, "blend_method", _BLEND if alpha < 1 else "OPAQUE")
    return anicodec.Material(
        (*tuple(_get(shader, ("Base Color",), (1, 1, 1)))[:3], alpha), _get(shader, ("Metallic",), 0.0),
        _get(shader, ("Roughness",), 1.0), tuple(strength * part for part in tuple(emission)[:3]),
        "mask" if method == _MASK else "opaque" if method == "OPAQUE" else "blend",
        getattr(material, "alpha_threshold", 0.5), not material.use_backface_culling,
        base_colour_texture=_texture(shader, "Base Color"))


def _shader(material):
    nodes = material.node_tree.nodes if material.node_tree else ()
    return next((node for node in nodes if node.type == "BSDF_PRINCIPLED"), None)


def _socket(shader, names):
    return next((shader.inputs[name] for name in names if name in shader.inputs), None)


def _set(shader, names, value):
    socket = _socket(shader, names)
    if socket is not None:
        socket.default_value = value


def _get(shader, names, default):
    socket = _socket(shader, names)
    return default if socket is None else socket.default_value


def _texture(shader, name):
    """The image behind a socket, as a path or name; "" for none."""
    for link in shader.inputs[name].links:
        image = getattr(link.from_node, "image", None)
        if image is not None:
            return image.filepath.removeprefix("//") or image.name
    return ""
