// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;

namespace Anicodec
{
    /// <summary>Blends meshes of the host by multi-scale geometry interpolation. Immutable.</summary>
    public sealed unsafe class Morpher : IDisposable
    {
        private readonly MorpherHandle handle;
        private readonly double[] scratch;
        private readonly int meshes, vertices;

        /// <param name="triangles">three vertices each</param>
        /// <param name="shapes">two meshes or more of x, y, z for each vertex</param>
        /// <param name="sweeps">0: plain interpolation; 1 or 2 may help far outside the meshes</param>
        public Morpher(ReadOnlySpan<uint> triangles, float[][] shapes, int sweeps = 0)
        {
            meshes = shapes.Length;
            vertices = meshes > 0 ? shapes[0].Length / 3 : 0;
            // The library wants all meshes at once; they are copied to one place.
            float[] together = new float[3 * vertices * meshes];
            for (int m = 0; m < meshes; ++m)
            {
                if (shapes[m].Length != 3 * vertices)
                    throw new ArgumentException("shapes of different sizes", "shapes");
                Array.Copy(shapes[m], 0, together, 3 * vertices * m, 3 * vertices);
            }
            Native.anic_morpher_options options = default(Native.anic_morpher_options);
            options.struct_size = (UIntPtr)sizeof(Native.anic_morpher_options);
            options.sweeps = (uint)sweeps;
            IntPtr[] pointers = new IntPtr[meshes];
            fixed (uint* corners = triangles)
            fixed (float* all = together)
            fixed (IntPtr* places = pointers)
            {
                for (int m = 0; m < meshes; ++m)
                    pointers[m] = (IntPtr)(all + 3 * vertices * m);
                Native.Check(Native.anic_create_morpher(corners, (uint)triangles.Length / 3, (uint)vertices, (float**)places,
                    (uint)meshes, &options, null, out handle));
            }
            Native.anic_morpher_info info = default(Native.anic_morpher_info);
            info.struct_size = (UIntPtr)sizeof(Native.anic_morpher_info);
            Native.Check(Native.anic_get_morpher_info(handle, &info));
            scratch = new double[(info.scratch_bytes + 7) / 8];
        }

        public void Dispose()
        {
            handle.Dispose();
        }

        /// <summary>Writes the mesh at some weights, which sum to one. One thread at a time.</summary>
        public void Morph(ReadOnlySpan<double> weights, Span<float> to)
        {
            if (weights.Length != meshes || to.Length < 3 * vertices)
                throw new ArgumentException("a weight for each mesh, and room for each vertex");
            fixed (double* given = weights, room = scratch)
            fixed (float* result = to)
                Native.Check(Native.anic_morph(handle, given, null, null, room, (UIntPtr)(8L * scratch.Length), result));
        }
    }
}
