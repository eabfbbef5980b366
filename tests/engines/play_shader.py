#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compiles the shader of the SDK in each of its languages by glslang. The crowd example and the plug-in for OGRE run it.

usage: play_shader.py CHECKOUT WORK      exit status 77: skipped, for the reason printed
"""
import pathlib
import shutil
import subprocess
import sys

import drawing

UNIFORMS = """uniform highp isampler2D narrow, wide;
uniform highp sampler2D pose, state;
#define ANIC_STATE(i) texelFetch(state, ivec2(i, 0), 0)
"""
MAIN = """void main() {
  AnicSegment s = AnicSegment(0, 0, -1, 64, 2, true, 1, 9);
  gl_Position = vec4(anic_part(narrow, wide, pose, s, gl_VertexID, 0), 1.0);
}
"""
TEXTURES = """#define ANIC_HLSL
Texture2D<int4> narrow, wide;
Texture2D<float4> pose, state;
#define ANIC_STATE(i) state.Load(int3(i, 0, 0))
"""
ENTRY = """float4 main(uint id : SV_VertexID) : SV_Position {
  AnicSegment s = {0, 0, -1, 64, 2, true, 1, 9};
  return float4(anic_part(narrow, wide, pose, s, int(id), 0), 1.0);
}
"""


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    checkout, work = (pathlib.Path(path) for path in sys.argv[1:])
    if not shutil.which("glslangValidator"):
        drawing.skip("there is no glslangValidator (Debian: glslang-tools)")
    work.mkdir(parents=True, exist_ok=True)
    shader = (checkout / "sdk" / "shaders" / "anicodec_play.glsl").read_text(encoding="utf-8")
    precision = "precision highp float;\nprecision highp int;\n"
    texts = {"core.vert": f"#version 330 core\n{UNIFORMS}{shader}{MAIN}",
             "es.vert": f"#version 300 es\n{precision}{UNIFORMS}{shader}{MAIN}",
             "play.hlsl": f"{TEXTURES}{shader}{ENTRY}"}
    for name, text in texts.items():
        (work / name).write_text(text, encoding="utf-8")
        hlsl = ("-D", "-V", "-e", "main", "-o", work / "play.spv") if name.endswith(".hlsl") else ()
        command = ["glslangValidator", *hlsl, "-S", "vert", work / name]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            sys.exit(f"{name}:\n{result.stdout}{result.stderr}")


if __name__ == "__main__":
    main()
