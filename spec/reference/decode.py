# SPDX-License-Identifier: CC0-1.0
"""decode.py [--stream] FILE [-o OUT]: decodes a file whole and checks it.

With OUT writes OUT.pc2, OUT.obj and OUT.json, as the conformance files want.
Else prints a line for each clip and mesh, and exits with 0; or prints the status of chapter 12 and exits with its
number.
"""
import sys
from anic_reference.common import AnicError, xxh64
from anic_reference.decoder import File, stream_files
from anic_reference.output import write


def show(file):
    for i, c in enumerate(file.clip.clips):
        print('clip %d: %r, %d frames, rate %d/%d' % (i, c.name, c.frames, *c.rate))
    for i, m in enumerate(file.meshes):
        print('mesh %d: %r, %d vertices, %d coded, %d polygons, %d attributes' % (
            i, m.name, m.source, m.coded, len(m.user_polygons), len(m.attributes)))
    for i, s in enumerate(file.segments):
        first = file.source_positions(i, 0)
        part = s.limits
        print('segment %d: mesh %d, kind %d, frames %d + %d, %d components, hash %016x, first frame %016x' % (
            i, part.mesh, part.kind, part.first, part.frames, part.components, s.segm.hash, xxh64(first.tobytes())))
    for i in file.boxes:
        if not file.boxes_hold(i):
            print('segment %d: positions lie outside of the boxes of BNDS' % i)


def main(arguments):
    out = arguments.pop(arguments.index('-o') + 1) if '-o' in arguments else None
    name = next(a for a in arguments if not a.startswith('-'))
    with open(name, 'rb') as f:
        data = f.read()
    try:
        files = list(stream_files(data)) if '--stream' in arguments else [File(data)]
    except AnicError as error:
        print('%s %d %s' % (error.name, error.code, error.detail))
        return error.code
    except MemoryError:
        print('MEMORY 70')
        return 70
    if out:
        write(files, out)
    else:
        for file in files:
            show(file)
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
