// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// bindings/generate wrote this from the headers.

/** Statuses by number. */
export const STATUS = {
  1: 'ANIC_E_ARGUMENT', 2: 'ANIC_E_STATE', 3: 'ANIC_E_BUFFER_SIZE', 4: 'ANIC_E_FRAME_RANGE', 5: 'ANIC_E_ABSENT',
  10: 'ANIC_E_MAGIC', 11: 'ANIC_E_VERSION', 12: 'ANIC_E_FEATURE', 20: 'ANIC_E_TRUNCATED', 21: 'ANIC_E_HEADER',
  22: 'ANIC_E_HEADER_CHECKSUM', 23: 'ANIC_E_CHUNK_BOUNDS', 24: 'ANIC_E_CHUNK_CHECKSUM', 25: 'ANIC_E_CHUNK_DUPLICATE',
  26: 'ANIC_E_CHUNK_MISSING', 27: 'ANIC_E_CHUNK_UNKNOWN', 29: 'ANIC_E_TRAILING_BYTES', 30: 'ANIC_E_FILE_SIZE',
  40: 'ANIC_E_RECORD', 41: 'ANIC_E_ENTROPY', 42: 'ANIC_E_ZSTD', 43: 'ANIC_E_TOPOLOGY', 44: 'ANIC_E_INDEX_RANGE',
  45: 'ANIC_E_QUANTIZER', 46: 'ANIC_E_NON_FINITE', 47: 'ANIC_E_DRACO', 48: 'ANIC_E_SEGMENT', 49: 'ANIC_E_HASH',
  50: 'ANIC_E_MESHES', 51: 'ANIC_E_SEGMENT_MISSING', 60: 'ANIC_E_LIMIT', 70: 'ANIC_E_MEMORY', 71: 'ANIC_E_READ',
  72: 'ANIC_E_CANCELLED', 90: 'ANIC_E_INTERNAL',
};

// Words and their numbers.
export const SAMPLING = { step: 0, linear: 1, cubic: 2 };
export const WRAP = { clamp: 0, loop: 1, 'ping-pong': 2 };
export const SIDE = { any: 0, front: 1, back: 2 };

// Flags of opening.
export const OPEN_BOUNDS = 1;
export const OPEN_ANY_ORDER = 2;
export const OPEN_IN_PLACE = 4;
export const OPEN_INEXACT = 8;

// Structs, for Decoder.read(): bytes, and each field with its name, kind, place and count. A pointer is an address.
export const FAILURE = {
  size: 32, fields: [
    ['status', 'i32', 4], ['chunk', 'chars', 8], ['offset', 'u64', 16], ['detail', 'text', 24],
  ],
};
export const ASSET_INFO = {
  size: 176, fields: [
    ['name', 'text', 4], ['encoder', 'text', 8], ['meshes', 'u32', 12], ['segments', 'u32', 16], ['frames', 'u32', 20],
    ['rate', 'ratio', 24], ['up', [undefined, 'y', 'z'], 32], ['order', ['vertices', 'free', 'all'], 36],
    ['rateAssumed', 'bool', 40], ['uneven', 'bool', 41], ['loop', 'bool', 42], ['closedLoop', 'bool', 43],
    ['massaged', 'bool', 44], ['partial', 'bool', 45], ['startTime', 'f64', 48], ['duration', 'f64', 56],
    ['loopDuration', 'f64', 64], ['metresPerUnit', 'f64', 72], ['diagonal', 'f64', 80], ['maxError', 'f64', 88],
    ['rmse', 'f64', 96], ['kg', 'f64', 104], ['surfaceError', 'f64', 112], ['surfaceErrorMean', 'f64', 120],
    ['residentBytes', 'u64', 128], ['contextBytes', 'u64', 136], ['maxDisplacementError', 'f64', 144],
    ['origin', 'f64', 152, 3],
  ],
};
export const CLIP = {
  size: 112, fields: [
    ['name', 'text', 4], ['firstFrame', 'u32', 8], ['frames', 'u32', 12], ['rate', 'ratio', 16],
    ['rateAssumed', 'bool', 24], ['uneven', 'bool', 25], ['loop', 'bool', 26], ['closedLoop', 'bool', 27],
    ['massaged', 'bool', 28], ['isOpen', 'bool', 29], ['startTime', 'f64', 32], ['duration', 'f64', 40],
    ['loopDuration', 'f64', 48], ['diagonal', 'f64', 56], ['maxError', 'f64', 64], ['rmse', 'f64', 72],
    ['kg', 'f64', 80], ['surfaceError', 'f64', 88], ['surfaceErrorMean', 'f64', 96],
    ['maxDisplacementError', 'f64', 104],
  ],
};
export const EVENT = {
  size: 16, fields: [
    ['name', 'text', 4], ['seconds', 'f64', 8],
  ],
};
export const ROOT_MOTION = {
  size: 112, fields: [
    ['moves', 'bool', 4], ['turns', 'bool', 5], ['turn', 'f64', 8], ['move', 'f64', 16, 3], ['pivot', 'f64', 40, 3],
    ['matrix', 'f32', 64, 12],
  ],
};
export const MESH = {
  size: 32, fields: [
    ['name', 'text', 4], ['vertexCount', 'u32', 8], ['codedVertexCount', 'u32', 12], ['polygonCount', 'u32', 16],
    ['cornerCount', 'u32', 20], ['triangleCount', 'u32', 24], ['attributeCount', 'u32', 28],
  ],
};
export const POLYGONS = {
  size: 16, fields: [
    ['offsetsAt', 'u32', 4], ['cornersAt', 'u32', 8], ['polygonCount', 'u32', 12],
  ],
};
export const ATTRIBUTE = {
  size: 40, fields: [
    ['name', 'text', 4], ['kind', ['uv', 'normal', 'tangent', 'colour', 'custom', 'material', 'part'], 8],
    ['domain', ['vertices', 'corners', 'polygons'], 12], ['count', 'u32', 16], ['components', 'u32', 20],
    ['valuesAt', 'u32', 24], ['labelsAt', 'u32', 28], ['labelCount', 'u32', 32], ['moves', 'bool', 36],
  ],
};
export const MATERIAL = {
  size: 76, fields: [
    ['name', 'text', 4], ['baseColour', 'f32', 8, 4], ['metallic', 'f32', 24], ['roughness', 'f32', 28],
    ['emissive', 'f32', 32, 3], ['alpha', ['opaque', 'mask', 'blend'], 44], ['alphaCutoff', 'f32', 48],
    ['doubleSided', 'bool', 52], ['baseColourImage', 'text', 56], ['metallicRoughnessImage', 'text', 60],
    ['normalImage', 'text', 64], ['occlusionImage', 'text', 68], ['emissiveImage', 'text', 72],
  ],
};
export const BOX = {
  size: 24, fields: [
    ['min', 'f32', 0, 3], ['max', 'f32', 12, 3],
  ],
};
export const SURFACE_POINT = {
  size: 24, fields: [
    ['vertices', 'u32', 0, 3], ['weights', 'f32', 12, 3],
  ],
};
export const SURFACE_FRAME = {
  size: 36, fields: [
    ['position', 'f32', 0, 3], ['normal', 'f32', 12, 3], ['tangent', 'f32', 24, 3],
  ],
};
export const HIT = {
  size: 36, fields: [
    ['point', SURFACE_POINT, 0], ['distance', 'f32', 24], ['triangle', 'u32', 28],
    ['side', ['any', 'front', 'back'], 32],
  ],
};
export const RENDER_INFO = {
  size: 64, fields: [
    ['verticesAt', 'u32', 4], ['cornersAt', 'u32', 8], ['indicesAt', 'u32', 12], ['trianglePolygonsAt', 'u32', 16],
    ['groupMaterialsAt', 'u32', 20], ['groupBeginAt', 'u32', 24], ['mesh', 'u32', 28], ['vertexCount', 'u32', 32],
    ['triangleCount', 'u32', 36], ['groupCount', 'u32', 40], ['normalGroupCount', 'u32', 44],
    ['normalGroupsAt', 'u32', 48], ['normalCentresAt', 'u32', 52], ['normalBeginAt', 'u32', 56],
    ['normalCornersAt', 'u32', 60],
  ],
};
export const BASIS = {
  size: 104, fields: [
    ['kind', ['keyframes', 'eigenshapes', 'eigentrajectories'], 4], ['reconstruction', ['linear', 'msgi'], 8],
    ['target', ['positions', 'attribute'], 12], ['mesh', 'u32', 16], ['attribute', 'u32', 20],
    ['firstComponent', 'u32', 24], ['firstFrame', 'u32', 28], ['frameCount', 'u32', 32], ['vertexCount', 'u32', 36],
    ['components', 'u32', 40], ['wideComponents', 'u32', 44], ['channels', 'u32', 48], ['weightChannels', 'u32', 52],
    ['origin', 'f32', 56, 3], ['poseAt', 'u32', 68], ['wideAt', 'u32', 72], ['narrowAt', 'u32', 76],
    ['poseCount', 'u32', 80], ['wideCount', 'u32', 84], ['narrowCount', 'u32', 88], ['vertexShapeAt', 'u32', 92],
    ['regions', 'u32', 96], ['vertexRegionAt', 'u32', 100],
  ],
};
export const PART = {
  size: 120, fields: [
    ['segment', 'u32', 0], ['share', 'f32', 4], ['weightsAt', 'u32', 8], ['shapeAt', 'u32', 12],
    ['poseMap', 'f32', 16, 12], ['motion', 'f32', 64, 12], ['correctionsAt', 'u32', 112],
    ['correctionCount', 'u32', 116],
  ],
};
export const PARTS = {
  size: 520, fields: [
    ['count', 'u32', 4], ['parts', PART, 8, 4], ['components', 'u32', 488, 4], ['poseMapsAt', 'u32', 504, 4],
  ],
};
export const STREAM_INFO = {
  size: 56, fields: [
    ['receivedBytes', 'u64', 8], ['fileBytes', 'u64', 16], ['segmentCount', 'u32', 24], ['playableSegments', 'u32', 28],
    ['layers', 'u32', 32], ['arrivedLayers', 'u32', 36], ['playable', 'bool', 40], ['complete', 'bool', 41],
    ['fileNumber', 'u32', 44], ['waitingBytes', 'u64', 48],
  ],
};
