// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using System.IO;
using System.Text;

namespace Anicodec
{
    /// <summary>An opened file. Immutable; threads and contexts may share it.</summary>
    public sealed unsafe class Asset : IDisposable
    {
        internal readonly AssetHandle handle;
        private readonly Native.anic_asset_info info;

        internal Asset(AssetHandle opened)
        {
            handle = opened;
            Native.anic_asset_info filled = default(Native.anic_asset_info);
            filled.struct_size = (UIntPtr)sizeof(Native.anic_asset_info);
            Native.Check(Native.anic_get_asset_info(handle, &filled));
            info = filled;
        }

        /// <summary>major &lt;&lt; 16 | minor &lt;&lt; 8 | patch, of the native library.</summary>
        public static uint LibraryVersion { get { return Native.anic_get_version(); } }

        /// <summary>Opens a whole file in memory; the bytes are not needed afterwards.</summary>
        /// <exception cref="AnicException">the file is damaged, breaks a limit, or memory ran out</exception>
        public static Asset Open(ReadOnlySpan<byte> file, OpenOptions options = default(OpenOptions))
        {
            using (NativeOptions native = new NativeOptions(options))
            {
                Native.anic_options given = native.Options;
                Native.anic_failure failure = Failure();
                AssetHandle handle;
                fixed (byte* bytes = file)
                {
                    if (Native.anic_open_asset(bytes, (UIntPtr)file.Length, &given, out handle, &failure) != Status.Ok)
                        throw new AnicException(failure);
                }
                return new Asset(handle);
            }
        }

        /// <summary>Opens a file of the file system.</summary>
        public static Asset Open(string path, OpenOptions options = default(OpenOptions))
        {
            return Open(File.ReadAllBytes(path), options);
        }

        /// <summary>Another asset of the same file, which shares its memory; either may be disposed of first.</summary>
        /// <param name="options">clips and quality of its own; Flags as the file was opened with</param>
        /// <exception cref="AnicException">Status.Absent: a clip is not open in this asset</exception>
        public Asset Share(OpenOptions options = default(OpenOptions))
        {
            using (NativeOptions native = new NativeOptions(options))
            {
                Native.anic_options given = native.Options;
                AssetHandle shared;
                Native.Check(Native.anic_share_asset(handle, &given, out shared));
                return new Asset(shared);
            }
        }

        /// <summary>Tells from the first bytes of a file what it will take.</summary>
        /// <exception cref="AnicException">Status.Truncated: result.HeadBytes are needed</exception>
        public static Requirements GetRequirements(ReadOnlySpan<byte> head, OpenOptions options = default(OpenOptions))
        {
            Native.anic_requirements r = default(Native.anic_requirements);
            r.struct_size = (UIntPtr)sizeof(Native.anic_requirements);
            using (NativeOptions native = new NativeOptions(options))
            {
                Native.anic_options given = native.Options;
                fixed (byte* bytes = head)
                    Native.Check(Native.anic_get_requirements(bytes, (UIntPtr)head.Length, &given, &r));
            }
            return new Requirements
            {
                HeadBytes = r.head_bytes, FileBytes = r.file_bytes, ResidentBytes = r.resident_bytes, OpeningBytes = r.opening_bytes,
                DracoBytes = r.draco_bytes, BlockBytes = r.block_bytes, ContextBytes = r.context_bytes,
                MeshCount = (int)r.mesh_count, SegmentCount = (int)r.segment_count, FrameCount = (int)r.frame_count,
                MaxVertices = (int)r.max_vertices, MaxComponents = (int)r.max_components
            };
        }

        /// <summary>The metadata of a file that is not opened: a JSON object; null if it has none.</summary>
        public static string ReadMetadata(ReadOnlySpan<byte> file)
        {
            fixed (byte* bytes = file)
            {
                byte* text;
                UIntPtr size;
                if (!Native.Present(Native.anic_read_metadata(bytes, (UIntPtr)file.Length, &text, &size)))
                    return null;
                return System.Text.Encoding.UTF8.GetString(text, (int)size);
            }
        }

        /// <summary>A box around frames of a mesh that a file keeps for culling, without decoding; false if it has none. The first bytes
        /// of the file suffice. frames 0: all from firstFrame on.</summary>
        public static bool ReadBounds(ReadOnlySpan<byte> file, out Box box, int mesh = 0, int firstFrame = 0, int frames = 0)
        {
            box = default(Box);
            fixed (byte* bytes = file)
            fixed (Box* to = &box)
                return Native.Present(Native.anic_read_bounds(bytes, (UIntPtr)file.Length, (uint)mesh, (uint)firstFrame, (uint)frames, to));
        }

        internal static Native.anic_failure Failure()
        {
            Native.anic_failure failure = default(Native.anic_failure);
            failure.struct_size = (UIntPtr)sizeof(Native.anic_failure);
            return failure;
        }

        public void Dispose()
        {
            handle.Dispose();
        }

        public string Name { get { return Native.Text(info.name); } }
        public int MeshCount { get { return (int)info.mesh_count; } }
        public int SegmentCount { get { return (int)info.segment_count; } }

        /// <summary>Frames of all clips.</summary>
        public int FrameCount { get { return (int)info.frame_count; } }

        public int ClipCount { get { return (int)Native.anic_get_clip_count(handle); } }
        public UpAxis Up { get { return info.up; } }
        public VertexOrder Order { get { return info.order; } }

        /// <summary>Seconds from the first frame of clip 0 to its last one.</summary>
        public double Duration { get { return info.duration; } }

        /// <summary>0: unknown.</summary>
        public double MetresPerUnit { get { return info.metres_per_unit; } }

        /// <summary>Point that positions count from: added in double, it gives the source's coordinates, which may be too
        /// far from zero for floats.</summary>
        public unsafe double[] Origin
        {
            get
            {
                fixed (double* origin = info.origin)
                    return new[] { origin[0], origin[1], origin[2] };
            }
        }

        /// <summary>The diagonal of the box around all frames of the source.</summary>
        public double Diagonal { get { return info.diagonal; } }

        /// <summary>Largest distance of a vertex from its place in the source, in units of the clip.</summary>
        public double MaxError { get { return info.max_error; } }

        /// <summary>Largest error of a vertex's move from frame to frame, in units of the clip.</summary>
        public double MaxDisplacementError { get { return info.max_displacement_error; } }

        public bool Partial { get { return info.partial != 0; } }
        public long ResidentBytes { get { return (long)info.resident_bytes; } }
        public long ContextBytes { get { return (long)info.context_bytes; } }

        public ClipInfo GetClip(int clip)
        {
            Native.anic_clip c = default(Native.anic_clip);
            c.struct_size = (UIntPtr)sizeof(Native.anic_clip);
            Native.Check(Native.anic_get_clip(handle, (uint)clip, &c));
            return new ClipInfo
            {
                Name = Native.Text(c.name), FirstFrame = (int)c.first_frame, FrameCount = (int)c.frame_count,
                FramesPerSecond = c.rate_numerator / (double)c.rate_denominator, Uneven = c.uneven != 0, Loop = c.loop != 0,
                Closed = c.closed != 0, Open = c.open != 0, StartTime = c.start_time, Duration = c.duration,
                LoopDuration = c.loop_duration, Diagonal = c.diagonal, MaxError = c.max_error
            };
        }

        /// <summary>Number of the clip of a name; -1: there is none.</summary>
        public int FindClip(string name)
        {
            byte[] bytes = Encoding.UTF8.GetBytes(name + "\0");
            uint clip = 0;
            fixed (byte* first = bytes)
                return Native.Present(Native.anic_find_clip(handle, first, &clip)) ? (int)clip : -1;
        }

        /// <summary>The events of a clip, ascending by time.</summary>
        public ClipEvent[] GetEvents(int clip)
        {
            ClipEvent[] events = new ClipEvent[Native.anic_get_event_count(handle, (uint)clip)];
            for (int i = 0; i < events.Length; ++i)
            {
                Native.anic_event e = default(Native.anic_event);
                e.struct_size = (UIntPtr)sizeof(Native.anic_event);
                Native.Check(Native.anic_get_event(handle, (uint)clip, (uint)i, &e));
                events[i] = new ClipEvent { Name = Native.Text(e.name), Seconds = e.seconds };
            }
            return events;
        }

        /// <summary>The motion of the whole at a time of a clip, part of the positions or not (OpenFlags.InPlace).</summary>
        public RootMotion GetRootMotion(int clip, double seconds, Sampling sampling = Sampling.Linear, Wrap wrap = Wrap.Clamp)
        {
            Native.anic_root_motion m = default(Native.anic_root_motion);
            m.struct_size = (UIntPtr)sizeof(Native.anic_root_motion);
            Native.Check(Native.anic_get_root_motion(handle, (uint)clip, seconds, sampling, wrap, &m));
            return Native.Motion(m);
        }

        /// <summary>
        /// The step of a character from one time of a clip to another, through any number of turns of a loop: Turn, and Move in the
        /// axes that it has at `from`. For a cross-fade, add up those of both clips by their weights.
        /// </summary>
        public RootMotion GetRootStep(int clip, double from, double to, Sampling sampling = Sampling.Linear, Wrap wrap = Wrap.Loop)
        {
            Native.anic_root_motion m = default(Native.anic_root_motion);
            m.struct_size = (UIntPtr)sizeof(Native.anic_root_motion);
            Native.Check(Native.anic_get_root_step(handle, (uint)clip, from, to, sampling, wrap, &m));
            return Native.Motion(m);
        }

        public MeshInfo GetMesh(int mesh = 0)
        {
            Native.anic_mesh m = Mesh(mesh);
            return new MeshInfo
            {
                Name = Native.Text(m.name), VertexCount = (int)m.vertex_count, CodedVertexCount = (int)m.coded_vertex_count,
                PolygonCount = (int)m.polygon_count, CornerCount = (int)m.corner_count, TriangleCount = (int)m.triangle_count,
                AttributeCount = (int)m.attribute_count
            };
        }

        internal Native.anic_mesh Mesh(int mesh)
        {
            Native.anic_mesh m = default(Native.anic_mesh);
            m.struct_size = (UIntPtr)sizeof(Native.anic_mesh);
            Native.Check(Native.anic_get_mesh(handle, (uint)mesh, &m));
            return m;
        }

        /// <summary>Polygon p has the corners offsets[p] .. offsets[p + 1] - 1. Good as long as the asset is open.</summary>
        public void GetPolygons(int mesh, out ReadOnlySpan<uint> offsets, out ReadOnlySpan<uint> corners)
        {
            Native.anic_polygons p = default(Native.anic_polygons);
            p.struct_size = (UIntPtr)sizeof(Native.anic_polygons);
            Native.Check(Native.anic_get_polygons(handle, (uint)mesh, &p));
            offsets = new ReadOnlySpan<uint>(p.offsets, (int)p.polygon_count + 1);
            corners = new ReadOnlySpan<uint>(p.corners, (int)Mesh(mesh).corner_count);
        }

        /// <summary>Writes TriangleCount x 3 indices, counter-clockwise seen from the front.</summary>
        public void WriteIndices(Span<uint> to, int mesh = 0)
        {
            fixed (uint* first = to)
                Native.Check(Native.anic_write_indices(handle, (uint)mesh, 4, first, (UIntPtr)(4L * to.Length)));
        }

        /// <summary>The same for meshes of at most 65536 vertices.</summary>
        public void WriteIndices(Span<ushort> to, int mesh = 0)
        {
            fixed (ushort* first = to)
                Native.Check(Native.anic_write_indices(handle, (uint)mesh, 2, first, (UIntPtr)(2L * to.Length)));
        }

        /// <summary>Coded vertex of each vertex: those of the same number share their position in every frame.</summary>
        public ReadOnlySpan<uint> GetCodedVertices(int mesh = 0)
        {
            uint* first = null;
            Native.Check(Native.anic_get_coded_vertices(handle, (uint)mesh, &first));
            return new ReadOnlySpan<uint>(first, (int)Mesh(mesh).vertex_count);
        }

        public Attribute GetAttribute(int attribute, int mesh = 0)
        {
            Native.anic_attribute a = default(Native.anic_attribute);
            a.struct_size = (UIntPtr)sizeof(Native.anic_attribute);
            Native.Check(Native.anic_get_attribute(handle, (uint)mesh, (uint)attribute, &a));
            Attribute result = default(Attribute);
            result.Name = Native.Text(a.name);
            result.Kind = a.kind;
            result.Domain = a.domain;
            result.Count = (int)a.count;
            result.Components = (int)a.components;
            if (a.values != null)
                result.Values = new ReadOnlySpan<float>(a.values, (int)(a.count * a.components));
            if (a.labels != null)
                result.Labels = new ReadOnlySpan<uint>(a.labels, (int)a.count);
            result.LabelCount = (int)a.label_count;
            result.Moves = a.moves != 0;
            return result;
        }

        /// <summary>Null if there is no such label.</summary>
        public string GetLabelName(int attribute, int label, int mesh = 0)
        {
            return Native.Text(Native.anic_get_label_name(handle, (uint)mesh, (uint)attribute, (uint)label));
        }

        /// <summary>The look of the material that a label of an attribute names; null: the file has its name alone.</summary>
        public MaterialLook GetMaterial(int attribute, int label, int mesh = 0)
        {
            Native.anic_material m = default(Native.anic_material);
            m.struct_size = (UIntPtr)sizeof(Native.anic_material);
            if (!Native.Present(Native.anic_get_material(handle, (uint)mesh, (uint)attribute, (uint)label, &m)))
                return null;
            return new MaterialLook
            {
                Name = Native.Text(m.name),
                BaseColour = new[] { m.base_colour[0], m.base_colour[1], m.base_colour[2], m.base_colour[3] },
                Metallic = m.metallic, Roughness = m.roughness,
                Emissive = new[] { m.emissive[0], m.emissive[1], m.emissive[2] },
                Alpha = m.alpha, AlphaCutoff = m.alpha_cutoff, DoubleSided = m.double_sided != 0,
                BaseColourTexture = Native.Text(m.base_colour_texture),
                MetallicRoughnessTexture = Native.Text(m.metallic_roughness_texture),
                NormalTexture = Native.Text(m.normal_texture), OcclusionTexture = Native.Text(m.occlusion_texture),
                EmissiveTexture = Native.Text(m.emissive_texture)
            };
        }

        /// <summary>Seconds from the first frame of its clip on.</summary>
        public double GetFrameTime(int frame)
        {
            return Native.anic_get_frame_time(handle, (uint)frame);
        }

        /// <summary>The box of a frame; false when the mesh is not there. Needs OpenFlags.Bounds.</summary>
        public bool GetFrameBounds(int frame, out Box box, int mesh = 0)
        {
            fixed (Box* to = &box)
                return Native.Present(Native.anic_get_frame_bounds(handle, (uint)mesh, (uint)frame, to));
        }

        /// <summary>The box around all frames; false when the mesh is in none. Needs OpenFlags.Bounds.</summary>
        public bool GetClipBounds(out Box box, int mesh = 0)
        {
            fixed (Box* to = &box)
                return Native.Present(Native.anic_get_clip_bounds(handle, (uint)mesh, to));
        }

        /// <summary>Compares the hashes in the file with what was decoded.</summary>
        /// <exception cref="AnicException">Status.Hash, or Status.State of what is not complete</exception>
        public void Verify()
        {
            Native.Check(Native.anic_verify_asset(handle));
        }

        /// <summary>The layout of a segment's basis in textures of at most so many texels in width and height.</summary>
        public TextureLayout GetTextureLayout(int segment, int maxSize)
        {
            TextureLayout layout = default(TextureLayout);
            layout.native.struct_size = (UIntPtr)sizeof(Native.anic_texture_layout);
            Native.Check(Native.anic_get_texture_layout(handle, (uint)segment, (uint)maxSize, &layout.native));
            return layout;
        }

        /// <summary>Writes a texture, ready to be uploaded.</summary>
        /// <param name="rowBytes">from a row to the next; 0: packed</param>
        public void WriteTexture(int segment, BasisTexture texture, TextureLayout layout, Span<byte> to, int rowBytes = 0)
        {
            fixed (byte* first = to)
                Native.Check(Native.anic_write_texture(handle, (uint)segment, texture, &layout.native, (UIntPtr)rowBytes, first,
                    (UIntPtr)to.Length));
        }

        public Basis GetBasis(int segment)
        {
            Native.anic_basis b = default(Native.anic_basis);
            b.struct_size = (UIntPtr)sizeof(Native.anic_basis);
            Native.Check(Native.anic_get_basis(handle, (uint)segment, &b));
            Basis result = default(Basis);
            result.Kind = b.kind;
            result.Reconstruction = b.reconstruction;
            result.Target = b.target;
            result.Mesh = (int)b.mesh;
            result.FirstFrame = (int)b.first_frame;
            result.FrameCount = (int)b.frame_count;
            result.VertexCount = (int)b.vertex_count;
            result.Components = (int)b.components;
            result.WideComponents = (int)b.wide_components;
            result.Channels = (int)b.channels;
            result.WeightChannels = (int)b.weight_channels;
            result.Origin = new Point { X = b.origin[0], Y = b.origin[1], Z = b.origin[2] };
            if (b.pose != null)
                result.Pose = new ReadOnlySpan<float>(b.pose, (int)b.pose_count);
            result.Wide = new ReadOnlySpan<int>(b.wide, (int)b.wide_count);
            result.Narrow = new ReadOnlySpan<short>(b.narrow, (int)b.narrow_count);
            result.Regions = (int)b.regions;
            if (b.vertex_region != null)
                result.VertexRegion = new ReadOnlySpan<byte>(b.vertex_region, (int)b.vertex_count);
            return result;
        }
    }
}
