# SPDX-License-Identifier: CC0-1.0
"""A file as a whole, in the order of chapter 12; 06, sections 11 and 13; 09a, section 8; 05, section 8."""
import math
from types import SimpleNamespace
import numpy as np
from . import chunks as records
from .attributes import MeshCorners, read_attributes, surface_of_entries
from .conventions import check, read_whole
from .entropy import RangeDecoder
from .pose import Corners
from .segments import Series, read_pose, read_segment
from .topology import VertexMap, read_face_map, read_faces

class Mesh:  # A mesh: its attributes, its order and its frames, of vertices in the user's order
    def __init__(self, number, counts, chunks, order, frames):
        record = read_whole(chunks.payload("MESH", number), records.MESH)
        self.name, self.faces, self.pose = record.name, read_faces(record.faces, counts), None
        polygons, self.triangles = self.faces.polygons, self.faces.triangles
        self.table, self.corners = Corners(counts.coded_vertices, self.triangles), MeshCorners(self.faces)
        self.attributes = []
        if counts.attributes:
            self.attributes, stream = records.read_attribute_records(chunks.payload("ATTR", number), counts)
            read_attributes(stream, self.faces, self.corners, self.attributes)
        vertices, places = list(range(counts.source_vertices)), [(p, 0) for p in range(counts.polygons)]
        if order != records.FREE:
            vertices = VertexMap(self.faces).read(chunks.payload("VMAP", number))
        if order == records.ALL:
            found = zip(*read_face_map(chunks.payload("FMAP", number), polygons), range(counts.polygons))
            places = [(p, turn) for _, turn, p in sorted(found)]
        # of each vertex, corner and polygon of the user the canonical one, by domain
        corners = [[self.corners.polygons[p][(turn + k) % n] for k in range(n)]
                   for p, turn, n in ((p, turn, len(polygons[p])) for p, turn in places)]
        self.order = vertices, [c for polygon in corners for c in polygon], [p for p, _ in places]
        user = {v: i for i, v in enumerate(vertices)}
        self.polygons = [[user[self.corners.vertex[c]] for c in polygon] for polygon in corners]
        self.coded = [self.faces.coded[v] for v in vertices]
        self.frames, self.boxes = np.full((frames, len(vertices), 3), np.nan, np.float32), [None] * frames
    def surface_of(self, number, pose):
        return surface_of_entries(self.attributes[number], self.faces, self.corners, pose)
    def copies(self, segment):
        """How many vertices, or elements of the attribute, each vertex of a segment stands for."""
        of = self.attributes[segment.attribute].entries if segment.moves_attribute else self.coded
        return np.bincount(of, minlength=segment.vertices).tolist()

def read_root(data, limi):
    """For each clip turn, moves and pivot of its frames, None where it has no motion apart."""
    roots = read_whole(data, records.ROOTS, clip_frames=limi.clip_frames, root_frames=limi.root_frames)
    decoder, result = RangeDecoder(roots.stream), []
    moves, turns = Series(decoder), Series(decoder)
    for root, frames in zip(roots.clips, limi.clip_frames):
        a, b = (moves.read(frames) if root.holds & 1 else [0] * frames for _ in range(2))
        t, pivot = turns.read(frames) if root.holds & 2 else [0] * frames, root.pivot or [0.0, 0.0]
        motion = np.array([t, a, b]).T * [root.turn_step or 0, root.step or 0, root.step or 0]
        in_binary32 = np.append(motion, [2 * x for x in pivot]).astype(np.float32)
        check(np.isfinite(in_binary32).all(), "NON_FINITE", "the motion of the whole")
        result.append([row + pivot for row in motion.tolist()] if root.holds else None)
    return decoder.end(result)

def move_whole(frame, motion, up):                      # Applies the motion of the whole to positions
    turn, move_a, move_b, pivot_a, pivot_b = motion
    axis_a, axis_b = (0, 1) if up == 2 else (2, 0)
    a, b, c, s = frame[:, axis_a] - pivot_a, frame[:, axis_b] - pivot_b, math.cos(turn), math.sin(turn)
    frame[:, axis_a], frame[:, axis_b] = pivot_a + move_a + c * a - s * b, pivot_b + move_b + s * a + c * b

def read_boxes(data, frames):                           # A box for each frame of a segment
    bounds = read_whole(data, records.BNDS, frames=frames)
    low, high, apart = np.array(bounds.low), np.array(bounds.high), np.array(bounds.boxes or [[0] * 6]) / 255
    boxes = np.hstack([low + (high - low) * apart[:, :3],
                       high + (low - high) * apart[:, 3:]]).astype(np.float32)
    return boxes[np.arange(frames) // (bounds.every or frames)].tolist()

def move_attribute(attribute, segment, positions, held, frames):
    """Adds what a segment makes to the values of an attribute in the frames that are held."""
    if attribute.moves is None:
        attribute.moves = np.repeat(attribute.values[None].astype(float), frames, 0)
    first, last = 3 * segment.triple, min(3 * segment.triple + 3, attribute.components)
    attribute.moves[held, :, first:last] += positions[:, attribute.entries, :last - first]

def decode(file):                                       # All that a file holds, checked
    chunks = records.Chunks(file)
    limi = records.read_limi(chunks.payload("LIMI"), file)
    records.check_limits(limi, file.size)
    clip = read_whole(chunks.payload("CLIP"), records.CLIPS, clip_frames=limi.clip_frames)
    chunks.check_places(limi, clip.order)
    frames, hashes, ends = sum(limi.clip_frames), [], np.cumsum([0] + limi.clip_frames)
    roots = read_root(chunks.payload("ROOT"), limi) if limi.root_frames else [None] * len(clip.clips)
    motions = [motion for root, count in zip(roots, limi.clip_frames) for motion in root or [None] * count]
    metadata = [records.read_metadata(data) for data in chunks.payloads("META")] + [None]
    meshes = [Mesh(m, counts, chunks, clip.order, frames) for m, counts in enumerate(limi.meshes)]
    for m, mesh in enumerate(meshes):
        for data in chunks.payloads("POSE", m):
            mesh.pose = read_pose(data, mesh)
    for segment in limi.segments:
        mesh, first, last = meshes[segment.mesh], segment.first_frame, segment.first_frame + segment.frames
        attribute = mesh.attributes[segment.attribute] if segment.moves_attribute else None
        check(not attribute or attribute.components and 3 * segment.triple < attribute.components and
              (attribute.domain, attribute.entry_count) == (segment.domain, segment.entries), "INDEX_RANGE",
              "an attribute")
        runs = [count for count in np.diff(ends.clip(first, last)).tolist() if count]
        positions, exact, found = read_segment(segment, mesh, chunks, runs)
        hashes += found
        if attribute:
            move_attribute(attribute, segment, positions, slice(first, last), frames)
            continue
        for frame, motion in zip(positions, motions[first:last]):
            if motion:
                move_whole(frame, motion, clip.up)
        mesh.frames[first:last] = (positions if exact is None else exact)[:, mesh.coded]
        for data in chunks.payloads("BNDS", segment.mesh, segment.number):
            mesh.boxes[first:last] = read_boxes(data, segment.frames)
    for stated, found in hashes:
        check(stated == found, "HASH")
    for chunk in chunks.all:
        chunk.payload()
    return SimpleNamespace(clip=clip, clip_frames=limi.clip_frames, roots=roots, meshes=meshes,
                           metadata=metadata[0])

def joined(parts):
    """The files of a stream as one clip: the first, with the frames of all and the promise that follows."""
    whole, clips = parts[0], [part.clip.clips[0] for part in parts]
    frames = [sum(part.clip_frames) for part in parts]
    if len(parts) == 1:
        return whole
    clip, squares = clips[0], sum(f * c.rmse**2 for f, c in zip(frames, clips))
    spread = sum(f * (100 * c.rmse / c.kg) ** 2 for f, c in zip(frames, clips) if c.kg)
    moves = [c.max_displacement_error for c in clips]
    moves += [a.max_error + b.max_error for a, b in zip(clips, clips[1:])]
    for name in ("max_error", "diagonal", "surface_error"):
        setattr(clip, name, max(getattr(c, name) or 0 for c in clips))
    clip.max_displacement_error, clip.rmse = max(moves), math.sqrt(squares / sum(frames))
    clip.kg = 100 * math.sqrt(squares / spread) if spread else 0
    clip.times, whole.clip_frames = None, [sum(frames)]
    for number, mesh in enumerate(whole.meshes):
        mesh.frames = np.concatenate([part.meshes[number].frames for part in parts])
        mesh.boxes = [box for part in parts for box in part.meshes[number].boxes]
    return whole
