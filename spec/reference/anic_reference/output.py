# SPDX-License-Identifier: CC0-1.0
"""What tests/conformance/README.md wants of a decoder: OUT.pc2, OUT.obj and OUT.json. A live stream is one clip."""
import json
import math
import struct
import numpy as np

LOOK_FIELDS = ('base_colour', 'metallic', 'roughness', 'emissive')


def text(data):
    """json.dump writes what is not printable ASCII as \\u00XX."""
    return data.decode('latin-1')


def frames_of(file, m):
    """Positions of mesh m in all frames, float32 [frame, vertex, axis]; not a number where the mesh is not there."""
    x = np.full((file.limi.frames, file.meshes[m].source, 3), np.nan, np.float32)
    for s, part in enumerate(file.limi.segments):
        if part.mesh == m and not part.moves_attribute:
            for f in range(part.frames):
                x[part.first + f] = file.source_positions(s, f)
    return x


def boxes_of(file, m):
    boxes, some = [None] * file.limi.frames, False
    for s, part in enumerate(file.limi.segments):
        if part.mesh == m and s in file.boxes:
            some = True
            for f in range(part.frames):
                low, high = file.box(s, f)
                boxes[part.first + f] = [float(x) for x in low] + [float(x) for x in high]
    return boxes if some else None


def look_of(look):
    if look.flags == 0:
        return None
    fields = {name: getattr(look, name) for name in LOOK_FIELDS}
    fields.update(alpha=look.flags >> 2, double_sided=bool(look.flags & 2),
                  alpha_cutoff=0.5 if look.alpha_cutoff is None else look.alpha_cutoff,
                  textures=[text(look.images.get(i, b'')) for i in range(5)])
    return fields


def attribute_of(files, m, k):
    file = files[0]
    mesh = file.meshes[m]
    a = mesh.attributes[k]
    vertices = mesh.order
    corners = [c for line in mesh.corner_order for c in line]
    elements = (vertices, corners, mesh.polygon_order)[a.domain]
    told = {'kind': a.kind, 'domain': a.domain, 'components': a.components, 'name': text(a.name),
            'labels': [text(x) for x in a.labels], 'looks': [look_of(x) for x in a.looks or []], 'groups': [],
            'moves': any(s.mesh == m and s.attribute == k for f in files for s in f.limi.segments), 'values': [[]]}
    if a.kind >= 5 or a.components == 0:
        told['groups'] = [(a.label_of if a.kind >= 5 else a.entry_of)[e] for e in elements]
        return told
    told['values'] = []
    for file in files if told['moves'] else files[:1]:
        for f in range(file.limi.frames if told['moves'] else 1):
            values = a.values[elements].astype(np.float64)
            for s, part in enumerate(file.limi.segments):
                if part.mesh == m and part.attribute == k and part.first <= f < part.first + part.frames:
                    c = 3 * part.triple
                    moves = file.source_positions(s, f - part.first)[elements]
                    n = min(3, a.components - c)
                    values[:, c:c + n] += moves[:, :n]
            told['values'].append(values.astype(np.float32).ravel().tolist())
    return told


def clip_of(c, start, root):
    rate = c.rate
    told = {'name': text(c.name), 'frames': c.frames, 'rate': list(rate), 'rate_assumed': bool(c.flags & 1),
            'start_time': c.start_time, 'times': c.times or [f * rate[1] / rate[0] for f in range(c.frames)],
            'loop': bool(c.flags & 2), 'closed': bool(c.flags & 4), 'massaged': bool(c.flags & 8), 'asked': c.asked,
            'asked_value': c.asked_value if c.asked else 0, 'attribute_errors': [list(e) for e in c.errors],
            'surface_error': getattr(c, 'surface_error', 0), 'surface_error_mean': getattr(c, 'surface_error_mean', 0)}
    told.update({name: getattr(c, name) for name in ('max_error', 'rmse', 'kg', 'max_displacement_error', 'diagonal')})
    if c.events:
        told['events'] = [[text(name), seconds] for name, seconds in c.events]
    if root and root.frames[start] is not None:
        told['root'] = [[t, a, b, *pivot] for pivot, a, b, t in root.frames[start:start + c.frames]]
    return told


def joined_clip(clips):
    """Promise of a stream's files put together (05, section 8)."""
    told = dict(clips[0])
    frames = [c['frames'] for c in clips]
    told['frames'] = sum(frames)
    told['times'] = [f * told['rate'][1] / told['rate'][0] for f in range(sum(frames))]     # of an even clip
    for name in ('max_error', 'diagonal', 'surface_error'):
        told[name] = max(c[name] for c in clips)
    squares = [f * c['rmse'] ** 2 for f, c in zip(frames, clips)]
    told['rmse'] = math.sqrt(sum(squares) / sum(frames))
    sizes = sum(f * (100 * c['rmse'] / c['kg']) ** 2 for f, c in zip(frames, clips) if c['kg'])
    told['kg'] = 100 * math.sqrt(sum(squares) / sizes) if sizes else 0
    between = [a['max_error'] + b['max_error'] for a, b in zip(clips, clips[1:])]
    told['max_displacement_error'] = max([c['max_displacement_error'] for c in clips] + between)
    return told


def write(files, out):
    first = files[0]
    told = {'encoder': text(first.clip.encoder), 'up': first.clip.up, 'order': first.clip.order,
            'metres_per_unit': first.clip.metres_per_unit, 'clips': [], 'meshes': []}
    for file in files:
        start = 0
        for c in file.clip.clips:
            told['clips'].append(clip_of(c, start, file.root))
            start += c.frames
    if len(files) > 1:
        told['clips'] = [joined_clip(told['clips'])]
    if any(first.clip.origin):
        told['origin'] = first.clip.origin
    if first.container.has('META'):
        told['metadata'] = json.loads(first.container.chunk('META'))
    for m, mesh in enumerate(first.meshes):
        x = np.concatenate([frames_of(file, m) for file in files])
        stem = out if m == 0 else '%s.%d' % (out, m)
        with open(stem + '.pc2', 'wb') as f:
            f.write(struct.pack('<12siiffi', b'POINTCACHE2\0', 1, mesh.source, 0, 1, len(x)))
            f.write(x.astype('<f4').tobytes())
        with open(stem + '.obj', 'w', encoding='ascii') as f:
            f.writelines('f ' + ' '.join(str(v + 1) for v in p) + '\n' for p in mesh.user_polygons)
        there = x[~np.isnan(x[:, 0, 0])]
        entry = {'name': text(mesh.name), 'low': there.min((0, 1)).tolist(), 'high': there.max((0, 1)).tolist(),
                 'attributes': [attribute_of(files, m, k) for k in range(len(mesh.attributes))]}
        boxes = [boxes_of(file, m) for file in files]
        if any(boxes):
            entry['boxes'] = [b for line, file in zip(boxes, files) for b in line or [None] * file.limi.frames]
        told['meshes'].append(entry)
    with open(out + '.json', 'w', encoding='ascii') as f:
        json.dump(told, f)
