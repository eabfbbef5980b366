// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;
using UnityEngine;
using UnityEngine.Rendering;

namespace Anicodec.Unity
{
    /// <summary>Makes a Mesh of a clip's mesh. Stream 0 holds positions and normals, stream 1 what never moves.</summary>
    public static class AnicMesh
    {
        /// <summary>Floats of a vertex of stream 0.</summary>
        public const int Floats = 6;

        private const MeshUpdateFlags Unchecked = MeshUpdateFlags.DontValidateIndices | MeshUpdateFlags.DontResetBoneBounds |
            MeshUpdateFlags.DontNotifyMeshUsers | MeshUpdateFlags.DontRecalculateBounds;

        /// <summary>A mesh with one submesh for each material, in the first frame that shows it.</summary>
        public static unsafe Mesh Create(AnicClip clip, int index, string name)
        {
            RenderPlan plan = clip.Plan(index);
            int count = plan.VertexCount, triangles = plan.TriangleCount;
            Mesh mesh = new Mesh { name = name };
            mesh.SetVertexBufferParams(count,
                new VertexAttributeDescriptor(VertexAttribute.Position, VertexAttributeFormat.Float32, 3, 0),
                new VertexAttributeDescriptor(VertexAttribute.Normal, VertexAttributeFormat.Float32, 3, 0),
                new VertexAttributeDescriptor(VertexAttribute.TexCoord0, VertexAttributeFormat.Float32, 2, 1));
            using (Context context = new Context(clip.Asset))
            {
                context.SeekFrame(clip.FirstFrame(index));
                NativeArray<float> vertices = new NativeArray<float>(Floats * count, Allocator.Temp);
                if (Fill(clip, index, context, vertices))
                    Store(mesh, vertices, count);
                vertices.Dispose();
                NativeArray<float> uvs = new NativeArray<float>(2 * count, Allocator.Temp);
                FillUvs(clip, index, context, uvs);
                mesh.SetVertexBufferData(uvs, 0, 0, 2 * count, 1, Unchecked);
                uvs.Dispose();
            }
            NativeArray<uint> indices = new NativeArray<uint>(3 * triangles, Allocator.Temp);
            ReadOnlySpan<uint> from = plan.Indices;
            for (int t = 0; t < triangles; ++t)  // turned round: Unity's fronts are clockwise
            {
                indices[3 * t] = from[3 * t];
                indices[3 * t + 1] = from[3 * t + 2];
                indices[3 * t + 2] = from[3 * t + 1];
            }
            mesh.SetIndexBufferParams(3 * triangles, IndexFormat.UInt32);
            mesh.SetIndexBufferData(indices, 0, 0, 3 * triangles, Unchecked);
            indices.Dispose();
            mesh.subMeshCount = plan.GroupCount;
            ReadOnlySpan<uint> begin = plan.GroupBegin;
            for (int g = 0; g < plan.GroupCount; ++g)
                mesh.SetSubMesh(g, new SubMeshDescriptor((int)(3 * begin[g]), (int)(3 * (begin[g + 1] - begin[g]))), Unchecked);
            Box box;
            if (clip.Asset.GetClipBounds(out box, index))
                mesh.bounds = AnicSpace.Convert(box, clip.Asset.Up);
            return mesh;
        }

        /// <summary>Writes positions and normals of what a context shows; false when the mesh is not there.</summary>
        public static unsafe bool Fill(AnicClip clip, int index, Context context, NativeArray<float> vertices)
        {
            RenderPlan plan = clip.Plan(index);
            float* first = (float*)vertices.GetUnsafePtr();
            int count = plan.VertexCount;
            long bytes = 4L * Floats * count;
            Output positions = new Output(first, bytes, VertexFormat.Float32x3, 4 * Floats);
            if (!plan.WritePositions(context, ref positions, 0, count))
                return false;
            Output normals = new Output(first + 3, bytes - 12, VertexFormat.Float32x3, 4 * Floats);
            plan.WriteNormals(first, 4 * Floats, ref normals, 0, count);
            AnicSpace.Convert(first, count, Floats, clip.Asset.Up);
            AnicSpace.Convert(first + 3, count, Floats, clip.Asset.Up);
            return true;
        }

        /// <summary>Uploads stream 0.</summary>
        public static void Store(Mesh mesh, NativeArray<float> vertices, int count)
        {
            mesh.SetVertexBufferData(vertices, 0, 0, Floats * count, 0, Unchecked);
        }

        private static unsafe void FillUvs(AnicClip clip, int index, Context context, NativeArray<float> to)
        {
            MeshInfo info = clip.Asset.GetMesh(index);
            RenderPlan plan = clip.Plan(index);
            for (int a = 0; a < info.AttributeCount; ++a)
            {
                Attribute attribute = clip.Asset.GetAttribute(a, index);
                if (attribute.Kind != AttributeKind.Uv || attribute.Components < 2 || attribute.Domain == Domain.Polygons)
                    continue;
                float[] values = new float[attribute.Components * plan.VertexCount];
                if (!plan.WriteAttribute(context, a, values))
                    return;
                for (int v = 0; v < plan.VertexCount; ++v)
                {
                    to[2 * v] = values[attribute.Components * v];
                    to[2 * v + 1] = values[attribute.Components * v + 1];
                }
                return;
            }
        }
    }
}
