#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""A scene of Blender as GLB, FBX, OBJ frames, PC2 and MDD, through encode and decode, and back into Blender.

usage: round_trip.py COMMAND WORK      exit status 77: skipped, for the reason printed
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
HERE = pathlib.Path(__file__).resolve().parent
FRAMES, RATE = 36, 25
# Inputs of encode, the output of decode, and whether the source has told the rate.
CASES = {
    "glb": (["scene.glb"], "glb_back.glb", True),
    "fbx": (["scene.fbx", "--clip", "Rig|Wave+Carrier|Carry"], "fbx_back.glb", True),
    "obj": (["frames/scene*.obj", "--fps", str(RATE)], "obj_back/frame_%04d.obj", False),
    "pc2": (["pc2.obj", "pc2.pc2", "--fps", str(RATE)], "pc2_back.pc2", False),
    "mdd": (["mdd.obj", "mdd.mdd"], "mdd_back.mdd", True),
}


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def run_blender(script, folder):
    result = subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", HERE / script, "--",
                             folder], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env={**os.environ, "PATH": "/usr/bin:/bin", "PYTHONDONTWRITEBYTECODE": "1"})
    if "No module named 'numpy'" in result.stdout:
        skip("Blender's Python has no numpy")
    return result


def there_and_back(command, folder, case):
    """A fault of encode or decode, or of what they say; none: nothing."""
    inputs, output, tells_rate = CASES[case]
    clip = f"{case}.anic"
    encoded = subprocess.run([command, "encode", *inputs, "-f", "-o", clip, "--json"], cwd=folder, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if encoded.returncode != 0:
        return encoded.stderr or encoded.stdout
    said = json.loads(encoded.stdout)
    print(f"{case}: {said['bytes']} bytes; {said.get('notes', [])}")
    if (said["frames"], said["fps"]) != (FRAMES, RATE):
        return f"{said['frames']} frames at {said['fps']} per second, not {FRAMES} at {RATE}"
    (folder / output).parent.mkdir(exist_ok=True)
    decoded = subprocess.run([command, "decode", clip, "-f", "-o", output], cwd=folder, text=True, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT)
    return decoded.stdout if decoded.returncode != 0 else None


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    command, folder = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    if not shutil.which("blender", path="/usr/bin:/bin"):
        skip("blender is not installed")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    made = run_blender("make_scene.py", folder)
    if made.returncode != 0:
        sys.exit(made.stdout[-4000:])
    faults = {case: fault for case in CASES if (fault := there_and_back(command, folder, case))}
    if faults:
        sys.exit("\n".join(f"{case}: {fault}" for case, fault in faults.items()))
    checked = run_blender("check_scene.py", folder)
    print(checked.stdout[-4000:])
    sys.exit(checked.returncode)


if __name__ == "__main__":
    main()
