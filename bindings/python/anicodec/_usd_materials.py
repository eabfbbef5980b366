# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Looks of materials, from and to UsdPreviewSurface."""
from __future__ import annotations

import os
import unicodedata
from typing import Any, Callable, Dict, Optional, Tuple

import numpy as np
from pxr import Gf, Sdf, Usd, UsdShade

from .material import Material
from ._usd_stage import identifier

_SURFACE, _TEXTURE, _READER = "UsdPreviewSurface", "UsdUVTexture", "UsdPrimvarReader_float2"
# Inputs that a look has, and other inputs with the values at which they mean nothing.
_KEPT = ("diffuseColor", "metallic", "roughness", "emissiveColor", "opacity", "opacityThreshold", "normal", "occlusion")
_PLAIN = {"useSpecularWorkflow": 0, "specularColor": Gf.Vec3f(0), "clearcoat": 0.0, "clearcoatRoughness": 0.01, "ior": 1.5,
          "displacement": 0.0, "opacityMode": "transparent"}


def _asset_path(text: str) -> Sdf.AssetPath:
    """OpenUSD takes no control characters in a path: replacement characters stand for them."""
    return Sdf.AssetPath("".join("\ufffd" if unicodedata.category(character) == "Cc" else character for character in text))


class _Surface:
    """The inputs of a surface shader: values, or the textures that they are connected to."""

    def __init__(self, shader: UsdShade.Shader, folder: str):
        self.shader, self._folder = shader, folder

    def value(self, name: str, default: Any) -> Any:
        found = self.shader.GetInput(name)
        held = [source.Get() for source in (UsdShade.Utils.GetValueProducingAttributes(found) if found else [])
                if not UsdShade.Utils.GetType(source.GetName()) == UsdShade.AttributeType.Output]
        return held[0] if held and held[0] is not None else default

    def texture(self, name: str) -> Tuple[str, str, Gf.Vec4f]:
        """Path, the output that is taken, and the factor; no path where there is none."""
        found = self.shader.GetInput(name)
        for source in UsdShade.Utils.GetValueProducingAttributes(found) if found else []:
            node = UsdShade.Shader(source.GetPrim())
            if UsdShade.Utils.GetType(source.GetName()) == UsdShade.AttributeType.Output and node.GetIdAttr().Get() == _TEXTURE:
                file, scale = _Surface(node, self._folder).value("file", None), _Surface(node, self._folder).value("scale", None)
                if isinstance(file, Sdf.AssetPath) and file.path:
                    return self._beside(file), UsdShade.Utils.GetBaseNameAndType(source.GetName())[0], Gf.Vec4f(scale or Gf.Vec4f(1))
        return "", "", Gf.Vec4f(1)

    def _beside(self, file: Sdf.AssetPath) -> str:
        """The path as from the stage: a layer below may have another folder."""
        if self._folder and os.path.isabs(file.resolvedPath) and os.path.exists(file.resolvedPath):
            return os.path.relpath(file.resolvedPath, self._folder).replace(os.sep, "/")
        return file.path


def read_look(material: UsdShade.Material, double_sided: bool, leave_out: Callable[[str], None]) -> Optional[Material]:
    """The look of a material; None where it has no UsdPreviewSurface. leave_out is told what a look has no place for."""
    shader = material.ComputeSurfaceSource()[0]
    if not shader or shader.GetIdAttr().Get() != _SURFACE:
        if shader or material.GetSurfaceOutputs():
            leave_out("values of materials")
        return None
    path = material.GetPrim().GetStage().GetRootLayer().realPath
    try:
        return _look_of(_Surface(shader, os.path.dirname(path)), double_sided, leave_out)
    except (TypeError, ValueError, IndexError):  # inputs of other types than those of UsdPreviewSurface
        leave_out(f"values of {material.GetPath()}, which are none of {_SURFACE}")
        return None


def _look_of(surface: _Surface, double_sided: bool, leave_out: Callable[[str], None]) -> Material:
    for given in surface.shader.GetInputs():
        name = given.GetBaseName()
        plain = _PLAIN.get(name)
        if name not in _KEPT and (given.HasConnectedSource() or plain is None or surface.value(name, plain) != plain):
            leave_out(f"'{name}' of materials")
    colour, _, colour_scale = surface.texture("diffuseColor")
    emitted, _, emitted_scale = surface.texture("emissiveColor")
    rough, rough_from, rough_scale = surface.texture("roughness")
    metal, metal_from, metal_scale = surface.texture("metallic")
    if (rough or metal) and not (rough == metal and (rough_from, metal_from) == ("g", "b")):
        leave_out("textures of 'roughness' and 'metallic' that are not one, in green and blue")
        rough = metal = ""
    seen_through = surface.texture("opacity")[0]
    opacity, cut = float(surface.value("opacity", 1)), float(surface.value("opacityThreshold", 0))
    if seen_through and seen_through != colour:
        leave_out("texture of 'opacity' of materials")
    base = colour_scale if colour else (*surface.value("diffuseColor", Gf.Vec3f(0.18)), opacity)
    look = Material(
        base_colour=tuple(map(float, base)), metallic=float(metal_scale[2] if metal else surface.value("metallic", 0)),
        roughness=float(rough_scale[1] if rough else surface.value("roughness", 0.5)),
        emissive=tuple(map(float, (emitted_scale if emitted else surface.value("emissiveColor", Gf.Vec3f(0)))[:3])),
        alpha="mask" if cut > 0 else "blend" if opacity < 1 or seen_through else "opaque",
        alpha_cutoff=cut if cut > 0 else 0.5, double_sided=double_sided, base_colour_texture=colour,
        metallic_roughness_texture=rough, normal_texture=surface.texture("normal")[0],
        occlusion_texture=surface.texture("occlusion")[0], emissive_texture=emitted)
    if not np.isfinite([*look.base_colour, look.metallic, look.roughness, *look.emissive, look.alpha_cutoff]).all():
        raise ValueError("not finite")
    return look


class LookWriter:
    """Writes materials of a stage, each once for all meshes below a root."""

    def __init__(self, stage: Usd.Stage):
        self._stage, self._scopes, self._found = stage, {}, {}  # type: ignore[var-annotated]

    def bind(self, prim: Usd.Prim, root: Sdf.Path, name: str, look: Optional[Material], uv: str) -> None:
        """uv: name of the texture coordinates."""
        if (root, name) not in self._found:
            self._found[root, name] = self._write(root, name, look, uv)
        UsdShade.MaterialBindingAPI.Apply(prim).Bind(self._found[root, name])

    def _free(self, parent: Sdf.Path, name: str) -> Sdf.Path:
        path, number = parent.AppendChild(name), 1
        while self._stage.GetPrimAtPath(path):
            path, number = parent.AppendChild(f"{name}_{number}"), number + 1
        return path

    def _write(self, root: Sdf.Path, name: str, look: Optional[Material], uv: str) -> UsdShade.Material:
        if root not in self._scopes:
            self._scopes[root] = self._free(root, "materials")
            self._stage.DefinePrim(self._scopes[root], "Scope")
        material = UsdShade.Material.Define(self._stage, self._free(self._scopes[root], identifier(name)))
        if look is not None:
            _write_surface(self._stage, material, look, uv)
        return material


def _write_surface(stage: Usd.Stage, material: UsdShade.Material, look: Material, uv: str) -> None:
    types = Sdf.ValueTypeNames
    path = material.GetPath()

    def shader(name: str, kind: str) -> UsdShade.Shader:
        made = UsdShade.Shader.Define(stage, path.AppendChild(name))
        made.CreateIdAttr(kind)
        return made

    surface = shader("surface", _SURFACE)
    made: Dict[str, UsdShade.Shader] = {}

    def textured(name: str, file: str, scale: Tuple[float, ...], raw: bool, links: Dict[str, Tuple[str, Any]]) -> None:
        if "st" not in made:
            made["st"] = shader("st", _READER)
            made["st"].CreateInput("varname", types.String).Set(uv)
            made["st"].CreateOutput("result", types.Float2)
        texture = shader(name, _TEXTURE)
        texture.CreateInput("file", types.Asset).Set(_asset_path(file))
        texture.CreateInput("st", types.Float2).ConnectToSource(made["st"].ConnectableAPI(), "result")
        texture.CreateInput("scale", types.Float4).Set(Gf.Vec4f(*scale))
        texture.CreateInput("sourceColorSpace", types.Token).Set("raw" if raw else "sRGB")
        if name == "normalTexture":  # from 0..1 to -1..1
            texture.CreateInput("bias", types.Float4).Set(Gf.Vec4f(-1, -1, -1, 0))
        for given, (output, kind) in links.items():
            texture.CreateOutput(output, types.Float3 if output == "rgb" else types.Float)
            surface.CreateInput(given, kind).ConnectToSource(texture.ConnectableAPI(), output)

    # A value beside a connection is what programs without textures show.
    surface.CreateInput("diffuseColor", types.Color3f).Set(Gf.Vec3f(*look.base_colour[:3]))
    surface.CreateInput("metallic", types.Float).Set(look.metallic)
    surface.CreateInput("roughness", types.Float).Set(look.roughness)
    surface.CreateInput("emissiveColor", types.Color3f).Set(Gf.Vec3f(*look.emissive))
    if look.alpha != "opaque":
        surface.CreateInput("opacity", types.Float).Set(look.base_colour[3])
    if look.alpha == "mask":
        surface.CreateInput("opacityThreshold", types.Float).Set(look.alpha_cutoff)
    if look.base_colour_texture:
        links = {"diffuseColor": ("rgb", types.Color3f), **({"opacity": ("a", types.Float)} if look.alpha != "opaque" else {})}
        textured("baseColourTexture", look.base_colour_texture, look.base_colour, False, links)
    if look.metallic_roughness_texture:
        textured("metallicRoughnessTexture", look.metallic_roughness_texture, (1, look.roughness, look.metallic, 1), True,
                 {"roughness": ("g", types.Float), "metallic": ("b", types.Float)})
    if look.normal_texture:
        textured("normalTexture", look.normal_texture, (2, 2, 2, 1), True, {"normal": ("rgb", types.Normal3f)})
    if look.occlusion_texture:
        textured("occlusionTexture", look.occlusion_texture, (1, 1, 1, 1), True, {"occlusion": ("r", types.Float)})
    if look.emissive_texture:
        textured("emissiveTexture", look.emissive_texture, (*look.emissive, 1), False, {"emissiveColor": ("rgb", types.Color3f)})
    surface.CreateOutput("surface", types.Token)
    material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
