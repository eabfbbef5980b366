// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;

namespace Anicodec
{
    /// <summary>
    /// The vertices that a graphics card needs, one for each pair of a vertex and what its corners carry, and index buffers over
    /// them. Immutable; does not need the asset once made.
    /// </summary>
    public sealed unsafe class RenderPlan : IDisposable
    {
        private readonly RenderPlanHandle handle;
        private readonly Native.anic_render_info info;

        public RenderPlan(Asset asset, int mesh = 0, NormalOptions options = default(NormalOptions))
        {
            Native.anic_render_plan_options given = default(Native.anic_render_plan_options);
            given.struct_size = (UIntPtr)sizeof(Native.anic_render_plan_options);
            given.crease_angle = options.CreaseAngle;
            given.reference_frame = (uint)options.ReferenceFrame;
            given.source_edges = options.SourceEdges ? (byte)1 : (byte)0;
            Native.Check(Native.anic_create_render_plan(asset.handle, (uint)mesh, &given, null, out handle));
            Native.anic_render_info filled = default(Native.anic_render_info);
            filled.struct_size = (UIntPtr)sizeof(Native.anic_render_info);
            Native.Check(Native.anic_get_render_info(handle, &filled));
            info = filled;
        }

        public void Dispose()
        {
            handle.Dispose();
        }

        public int VertexCount { get { return (int)info.vertex_count; } }
        public int TriangleCount { get { return (int)info.triangle_count; } }

        /// <summary>Groups of triangles, one for each material.</summary>
        public int GroupCount { get { return (int)info.group_count; } }

        /// <summary>Vertex of each render vertex.</summary>
        public ReadOnlySpan<uint> Vertices { get { return Span(info.vertices, info.vertex_count); } }

        /// <summary>A corner of each render vertex; empty in a mesh without corners.</summary>
        public ReadOnlySpan<uint> Corners { get { return Span(info.corners, info.vertex_count); } }

        /// <summary>TriangleCount x 3 render vertices, ordered by group.</summary>
        public ReadOnlySpan<uint> Indices { get { return Span(info.indices, 3 * info.triangle_count); } }

        /// <summary>Label of each group's material: 0 for none, or one more than the number of a name.</summary>
        public ReadOnlySpan<uint> GroupMaterials { get { return Span(info.group_materials, info.group_count); } }

        /// <summary>Group g has the triangles begin[g] .. begin[g + 1] - 1.</summary>
        public ReadOnlySpan<uint> GroupBegin { get { return Span(info.group_begin, info.group_count + 1); } }

        /// <summary>For normals on a graphics card; anic_render_info describes them.</summary>
        public ReadOnlySpan<uint> NormalGroups { get { return Span(info.normal_groups, info.vertex_count); } }

        public ReadOnlySpan<uint> NormalCentres { get { return Span(info.normal_centres, info.normal_group_count); } }

        public ReadOnlySpan<uint> NormalBegin { get { return Span(info.normal_begin, info.normal_group_count + 1); } }

        public ReadOnlySpan<uint> NormalCorners { get { return Span(info.normal_corners, 2 * NormalBegin[(int)info.normal_group_count]); } }

        private ReadOnlySpan<uint> Span(uint* first, uint count)
        {
            if (handle.IsClosed)
                throw new ObjectDisposedException("RenderPlan");
            return first == null ? default(ReadOnlySpan<uint>) : new ReadOnlySpan<uint>(first, (int)count);
        }

        /// <summary>Writes positions of all render vertices, packed; false when the mesh is not there.</summary>
        public bool WritePositions(Context context, Span<float> to, When when = When.Current)
        {
            fixed (float* first = to)
            {
                Output output = new Output(first, 4L * to.Length);
                return WritePositions(context, ref output, 0, VertexCount, when);
            }
        }

        /// <summary>Writes positions of the render vertices first .. first + count - 1; false when the mesh is not there.</summary>
        public bool WritePositions(Context context, ref Output to, int first, int count, When when = When.Current)
        {
            fixed (Native.anic_output* output = &to.native)
                return Native.Present(Native.anic_write_render_positions(handle, context.handle, when, (uint)first, (uint)count, output));
        }

        /// <summary>Writes all normals, packed, from positions of all render vertices.</summary>
        public void WriteNormals(ReadOnlySpan<float> positions, Span<float> to)
        {
            fixed (float* from = positions, first = to)
            {
                Output output = new Output(first, 4L * to.Length);
                WriteNormals(from, 0, ref output, 0, VertexCount);
            }
        }

        /// <summary>Writes normals of the render vertices first .. first + count - 1.</summary>
        /// <param name="positions">of all render vertices</param>
        /// <param name="stride">bytes from one to the next; 0: packed</param>
        public void WriteNormals(float* positions, int stride, ref Output to, int first, int count)
        {
            fixed (Native.anic_output* output = &to.native)
                Native.Check(Native.anic_write_render_normals(handle, positions, (UIntPtr)stride, (uint)first, (uint)count, output));
        }

        /// <summary>Writes values of an attribute of all render vertices, packed; false when the mesh is not there.</summary>
        public bool WriteAttribute(Context context, int attribute, Span<float> to, When when = When.Current)
        {
            fixed (float* first = to)
            {
                Native.anic_value_output output = Context.Values(first, to.Length);
                return Native.Present(Native.anic_write_render_attribute(handle, context.handle, (uint)attribute, when, 0,
                    info.vertex_count, &output));
            }
        }
    }
}
