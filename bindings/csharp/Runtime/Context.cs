// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;

namespace Anicodec
{
    /// <summary>
    /// An instance of an asset: what is shown now, and what was shown before. Seeking needs it to itself; writing does not.
    /// Nothing here allocates, apart from the constructor.
    /// </summary>
    public sealed unsafe class Context : IDisposable
    {
        internal readonly ContextHandle handle;
        private readonly Asset asset;

        public Context(Asset of)
        {
            asset = of;
            Native.Check(Native.anic_create_context(of.handle, null, out handle));
            handle.Keep(of.handle);
        }

        public Asset Asset { get { return asset; } }

        public void Dispose()
        {
            handle.Dispose();
        }

        /// <summary>The clip whose times Seek() means.</summary>
        public void SetClip(int clip)
        {
            Native.Check(Native.anic_set_clip(handle, (uint)clip));
        }

        /// <summary>The share of the components to play from the next seek on, in (0, 1].</summary>
        public void SetQuality(double quality)
        {
            Native.Check(Native.anic_set_quality(handle, quality));
        }

        /// <summary>Chooses a time of the clip in seconds; 0 is its first frame.</summary>
        public void Seek(double seconds, Sampling sampling = Sampling.Linear, Wrap wrap = Wrap.Clamp)
        {
            Native.Check(Native.anic_seek_time(handle, seconds, sampling, wrap));
        }

        /// <summary>Chooses a frame of the file.</summary>
        public void SeekFrame(int frame)
        {
            Native.Check(Native.anic_seek_frame(handle, (uint)frame));
        }

        /// <summary>Cross-fades what is shown with a moment of a clip; weight 1 shows the moment alone.</summary>
        public void Blend(int clip, double seconds, double weight, Sampling sampling = Sampling.Linear, Wrap wrap = Wrap.Clamp)
        {
            Native.Check(Native.anic_blend(handle, (uint)clip, seconds, sampling, wrap, weight));
        }

        /// <summary>No motion after a cut: the previous time becomes the current one.</summary>
        public void ForgetPrevious()
        {
            Native.Check(Native.anic_forget_previous(handle));
        }

        /// <summary>Writes positions of all vertices, packed; false when the mesh is not there.</summary>
        public bool WritePositions(Span<float> to, int mesh = 0, When when = When.Current)
        {
            fixed (float* first = to)
            {
                Output output = new Output(first, 4L * to.Length);
                return WritePositions(ref output, 0, (int)asset.Mesh(mesh).vertex_count, mesh, when);
            }
        }

        /// <summary>Writes positions of the vertices first .. first + count - 1; false when the mesh is not there.</summary>
        public bool WritePositions(ref Output to, int first, int count, int mesh = 0, When when = When.Current)
        {
            fixed (Native.anic_output* output = &to.native)
                return Native.Present(Native.anic_write_positions(handle, (uint)mesh, when, (uint)first, (uint)count, output));
        }

        /// <summary>Writes values of an attribute of all its elements (vertices, corners or polygons), packed; false when
        /// the mesh is not there.</summary>
        public bool WriteAttribute(int attribute, Span<float> to, int mesh = 0, When when = When.Current)
        {
            fixed (float* first = to)
            {
                Native.anic_value_output output = Values(first, to.Length);
                return Native.Present(Native.anic_write_attribute(handle, (uint)mesh, (uint)attribute, when, 0,
                    (uint)asset.GetAttribute(attribute, mesh).Count, &output));
            }
        }

        internal static Native.anic_value_output Values(float* first, int count)
        {
            Native.anic_value_output output = default(Native.anic_value_output);
            output.struct_size = (UIntPtr)sizeof(Native.anic_value_output);
            output.data = first;
            output.size = (UIntPtr)(4L * count);
            return output;
        }

        /// <summary>Computes the exact box; false when the mesh is not there. Costs what positions do.</summary>
        public bool ComputeBounds(out Box box, int mesh = 0, When when = When.Current)
        {
            fixed (Box* to = &box)
                return Native.Present(Native.anic_compute_bounds(handle, (uint)mesh, when, to));
        }

        /// <summary>Computes axes at a point of the surface, for what is attached to it; false when the mesh is not there.</summary>
        public bool GetSurfaceFrame(SurfacePoint point, out SurfaceFrame frame, int mesh = 0, When when = When.Current)
        {
            fixed (SurfaceFrame* to = &frame)
                return Native.Present(Native.anic_get_surface_frame(handle, (uint)mesh, when, &point, to));
        }

        /// <summary>
        /// Finds the first of the triangles on a ray; false when none is hit or the mesh is not there. `triangles` as
        /// Asset.WriteIndices() gives them; `work` has three floats for each vertex of the mesh; `farthest` in lengths of the
        /// direction, 0: any distance. Costs what positions do, and O(triangles).
        /// </summary>
        public bool IntersectRay(Point origin, Point direction, ReadOnlySpan<uint> triangles, Span<float> work, out Hit hit,
            float farthest = 0, Side side = Side.Any, int mesh = 0, When when = When.Current)
        {
            Native.anic_ray ray = default(Native.anic_ray);
            ray.struct_size = (UIntPtr)sizeof(Native.anic_ray);
            *(Point*)ray.origin = origin;
            *(Point*)ray.direction = direction;
            ray.farthest = farthest;
            ray.side = side;
            fixed (uint* first = triangles)
            fixed (float* place = work)
            fixed (Hit* to = &hit)
            {
                return Native.Present(Native.anic_intersect_ray(handle, (uint)mesh, when, &ray, first, (uint)(triangles.Length / 3),
                    place, (UIntPtr)(4L * work.Length), to)) && hit.Triangle != uint.MaxValue;
            }
        }

        /// <summary>How many parts a graphics card has to add up; 0: the mesh is not there.</summary>
        public int GetPartCount(int mesh = 0, When when = When.Current)
        {
            Native.anic_parts parts;
            return Find(mesh, when, &parts) ? (int)parts.count : 0;
        }

        /// <summary>One of those parts.</summary>
        public Part GetPart(int part, int mesh = 0, When when = When.Current)
        {
            Native.anic_parts parts;
            if (!Find(mesh, when, &parts) || (uint)part >= parts.count)
                throw new ArgumentOutOfRangeException("part");
            Native.anic_part* p = &parts.parts0 + part;
            Native.anic_basis basis = default(Native.anic_basis);
            basis.struct_size = (UIntPtr)sizeof(Native.anic_basis);
            Native.Check(Native.anic_get_basis(asset.handle, p->segment, &basis));
            Part result = default(Part);
            result.Segment = (int)p->segment;
            result.Share = p->share;
            result.Weights = new ReadOnlySpan<float>(p->weights, (int)(parts.components[part] * basis.weight_channels));
            result.weights = p->weights;
            result.regionStride = (int)(basis.components * basis.weight_channels);
            result.poseMaps = (&parts.pose_maps0)[part];
            if (p->shape != null)
                result.Shape = new ReadOnlySpan<float>(p->shape, 3 * (int)asset.Mesh(mesh).coded_vertex_count);
            for (int i = 0; i < 12; ++i)
            {
                result.PoseMap[i] = p->pose_map[i];
                result.Motion[i] = p->motion[i];
            }
            result.Corrections = new ReadOnlySpan<Correction>(p->corrections, (int)p->correction_count);
            return result;
        }

        /// <summary>Writes what a shader needs of one part; false when the mesh is not there.</summary>
        public bool WriteState(int part, Span<float> to, int mesh = 0, When when = When.Current)
        {
            fixed (float* first = to)
                return Native.Present(Native.anic_write_state(handle, (uint)mesh, when, (uint)part, first, (UIntPtr)(4L * to.Length)));
        }

        private bool Find(int mesh, When when, Native.anic_parts* parts)
        {
            *parts = default(Native.anic_parts);
            parts->struct_size = (UIntPtr)sizeof(Native.anic_parts);
            return Native.Present(Native.anic_get_parts(handle, (uint)mesh, when, parts));
        }
    }
}
