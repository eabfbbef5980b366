// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;

namespace Anicodec
{
    /// <summary>How to make normals of a mesh from its positions. Immutable; does not need the asset once made.</summary>
    public sealed unsafe class NormalPlan : IDisposable
    {
        private readonly NormalPlanHandle handle;

        public NormalPlan(Asset asset, int mesh = 0, NormalOptions options = default(NormalOptions))
        {
            Native.anic_normal_plan_options given = default(Native.anic_normal_plan_options);
            given.struct_size = (UIntPtr)sizeof(Native.anic_normal_plan_options);
            given.crease_angle = options.CreaseAngle;
            given.reference_frame = (uint)options.ReferenceFrame;
            given.per_corner = options.PerCorner ? (byte)1 : (byte)0;
            given.source_edges = options.SourceEdges ? (byte)1 : (byte)0;
            Native.Check(Native.anic_create_normal_plan(asset.handle, (uint)mesh, &given, null, out handle));
        }

        public void Dispose()
        {
            handle.Dispose();
        }

        /// <summary>One for each vertex, or for each corner.</summary>
        public int Count { get { return (int)Native.anic_get_normal_count(handle); } }

        /// <summary>Writes all normals, packed, from positions of all vertices.</summary>
        public void WriteNormals(ReadOnlySpan<float> positions, Span<float> to)
        {
            fixed (float* from = positions, first = to)
            {
                Output output = new Output(first, 4L * to.Length);
                WriteNormals(from, 0, ref output, 0, Count);
            }
        }

        /// <summary>Writes the normals first .. first + count - 1.</summary>
        /// <param name="positions">of all vertices</param>
        /// <param name="stride">bytes from a vertex to the next; 0: packed</param>
        public void WriteNormals(float* positions, int stride, ref Output to, int first, int count)
        {
            fixed (Native.anic_output* output = &to.native)
                Native.Check(Native.anic_write_normals(handle, positions, (UIntPtr)stride, (uint)first, (uint)count, output));
        }
    }
}
