// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Unity: plays what `anicodec export-vat --form basis` writes, in a Custom Function node of Shader Graph (name AnicodecBasis)
// or in a vertex shader. README.md of bindings/shaders says how to set it up.
#ifndef ANICODEC_BASIS_INCLUDED
#define ANICODEC_BASIS_INCLUDED

// Importers of glTF mirror x; 0 for one that does not.
#ifndef ANICODEC_MIRROR_X
#define ANICODEC_MIRROR_X 1
#endif

// Rows of textures count from the bottom in Unity, and from the top in the files.
float4 AnicodecFetch(Texture2D<float4> from, int x, int y)
{
    uint width, height;
    from.GetDimensions(width, height);
    return from.Load(int3(x, (int)height - 1 - y, 0));
}

float3 AnicodecWeight(Texture2D<float4> weights, float4 decoding, int columns, int column, int2 frames, float share)
{
    uint width, height;
    weights.GetDimensions(width, height);
    int rows = (int)height;
    float3 a = AnicodecFetch(weights, column + frames.x / rows * columns, frames.x % rows).xyz;
    float3 b = AnicodecFetch(weights, column + frames.y / rows * columns, frames.y % rows).xyz;
    return lerp(a, b, share) * decoding.z + decoding.w;
}

float3 AnicodecSum(Texture2D<float4> basis, Texture2D<float4> weights, float4 decoding, int rows, int columns, float2 uv,
                   int firstLayer, int layers, int column, int2 frames, float share)
{
    uint width, height;
    basis.GetDimensions(width, height);
    int2 place = int2(uv * float2((float)width, (float)rows));
    float3 sum = float3(0, 0, 0);
    for (int i = 0; i < layers; ++i)
    {
        float4 b = AnicodecFetch(basis, place.x, place.y + (firstLayer + i) * rows) * decoding.x + decoding.y;
        int first = column + 4 * i;
        sum += b.x * AnicodecWeight(weights, decoding, columns, first, frames, share);
        sum += b.y * AnicodecWeight(weights, decoding, columns, first + 1, frames, share);
        sum += b.z * AnicodecWeight(weights, decoding, columns, first + 2, frames, share);
        sum += b.w * AnicodecWeight(weights, decoding, columns, first + 3, frames, share);
    }
    return sum;
}

// position, normal: of the mesh, in object space. uv: its second texture coordinates. layout: rows, position_layers,
// normal_layers of NAME_basis.json; decoding: its basis_scale, basis_bias, weight_scale, weight_bias. clip: its
// first_frame, frame_count, rate and 1 for a loop. seconds: of the clip.
void AnicodecBasis(Texture2D<float4> basis, Texture2D<float4> weights, float3 position, float3 normal, float2 uv,
                   float3 layout, float4 decoding, float4 clip, float seconds, out float3 shownPosition, out float3 shownNormal)
{
    int rows = (int)layout.x, positionLayers = (int)layout.y, normalLayers = (int)layout.z;
    int columns = 2 + 4 * (positionLayers + normalLayers);
    int count = max((int)clip.y, 1);
    float at = max(seconds, 0.0) * clip.z;
    at = clip.w > 0.5 ? fmod(at, (float)count) : min(at, (float)(count - 1));
    int frame = min((int)at, count - 1);
    int next = clip.w > 0.5 ? (frame + 1) % count : min(frame + 1, count - 1);
    int2 frames = int2((int)clip.x + frame, (int)clip.x + next);
    float share = frac(at);
    uv.y = 1.0 - uv.y;
    float3 offset = AnicodecWeight(weights, decoding, columns, 0, frames, share) +
                    AnicodecWeight(weights, decoding, columns, 1, frames, share) +
                    AnicodecSum(basis, weights, decoding, rows, columns, uv, 0, positionLayers, 2, frames, share);
    float3 direction = normal;
    if (normalLayers > 0)
        direction = AnicodecSum(basis, weights, decoding, rows, columns, uv, positionLayers, normalLayers,
                                2 + 4 * positionLayers, frames, share);
#if ANICODEC_MIRROR_X
    offset.x = -offset.x;
    if (normalLayers > 0)
        direction.x = -direction.x;
#endif
    shownPosition = position + offset;
    shownNormal = normalize(direction);
}

// For Shader Graph, whose textures are structures.
#if defined(SHADERGRAPH_PREVIEW) || defined(UNIVERSAL_PIPELINE_CORE_INCLUDED) || defined(UNITY_COMMON_INCLUDED)
void AnicodecBasis_float(UnityTexture2D Basis, UnityTexture2D Weights, float3 Position, float3 Normal, float2 UV1, float3 Layout,
                         float4 Decoding, float4 Clip, float Seconds, out float3 ShownPosition, out float3 ShownNormal)
{
    AnicodecBasis(Basis.tex, Weights.tex, Position, Normal, UV1, Layout, Decoding, Clip, Seconds, ShownPosition, ShownNormal);
}
#endif

#endif
