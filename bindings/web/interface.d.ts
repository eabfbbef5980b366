// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// bindings/generate wrote this from the headers.

/** The picture between two frames. Spec: 10, section 2. */
export type Sampling = 'step' | 'linear' | 'cubic';

/** The picture before the first frame and after the last one. */
export type Wrap = 'clamp' | 'loop' | 'ping-pong';

/** A side of triangles. */
export type Side = 'any' | 'front' | 'back';

/** Tells what was wrong with a file, and where. */
export interface Failure {
  readonly status: number;
  /** Type of the chunk: four characters and a 0; empty outside any chunk. */
  readonly chunk: string;
  /** Byte offset in the file, as exact as is known. */
  readonly offset: number;
  /** Static English text; may be empty, never NULL. */
  readonly detail: string;
}

/**
 * Name, clock and promise are those of clip 0: anic_get_clip() has those of each clip. Spec: 04 (time, coordinates,
 * promise), 06 section 3. Strings belong to the asset.
 */
export interface AssetInfo {
  readonly name: string;
  readonly encoder: string;
  readonly meshes: number;
  readonly segments: number;
  /** Frames of all clips. */
  readonly frames: number;
  /** Frames per second = numerator / denominator; a hint if `uneven`. */
  readonly rate: number;
  readonly up: undefined | 'y' | 'z';
  readonly order: 'vertices' | 'free' | 'all';
  /** The source told no rate. */
  readonly rateAssumed: boolean;
  /** Frames have a table of times: anic_get_frame_time(). */
  readonly uneven: boolean;
  /** Meant to be played with ANIC_WRAP_LOOP. */
  readonly loop: boolean;
  /** The last frame repeats the first. */
  readonly closedLoop: boolean;
  /** The mesh was changed before coding: see surface_error. */
  readonly massaged: boolean;
  /** Made from a stream that was not complete: parts are missing or coarser. */
  readonly partial: boolean;
  /** Time of frame 0 on the source's clock, seconds: for tools alone. Times in this interface count from frame 0. */
  readonly startTime: number;
  /** From frame 0 to the last frame, seconds. */
  readonly duration: number;
  /** One turn of ANIC_WRAP_LOOP, seconds. */
  readonly loopDuration: number;
  /** 0: unknown. */
  readonly metresPerUnit: number;
  /** Diagonal of the box around all frames of the source. */
  readonly diagonal: number;
  /**
   * Largest distance of a vertex from its place in the source, at full quality, as the encoder measured it; in units of
   * the clip.
   */
  readonly maxError: number;
  /** Root of the mean squared error, in units of the clip. */
  readonly rmse: number;
  /** KG error, per cent. */
  readonly kg: number;
  /** Largest distance from the source's surface, in units of the clip. */
  readonly surfaceError: number;
  /** Mean distance from it. */
  readonly surfaceErrorMean: number;
  /** Held by this asset. */
  readonly residentBytes: number;
  /** Held by each context. */
  readonly contextBytes: number;
  /** Largest error of a vertex's move from frame to frame. */
  readonly maxDisplacementError: number;
  /**
   * Origin of the positions of this interface, as the source has it: added in double, it gives the source's coordinates,
   * which may be too far from zero for float32.
   */
  readonly origin: [number, number, number];
}

/**
 * A clip: frames first_frame .. first_frame + frame_count - 1 of the file, with a clock and a promise of their own. The
 * string belongs to the asset. Spec: 04, 06 section 3.
 */
export interface NamedClip {
  readonly name: string;
  readonly firstFrame: number;
  readonly frames: number;
  /** As in anic_asset_info, and so are those that follow. */
  readonly rate: number;
  readonly rateAssumed: boolean;
  readonly uneven: boolean;
  readonly loop: boolean;
  readonly closedLoop: boolean;
  readonly massaged: boolean;
  /** The host asked for it: see anic_options.clips. */
  readonly isOpen: boolean;
  readonly startTime: number;
  readonly duration: number;
  readonly loopDuration: number;
  /** Diagonal of the box around its frames of the source. */
  readonly diagonal: number;
  readonly maxError: number;
  readonly rmse: number;
  readonly kg: number;
  readonly surfaceError: number;
  readonly surfaceErrorMean: number;
  readonly maxDisplacementError: number;
}

/** A named time of a clip. The string belongs to the asset. */
export interface NamedTime {
  readonly name: string;
  /** From the clip's first frame on, 0 or more. */
  readonly seconds: number;
}

/**
 * The motion of the whole at a time: a turn about the up axis through the pivot, then a move along the ground, both from
 * where the clip was before. No motion where the clip has none apart. Spec: 06, section 11.
 */
export interface RootMotion {
  /** The clip holds moves, or a blended clip does. */
  readonly moves: boolean;
  /** The same of turns. */
  readonly turns: boolean;
  /** Radians, counter-clockwise seen from above; whole turns count. */
  readonly turn: number;
  readonly move: [number, number, number];
  readonly pivot: [number, number, number];
  /** The same as one map, 3 x 4, row-major: from positions without root motion (ANIC_OPEN_IN_PLACE) to positions with it. */
  readonly matrix: number[];
}

/** A mesh. The string belongs to the asset. */
export interface MeshInfo {
  readonly name: string;
  /** Vertices of the source, each once. */
  readonly vertexCount: number;
  /** Distinct vertices: the others are copies that move along. */
  readonly codedVertexCount: number;
  readonly polygonCount: number;
  /** Corners of all polygons. */
  readonly cornerCount: number;
  /** After anic_write_indices() has cut the polygons. */
  readonly triangleCount: number;
  /** Anic_get_attribute(). */
  readonly attributeCount: number;
}

/** Polygons as in the source. The arrays belong to the asset. */
export interface Polygons {
  /** Polygon p has the corners offsets[p] .. offsets[p + 1] - 1. */
  readonly offsetsAt: number;
  /** Vertex of each corner. */
  readonly cornersAt: number;
  readonly polygonCount: number;
}

/** An attribute, as in frame 0. Strings and arrays belong to the asset. */
export interface AttributeInfo {
  /** As in the source, may be empty. */
  readonly name: string;
  readonly kind: 'uv' | 'normal' | 'tangent' | 'colour' | 'custom' | 'material' | 'part';
  readonly domain: 'vertices' | 'corners' | 'polygons';
  /** Elements: vertices, corners or polygons. */
  readonly count: number;
  /** Numbers of an element; 0: it has `labels`. */
  readonly components: number;
  /** Count x components; NULL without components. */
  readonly valuesAt: number;
  /**
   * Count; NULL with components. A polygon has 0 for none, or one more than the number of a name. Corners at a vertex with
   * the same label share a value.
   */
  readonly labelsAt: number;
  /** Names of labels: anic_get_label_name(). */
  readonly labelCount: number;
  /** Other frames have other values, for which there is anic_write_attribute(). */
  readonly moves: boolean;
}

/**
 * The look of a material, in the terms of glTF 2.0 (metallic and roughness). Textures are paths or names as in the source,
 * never NULL, empty if there is none: images are not in the file. Strings belong to the asset. Spec: 06, section 10.
 */
export interface Look {
  readonly name: string;
  /** Linear RGBA; a texture's colour is multiplied by it. */
  readonly baseColour: [number, number, number, number];
  /** 0 to 1. */
  readonly metallic: number;
  /** 0 to 1. */
  readonly roughness: number;
  /** Linear RGB, 0 and more. */
  readonly emissive: [number, number, number];
  readonly alpha: 'opaque' | 'mask' | 'blend';
  readonly alphaCutoff: number;
  readonly doubleSided: boolean;
  readonly baseColourImage: string;
  /** Roughness in green, metallic in blue. */
  readonly metallicRoughnessImage: string;
  readonly normalImage: string;
  readonly occlusionImage: string;
  readonly emissiveImage: string;
}

/** An axis-aligned box. */
export interface Box {
  readonly min: [number, number, number];
  readonly max: [number, number, number];
}

/** A point of a mesh's surface: vertices of a triangle, and barycentric coordinates in it. */
export interface SurfacePoint {
  /** In the order of the triangle, counter-clockwise seen from its front. */
  readonly vertices: [number, number, number];
  /** Weights of the vertices; their sum is 1. */
  readonly weights: [number, number, number];
}

/** Axes at a point of the surface, of length 1; the third one is normal x tangent. */
export interface SurfaceFrame {
  readonly position: [number, number, number];
  /** Normal of the triangle, on its front. */
  readonly normal: [number, number, number];
  /** From the triangle's first vertex to the second one. */
  readonly tangent: [number, number, number];
}

/** The first point of the surface on a ray. */
export interface Hit {
  readonly point: SurfacePoint;
  /** From the origin, in lengths of the ray's direction; infinite: none was hit. */
  readonly distance: number;
  /** Its number in the list; UINT32_MAX: none was hit. */
  readonly triangle: number;
  /** That the ray meets: ANIC_SIDE_FRONT or ANIC_SIDE_BACK. */
  readonly side: 'any' | 'front' | 'back';
}

/** Contents of a plan. The arrays belong to it. */
export interface RenderInfo {
  /** Vertex of each render vertex, ascending: every value of a vertex is found by it. */
  readonly verticesAt: number;
  /** a corner of each render vertex: every value of a corner is found by it. NULL in a mesh without corners. */
  readonly cornersAt: number;
  /**
   * Triangle_count x 3 render vertices; polygons are cut as by anic_write_indices(), in the reference frame, ordered by
   * material.
   */
  readonly indicesAt: number;
  /** Polygon of each triangle. */
  readonly trianglePolygonsAt: number;
  /** For each group the label of its polygons' material, ascending: 0 for none, or one more than the number of a name. */
  readonly groupMaterialsAt: number;
  /** Group g has the triangles begin[g] .. begin[g + 1] - 1; the groups follow one another and hold all triangles. */
  readonly groupBeginAt: number;
  readonly mesh: number;
  /** Number of render vertices. */
  readonly vertexCount: number;
  readonly triangleCount: number;
  /** One for each material that has a triangle. */
  readonly groupCount: number;
  readonly normalGroupCount: number;
  /** Group of each render vertex. */
  readonly normalGroupsAt: number;
  /** a render vertex of each group. */
  readonly normalCentresAt: number;
  /** Group g has the corners begin[g] .. begin[g + 1] - 1. */
  readonly normalBeginAt: number;
  /** Render vertices after and before each corner. */
  readonly normalCornersAt: number;
}

/**
 * The basis of a segment, to be uploaded once. The arrays belong to the asset. With b = v / 16 and i = v % 16: -
 * pose(v)[c] = pose[(b * 3 + c) * 16 + i] - basis(j, v)[c] = wide[((b * wide_components + j) * channels + c) * 16 + i] for
 * j below wide_components - basis(j, v)[c] = narrow[((b * n + j - wide_components) * channels + c) * 16 + i] for the other
 * j, with n = components - wide_components Zeros fill the last block behind the last vertex. Spec: 09a, sections 1 and 5.
 */
export interface Basis {
  readonly kind: 'keyframes' | 'eigenshapes' | 'eigentrajectories';
  readonly reconstruction: 'linear' | 'msgi';
  readonly target: 'positions' | 'attribute';
  readonly mesh: number;
  /** For ANIC_TARGET_ATTRIBUTE: its number. The x of anic_part is to be added to anic_attribute.values. */
  readonly attribute: number;
  /** For ANIC_TARGET_ATTRIBUTE: the basis moves this component and the two after it, if the attribute has them. */
  readonly firstComponent: number;
  readonly firstFrame: number;
  readonly frameCount: number;
  readonly vertexCount: number;
  readonly components: number;
  readonly wideComponents: number;
  /** 3: basis(j, v) is a vector, with one weight; 1: it is a number, with a weight for each of x, y, z. */
  readonly channels: number;
  /** Weights of a component: 1 for vectors, 3 for numbers. */
  readonly weightChannels: number;
  /** For ANIC_BASIS_KEYFRAMES: added to every vertex before the motion. */
  readonly origin: [number, number, number];
  /** NULL: none. */
  readonly poseAt: number;
  readonly wideAt: number;
  readonly narrowAt: number;
  /** Elements of the arrays. */
  readonly poseCount: number;
  readonly wideCount: number;
  readonly narrowCount: number;
  /** With ANIC_RECONSTRUCTION_MSGI: the point of the shape that each vertex is; NULL: vertex v is point v. */
  readonly vertexShapeAt: number;
  /** Regions of the surface, each with its weights and pose_map; 1: none. At most ANIC_MAX_REGIONS. */
  readonly regions: number;
  /** Region of each vertex, below `regions`; NULL: all are of region 0. */
  readonly vertexRegionAt: number;
}

/**
 * Data that a shader needs for one time, beside the basis of a segment: - x = pose_map * (pose(v), 1) + sum over j of
 * weights[j * weight_channels + c] * basis(j, v)[c] - x = motion * (x + origin, 1) - x = x + delta of the corrections of
 * v, which are few and ascending by vertex With one channel, basis(j, v) is multiplied by each of the three weights. If
 * the basis has regions, r = vertex_region[v] has the pose_map at anic_parts.pose_maps + 12 r and the weights from weights
 * + r * anic_basis.components * weight_channels on. With ANIC_RECONSTRUCTION_MSGI the first line and the origin give way
 * to x = shape(vertex_shape(v)), three floats for each point, which the seek has made. Matrices are 3 x 4, row-major.
 * Pointers are good until the next but one seek of the context.
 */
export interface Part {
  readonly segment: number;
  /** The position is the sum of share * x over the parts. */
  readonly share: number;
  /** Weights of region 0, then of the others. */
  readonly weightsAt: number;
  /** NULL with ANIC_RECONSTRUCTION_LINEAR. */
  readonly shapeAt: number;
  /** Map of region 0. */
  readonly poseMap: number[];
  readonly motion: number[];
  readonly correctionsAt: number;
  readonly correctionCount: number;
}

/** The parts of one time. */
export interface Parts {
  readonly count: number;
  readonly parts: [Part, Part, Part, Part];
  /** For each part: how many weights are to be used, all unless anic_set_quality() said otherwise. */
  readonly components: [number, number, number, number];
  /** For each part: pose_map of each region, 12 numbers each; NULL: the basis has no pose. */
  readonly poseMapsAt: [number, number, number, number];
}

/** How much of a file has arrived, in a live stream of the one at hand. */
export interface StreamInfo {
  readonly receivedBytes: number;
  /** 0 while the header is not there. */
  readonly fileBytes: number;
  /** 0 while the head is not there. */
  readonly segmentCount: number;
  /** Segments that can be opened, coarsely at least. */
  readonly playableSegments: number;
  /** Chunks with components of the bases of all segments. */
  readonly layers: number;
  readonly arrivedLayers: number;
  /**
   * Anic_open_asset_from_stream() gives an asset that plays at least one segment of positions, by its base while
   * arrived_layers is 0.
   */
  readonly playable: boolean;
  readonly complete: boolean;
  /** In a live stream, from 0 on. */
  readonly fileNumber: number;
  /** That follow the file: they are of the next ones of a live stream. */
  readonly waitingBytes: number;
}
