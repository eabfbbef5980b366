#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# ufbx 0.21.2 (source package of pyufbx 0.0.7): layers of two takes in one animation.
#
# FBX takes are often made for one object each (Blender's exports: "Rig|Wave", "Carrier|Carry"), and programs play several at once.
# ufbx_create_anim() takes layers of any takes. The first of them sets properties; each that follows is blended by its own
# BlendMode, additive where the file states none, also if no layer before it moves the property: what the take says is
# then added to the value that the node has at rest, and scales are multiplied. A node of scale 100, which a take holds at 100, has scale
# 10,000 behind the layer of another take, and 100 by itself.
#
# Output seen: "alone 100, behind another take 10000". Exit status 1 if it is another.
# Way out: clear `blended` and `additive` of the first layer of each take.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv pip >/dev/null
pip/bin/pip download --quiet --disable-pip-version-check --no-deps --no-binary pyufbx pyufbx==0.0.7
tar xf pyufbx-0.0.7.tar.gz
source=$(dirname "$(find . -name ufbx.c)")

python3 - <<'P'
curve = """AnimationCurve: {id}, "AnimCurve::", "" {{
KeyVer: 4008
KeyTime: *1 {{
a: 0
}}
KeyValueFloat: *1 {{
a: 100
}}
KeyAttrFlags: *1 {{
a: 4
}}
KeyAttrDataFloat: *4 {{
a: 0,0,0,0
}}
KeyAttrRefCount: *1 {{
a: 1
}}
}}
"""
objects, connections = "", ""
for node in (1, 2):
    objects += f'Model: {node}, "Model::node{node}", "Null" {{\nProperties70:  {{\nP: "Lcl Scaling", "", "", "A",100,100,100\n}}\n}}\n'
    connections += f'C: "OO",{node},0\n'
    stack, layer, value = 10 * node, 10 * node + 1, 10 * node + 2
    objects += f'AnimationStack: {stack}, "AnimStack::take{node}", "" {{\n}}\nAnimationLayer: {layer}, "AnimLayer::L", "" {{\n}}\n'
    objects += f'AnimationCurveNode: {value}, "AnimCurveNode::S", "" {{\n}}\n'
    connections += f'C: "OO",{layer},{stack}\nC: "OO",{value},{layer}\nC: "OP",{value},{node}, "Lcl Scaling"\n'
    for k, axis in enumerate("XYZ"):
        objects += curve.format(id=100 * node + k)
        connections += f'C: "OP",{100 * node + k},{value}, "d|{axis}"\n'
open("takes.fbx", "w").write("; FBX 7.3.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: 7300\n}\n"
                             f"Objects:  {{\n{objects}}}\nConnections:  {{\n{connections}}}\n")
P

cat >scale.c <<'C'
#include "ufbx.h"

#include <stdio.h>

static double scale_of(const ufbx_scene *scene, const uint32_t *layers, size_t count) {
  ufbx_anim_opts options = {0};
  options.layer_ids.data = layers;
  options.layer_ids.count = count;
  ufbx_anim *anim = ufbx_create_anim(scene, &options, NULL);
  const ufbx_transform t = ufbx_evaluate_transform(anim, ufbx_find_node(scene, "node2"), 0);
  ufbx_free_anim(anim);
  return t.scale.x;
}

int main(void) {
  ufbx_scene *scene = ufbx_load_file("takes.fbx", NULL, NULL);
  if (!scene || scene->anim_stacks.count != 2)
    return 1;
  const uint32_t both[2] = {scene->anim_stacks.data[0]->layers.data[0]->typed_id,
                            scene->anim_stacks.data[1]->layers.data[0]->typed_id};
  printf("alone %g, behind another take %g\n", scale_of(scene, both + 1, 1), scale_of(scene, both, 2));
  ufbx_free_scene(scene);
  return 0;
}
C
cc -O1 -I "$source" scale.c "$source/ufbx.c" -lm -o scale
seen=$(./scale)
echo "$seen"
[[ $seen == "alone 100, behind another take 10000" ]]
