// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using System.Runtime.InteropServices;
using UnityEngine;

namespace Anicodec.Unity
{
    /// <summary>The basis of a segment in buffers of the graphics card, in the blocks of anic_basis.</summary>
    public sealed class AnicBasisBuffers : IDisposable
    {
        public readonly int Vertices, Components, WideComponents, Channels, WeightChannels, Regions;
        public readonly bool HasPose, Linear;
        public readonly Vector4 Origin;

        /// <summary>Floats; int32; int16, two to a uint; bytes, four to a uint.</summary>
        public readonly GraphicsBuffer Pose, Wide, Narrow, VertexRegion;

        public AnicBasisBuffers(Basis basis)
        {
            Vertices = basis.VertexCount;
            Components = basis.Components;
            WideComponents = basis.WideComponents;
            Channels = basis.Channels;
            WeightChannels = basis.WeightChannels;
            HasPose = basis.Pose.Length > 0;
            Linear = basis.Reconstruction == Reconstruction.Linear;
            Origin = new Vector4(basis.Origin.X, basis.Origin.Y, basis.Origin.Z, 0);
            Pose = Upload(MemoryMarshal.AsBytes(basis.Pose));
            Wide = Upload(MemoryMarshal.AsBytes(basis.Wide));
            Narrow = Upload(MemoryMarshal.AsBytes(basis.Narrow));
            Regions = basis.Regions;
            VertexRegion = Upload(basis.VertexRegion);
        }

        public static GraphicsBuffer Upload(ReadOnlySpan<byte> bytes)
        {
            // A buffer has at least one element.
            uint[] words = new uint[Math.Max(1, (bytes.Length + 3) / 4)];
            bytes.CopyTo(MemoryMarshal.AsBytes(new Span<uint>(words)));
            GraphicsBuffer buffer = new GraphicsBuffer(GraphicsBuffer.Target.Structured, words.Length, 4);
            buffer.SetData(words);
            return buffer;
        }

        public void Dispose()
        {
            Pose.Dispose();
            Wide.Dispose();
            Narrow.Dispose();
            VertexRegion.Dispose();
        }
    }
}
