// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using System.Runtime.InteropServices;
using Unity.Collections;
using UnityEngine;

namespace Anicodec.Unity
{
    /// <summary>
    /// Makes positions and normals of one player by AnicPlay.compute, in the vertex buffer of its mesh. Each frame uploads a
    /// handful of weights.
    /// </summary>
    public sealed class AnicCompute : IDisposable
    {
        private const int MapFloats = 24;  // two matrices of three rows of four, before the weights
        private const int GroupSize = 64;

        private readonly AnicClip clip;
        private readonly int index;
        private readonly ComputeShader shader;
        private readonly GraphicsBuffer points, vertices, groups, centres, begin, corners, target;
        private readonly int positionsKernel, normalsKernel;
        private GraphicsBuffer state;
        private NativeArray<float> staged;

        public AnicCompute(AnicClip of, int mesh, ComputeShader with, Mesh to)
        {
            clip = of;
            index = mesh;
            shader = with;
            RenderPlan plan = clip.Plan(mesh);
            vertices = AnicBasisBuffers.Upload(MemoryMarshal.AsBytes(plan.Vertices));
            groups = AnicBasisBuffers.Upload(MemoryMarshal.AsBytes(plan.NormalGroups));
            centres = AnicBasisBuffers.Upload(MemoryMarshal.AsBytes(plan.NormalCentres));
            begin = AnicBasisBuffers.Upload(MemoryMarshal.AsBytes(plan.NormalBegin));
            corners = AnicBasisBuffers.Upload(MemoryMarshal.AsBytes(plan.NormalCorners));
            points = new GraphicsBuffer(GraphicsBuffer.Target.Structured, 3 * clip.Asset.GetMesh(mesh).VertexCount, 4);
            to.vertexBufferTarget |= GraphicsBuffer.Target.Raw;
            target = to.GetVertexBuffer(0);
            positionsKernel = shader.FindKernel("Positions");
            normalsKernel = shader.FindKernel("Normals");
        }

        /// <summary>
        /// Shows what a context shows; false when the CPU has to do it: corrections of single vertices, a time between two
        /// segments, geometry interpolation.
        /// </summary>
        public bool Show(Context context)
        {
            if (context.GetPartCount(index) != 1)
                return false;
            Part part = context.GetPart(0, index);
            AnicBasisBuffers basis = clip.Buffers(part.Segment);
            if (!basis.Linear || part.Corrections.Length > 0)
                return false;
            Stage(part, basis.Regions);
            shader.SetInt("vertexCount", basis.Vertices);
            shader.SetInt("renderVertexCount", clip.Plan(index).VertexCount);
            shader.SetInt("components", part.Weights.Length / basis.WeightChannels);
            shader.SetInt("allNarrow", basis.Components - basis.WideComponents);
            shader.SetInt("wideComponents", basis.WideComponents);
            shader.SetInt("channels", basis.Channels);
            shader.SetInt("hasPose", basis.HasPose ? 1 : 0);
            shader.SetInt("hasRegions", basis.Regions > 1 ? 1 : 0);
            shader.SetInt("regionFloats", MapFloats + part.Weights.Length);
            shader.SetInt("zUp", clip.Asset.Up == UpAxis.Z ? 1 : 0);
            shader.SetVector("origin", basis.Origin);
            shader.SetBuffer(positionsKernel, "pose", basis.Pose);
            shader.SetBuffer(positionsKernel, "wide", basis.Wide);
            shader.SetBuffer(positionsKernel, "narrow", basis.Narrow);
            shader.SetBuffer(positionsKernel, "vertexRegion", basis.VertexRegion);
            shader.SetBuffer(positionsKernel, "state", state);
            shader.SetBuffer(positionsKernel, "points", points);
            shader.Dispatch(positionsKernel, (basis.Vertices + GroupSize - 1) / GroupSize, 1, 1);
            shader.SetBuffer(normalsKernel, "points", points);
            shader.SetBuffer(normalsKernel, "sourceVertices", vertices);
            shader.SetBuffer(normalsKernel, "normalGroups", groups);
            shader.SetBuffer(normalsKernel, "normalCentres", centres);
            shader.SetBuffer(normalsKernel, "normalBegin", begin);
            shader.SetBuffer(normalsKernel, "normalCorners", corners);
            shader.SetBuffer(normalsKernel, "result", target);
            shader.Dispatch(normalsKernel, (clip.Plan(index).VertexCount + GroupSize - 1) / GroupSize, 1, 1);
            return true;
        }

        /// <summary>Uploads matrices and weights of each region.</summary>
        private unsafe void Stage(Part part, int regions)
        {
            int ofRegion = MapFloats + part.Weights.Length, count = regions * ofRegion;
            if (state == null || state.count < count)
            {
                if (state != null)
                {
                    state.Dispose();
                    staged.Dispose();
                }
                state = new GraphicsBuffer(GraphicsBuffer.Target.Structured, count, 4);
                staged = new NativeArray<float>(count, Allocator.Persistent);
            }
            for (int r = 0, at = 0; r < regions; ++r, at += ofRegion)
            {
                ReadOnlySpan<float> weights = part.RegionWeights(r);
                for (int i = 0; i < 12; ++i)
                {
                    staged[at + i] = regions > 1 ? part.RegionPoseMap(r)[i] : part.PoseMap[i];
                    staged[at + 12 + i] = part.Motion[i];
                }
                for (int i = 0; i < weights.Length; ++i)
                    staged[at + MapFloats + i] = weights[i];
            }
            state.SetData(staged);
        }

        public void Dispose()
        {
            foreach (GraphicsBuffer buffer in new[] { points, vertices, groups, centres, begin, corners, target, state })
            {
                if (buffer != null)
                    buffer.Dispose();
            }
            if (staged.IsCreated)
                staged.Dispose();
        }
    }
}
