// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// bindings/generate wrote this from sdk/include/anicodec/anicodec.h.
using System;
using System.Runtime.InteropServices;

namespace Anicodec
{
    internal sealed partial class AssetHandle : SafeHandle
    {
        public AssetHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            Native.anic_close_asset(handle);
            Released();
            return true;
        }
    }

    internal sealed partial class ContextHandle : SafeHandle
    {
        public ContextHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            Native.anic_destroy_context(handle);
            Released();
            return true;
        }
    }

    internal sealed partial class NormalPlanHandle : SafeHandle
    {
        public NormalPlanHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            Native.anic_destroy_normal_plan(handle);
            Released();
            return true;
        }
    }

    internal sealed partial class RenderPlanHandle : SafeHandle
    {
        public RenderPlanHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            Native.anic_destroy_render_plan(handle);
            Released();
            return true;
        }
    }

    internal sealed partial class MorpherHandle : SafeHandle
    {
        public MorpherHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            Native.anic_destroy_morpher(handle);
            Released();
            return true;
        }
    }

    internal sealed partial class StreamHandle : SafeHandle
    {
        public StreamHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            Native.anic_destroy_stream(handle);
            Released();
            return true;
        }
    }

    internal static unsafe partial class Native
    {
        [StructLayout(LayoutKind.Sequential)]
        public struct anic_failure
        {
            public UIntPtr struct_size;
            public Status status;
            public fixed byte chunk[8];
            public ulong offset;
            public byte* detail;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_allocator
        {
            public IntPtr user;
            public IntPtr allocate;
            public IntPtr release;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_threads
        {
            public IntPtr user;
            public IntPtr run;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_progress
        {
            public IntPtr user;
            public IntPtr report;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_options
        {
            public UIntPtr struct_size;
            public ulong max_vertices;
            public ulong max_frames;
            public ulong max_components;
            public ulong max_bytes;
            public anic_allocator allocator;
            public anic_threads threads;
            public anic_progress progress;
            public double quality;
            public ulong flags;
            public byte** clips;
            public uint clip_count;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_requirements
        {
            public UIntPtr struct_size;
            public ulong head_bytes;
            public ulong file_bytes;
            public ulong resident_bytes;
            public ulong opening_bytes;
            public ulong draco_bytes;
            public ulong block_bytes;
            public ulong context_bytes;
            public uint mesh_count;
            public uint segment_count;
            public uint frame_count;
            public uint max_vertices;
            public uint max_components;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_reader
        {
            public IntPtr user;
            public IntPtr read;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_asset_info
        {
            public UIntPtr struct_size;
            public byte* name;
            public byte* encoder;
            public uint mesh_count;
            public uint segment_count;
            public uint frame_count;
            public uint rate_numerator;
            public uint rate_denominator;
            public UpAxis up;
            public VertexOrder order;
            public byte rate_assumed;
            public byte uneven;
            public byte loop;
            public byte closed;
            public byte massaged;
            public byte partial;
            public double start_time;
            public double duration;
            public double loop_duration;
            public double metres_per_unit;
            public double diagonal;
            public double max_error;
            public double rmse;
            public double kg;
            public double surface_error;
            public double surface_error_mean;
            public ulong resident_bytes;
            public ulong context_bytes;
            public double max_displacement_error;
            public fixed double origin[3];
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_clip
        {
            public UIntPtr struct_size;
            public byte* name;
            public uint first_frame;
            public uint frame_count;
            public uint rate_numerator;
            public uint rate_denominator;
            public byte rate_assumed;
            public byte uneven;
            public byte loop;
            public byte closed;
            public byte massaged;
            public byte open;
            public double start_time;
            public double duration;
            public double loop_duration;
            public double diagonal;
            public double max_error;
            public double rmse;
            public double kg;
            public double surface_error;
            public double surface_error_mean;
            public double max_displacement_error;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_event
        {
            public UIntPtr struct_size;
            public byte* name;
            public double seconds;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_mesh
        {
            public UIntPtr struct_size;
            public byte* name;
            public uint vertex_count;
            public uint coded_vertex_count;
            public uint polygon_count;
            public uint corner_count;
            public uint triangle_count;
            public uint attribute_count;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_polygons
        {
            public UIntPtr struct_size;
            public uint* offsets;
            public uint* corners;
            public uint polygon_count;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_attribute
        {
            public UIntPtr struct_size;
            public byte* name;
            public AttributeKind kind;
            public Domain domain;
            public uint count;
            public uint components;
            public float* values;
            public uint* labels;
            public uint label_count;
            public byte moves;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_material
        {
            public UIntPtr struct_size;
            public byte* name;
            public fixed float base_colour[4];
            public float metallic;
            public float roughness;
            public fixed float emissive[3];
            public AlphaMode alpha;
            public float alpha_cutoff;
            public byte double_sided;
            public byte* base_colour_texture;
            public byte* metallic_roughness_texture;
            public byte* normal_texture;
            public byte* occlusion_texture;
            public byte* emissive_texture;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_root_motion
        {
            public UIntPtr struct_size;
            public byte moves;
            public byte turns;
            public double turn;
            public fixed double move[3];
            public fixed double pivot[3];
            public fixed float matrix[12];
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_output
        {
            public UIntPtr struct_size;
            public void* data;
            public UIntPtr size;
            public UIntPtr stride;
            public VertexFormat format;
            public fixed float offset[3];
            public fixed float scale[3];
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_value_output
        {
            public UIntPtr struct_size;
            public void* data;
            public UIntPtr size;
            public UIntPtr stride;
            public ValueFormat format;
            public uint components;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_ray
        {
            public UIntPtr struct_size;
            public fixed float origin[3];
            public fixed float direction[3];
            public float farthest;
            public Side side;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_normal_plan_options
        {
            public UIntPtr struct_size;
            public double crease_angle;
            public uint reference_frame;
            public byte per_corner;
            public byte source_edges;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_render_plan_options
        {
            public UIntPtr struct_size;
            public double crease_angle;
            public uint reference_frame;
            public byte source_edges;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_render_info
        {
            public UIntPtr struct_size;
            public uint* vertices;
            public uint* corners;
            public uint* indices;
            public uint* triangle_polygons;
            public uint* group_materials;
            public uint* group_begin;
            public uint mesh;
            public uint vertex_count;
            public uint triangle_count;
            public uint group_count;
            public uint normal_group_count;
            public uint* normal_groups;
            public uint* normal_centres;
            public uint* normal_begin;
            public uint* normal_corners;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_morpher_options
        {
            public UIntPtr struct_size;
            public ulong max_bytes;
            public uint* pins;
            public uint pin_count;
            public uint leaf_faces;
            public uint sweeps;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_morpher_info
        {
            public UIntPtr struct_size;
            public ulong resident_bytes;
            public ulong scratch_bytes;
            public double largest_turn;
            public uint vertex_count;
            public uint mesh_count;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_basis
        {
            public UIntPtr struct_size;
            public BasisKind kind;
            public Reconstruction reconstruction;
            public Target target;
            public uint mesh;
            public uint attribute;
            public uint first_component;
            public uint first_frame;
            public uint frame_count;
            public uint vertex_count;
            public uint components;
            public uint wide_components;
            public uint channels;
            public uint weight_channels;
            public fixed float origin[3];
            public float* pose;
            public int* wide;
            public short* narrow;
            public UIntPtr pose_count;
            public UIntPtr wide_count;
            public UIntPtr narrow_count;
            public uint* vertex_shape;
            public uint regions;
            public byte* vertex_region;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_part
        {
            public uint segment;
            public float share;
            public float* weights;
            public float* shape;
            public fixed float pose_map[12];
            public fixed float motion[12];
            public Correction* corrections;
            public uint correction_count;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_parts
        {
            public UIntPtr struct_size;
            public uint count;
            public anic_part parts0, parts1, parts2, parts3;
            public fixed uint components[4];
            public float* pose_maps0, pose_maps1, pose_maps2, pose_maps3;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_texture_layout
        {
            public UIntPtr struct_size;
            public uint width;
            public uint rows;
            public uint pose_height;
            public uint wide_height;
            public uint narrow_height;
            public uint state_floats;
            public uint regions;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_stream_info
        {
            public UIntPtr struct_size;
            public ulong received_bytes;
            public ulong file_bytes;
            public uint segment_count;
            public uint playable_segments;
            public uint layers;
            public uint arrived_layers;
            public byte playable;
            public byte complete;
            public uint file_number;
            public ulong waiting_bytes;
        }

        [DllImport(Library)] public static extern uint anic_get_version();
        [DllImport(Library)] public static extern byte* anic_get_status_text(Status status);
        [DllImport(Library)] public static extern Status anic_init_block_allocator(void* block, UIntPtr size, anic_allocator* @out);
        [DllImport(Library)] public static extern Status anic_get_requirements(void* head, UIntPtr size, anic_options* options, anic_requirements* @out);
        [DllImport(Library)] public static extern Status anic_read_metadata(void* file, UIntPtr size, byte** text, UIntPtr* text_bytes);
        [DllImport(Library)] public static extern Status anic_read_bounds(void* file, UIntPtr size, uint mesh, uint first_frame, uint frame_count, Box* @out);
        [DllImport(Library)] public static extern Status anic_open_asset(void* file, UIntPtr size, anic_options* options, out AssetHandle @out, anic_failure* failure);
        [DllImport(Library)] public static extern Status anic_open_asset_from_reader(anic_reader* reader, ulong file_size, anic_options* options, out AssetHandle @out, anic_failure* failure);
        [DllImport(Library)] public static extern Status anic_share_asset(AssetHandle asset, anic_options* options, out AssetHandle @out);
        [DllImport(Library)] public static extern void anic_close_asset(IntPtr asset);
        [DllImport(Library)] public static extern Status anic_verify_asset(AssetHandle asset);
        [DllImport(Library)] public static extern Status anic_get_asset_info(AssetHandle asset, anic_asset_info* @out);
        [DllImport(Library)] public static extern uint anic_get_clip_count(AssetHandle asset);
        [DllImport(Library)] public static extern Status anic_get_clip(AssetHandle asset, uint clip, anic_clip* @out);
        [DllImport(Library)] public static extern Status anic_find_clip(AssetHandle asset, byte* name, uint* @out);
        [DllImport(Library)] public static extern uint anic_get_event_count(AssetHandle asset, uint clip);
        [DllImport(Library)] public static extern Status anic_get_event(AssetHandle asset, uint clip, uint @event, anic_event* @out);
        [DllImport(Library)] public static extern Status anic_get_mesh(AssetHandle asset, uint mesh, anic_mesh* @out);
        [DllImport(Library)] public static extern Status anic_get_polygons(AssetHandle asset, uint mesh, anic_polygons* @out);
        [DllImport(Library)] public static extern Status anic_write_indices(AssetHandle asset, uint mesh, uint index_bytes, void* @out, UIntPtr size);
        [DllImport(Library)] public static extern Status anic_get_coded_vertices(AssetHandle asset, uint mesh, uint** @out);
        [DllImport(Library)] public static extern Status anic_get_attribute(AssetHandle asset, uint mesh, uint attribute, anic_attribute* @out);
        [DllImport(Library)] public static extern byte* anic_get_label_name(AssetHandle asset, uint mesh, uint attribute, uint label);
        [DllImport(Library)] public static extern Status anic_get_material(AssetHandle asset, uint mesh, uint attribute, uint label, anic_material* @out);
        [DllImport(Library)] public static extern double anic_get_frame_time(AssetHandle asset, uint frame);
        [DllImport(Library)] public static extern Status anic_create_context(AssetHandle asset, anic_allocator* allocator, out ContextHandle @out);
        [DllImport(Library)] public static extern void anic_destroy_context(IntPtr context);
        [DllImport(Library)] public static extern Status anic_set_clip(ContextHandle context, uint clip);
        [DllImport(Library)] public static extern Status anic_set_quality(ContextHandle context, double quality);
        [DllImport(Library)] public static extern Status anic_seek_frame(ContextHandle context, uint frame);
        [DllImport(Library)] public static extern Status anic_seek_time(ContextHandle context, double seconds, Sampling sampling, Wrap wrap);
        [DllImport(Library)] public static extern Status anic_blend(ContextHandle context, uint clip, double seconds, Sampling sampling, Wrap wrap, double weight);
        [DllImport(Library)] public static extern Status anic_forget_previous(ContextHandle context);
        [DllImport(Library)] public static extern Status anic_get_root_motion(AssetHandle asset, uint clip, double seconds, Sampling sampling, Wrap wrap, anic_root_motion* @out);
        [DllImport(Library)] public static extern Status anic_get_root_step(AssetHandle asset, uint clip, double from, double to, Sampling sampling, Wrap wrap, anic_root_motion* @out);
        [DllImport(Library)] public static extern Status anic_get_shown_root_motion(ContextHandle context, When when, anic_root_motion* @out);
        [DllImport(Library)] public static extern Status anic_write_positions(ContextHandle context, uint mesh, When when, uint first, uint count, anic_output* @out);
        [DllImport(Library)] public static extern Status anic_write_attribute(ContextHandle context, uint mesh, uint attribute, When when, uint first, uint count, anic_value_output* @out);
        [DllImport(Library)] public static extern Status anic_write_frames(AssetHandle asset, uint mesh, uint* frames, uint frame_count, uint first, uint count, anic_output* outputs);
        [DllImport(Library)] public static extern Status anic_compute_bounds(ContextHandle context, uint mesh, When when, Box* @out);
        [DllImport(Library)] public static extern Status anic_get_frame_bounds(AssetHandle asset, uint mesh, uint frame, Box* @out);
        [DllImport(Library)] public static extern Status anic_get_clip_bounds(AssetHandle asset, uint mesh, Box* @out);
        [DllImport(Library)] public static extern Status anic_get_surface_frame(ContextHandle context, uint mesh, When when, SurfacePoint* point, SurfaceFrame* @out);
        [DllImport(Library)] public static extern Status anic_intersect_ray(ContextHandle context, uint mesh, When when, anic_ray* ray, uint* triangles, uint triangle_count, float* work, UIntPtr work_size, Hit* @out);
        [DllImport(Library)] public static extern Status anic_create_normal_plan(AssetHandle asset, uint mesh, anic_normal_plan_options* options, anic_allocator* allocator, out NormalPlanHandle @out);
        [DllImport(Library)] public static extern void anic_destroy_normal_plan(IntPtr plan);
        [DllImport(Library)] public static extern uint anic_get_normal_count(NormalPlanHandle plan);
        [DllImport(Library)] public static extern Status anic_write_normals(NormalPlanHandle plan, float* positions, UIntPtr stride, uint first, uint count, anic_output* @out);
        [DllImport(Library)] public static extern Status anic_create_render_plan(AssetHandle asset, uint mesh, anic_render_plan_options* options, anic_allocator* allocator, out RenderPlanHandle @out);
        [DllImport(Library)] public static extern void anic_destroy_render_plan(IntPtr plan);
        [DllImport(Library)] public static extern Status anic_get_render_info(RenderPlanHandle plan, anic_render_info* @out);
        [DllImport(Library)] public static extern Status anic_write_render_positions(RenderPlanHandle plan, ContextHandle context, When when, uint first, uint count, anic_output* @out);
        [DllImport(Library)] public static extern Status anic_write_render_normals(RenderPlanHandle plan, float* positions, UIntPtr stride, uint first, uint count, anic_output* @out);
        [DllImport(Library)] public static extern Status anic_write_render_attribute(RenderPlanHandle plan, ContextHandle context, uint attribute, When when, uint first, uint count, anic_value_output* @out);
        [DllImport(Library)] public static extern Status anic_create_morpher(uint* triangles, uint triangle_count, uint vertex_count, float** meshes, uint mesh_count, anic_morpher_options* options, anic_allocator* allocator, out MorpherHandle @out);
        [DllImport(Library)] public static extern void anic_destroy_morpher(IntPtr morpher);
        [DllImport(Library)] public static extern Status anic_get_morpher_info(MorpherHandle morpher, anic_morpher_info* @out);
        [DllImport(Library)] public static extern Status anic_morph(MorpherHandle morpher, double* weights, float* pin_positions, anic_threads* threads, void* scratch, UIntPtr scratch_size, float* @out);
        [DllImport(Library)] public static extern Status anic_get_basis(AssetHandle asset, uint segment, anic_basis* @out);
        [DllImport(Library)] public static extern Status anic_get_parts(ContextHandle context, uint mesh, When when, anic_parts* @out);
        [DllImport(Library)] public static extern Status anic_get_attribute_parts(ContextHandle context, uint mesh, uint attribute, uint first_component, When when, anic_parts* @out);
        [DllImport(Library)] public static extern Status anic_get_texture_layout(AssetHandle asset, uint segment, uint max_size, anic_texture_layout* @out);
        [DllImport(Library)] public static extern Status anic_write_texture(AssetHandle asset, uint segment, BasisTexture texture, anic_texture_layout* layout, UIntPtr row_bytes, void* @out, UIntPtr size);
        [DllImport(Library)] public static extern Status anic_write_state(ContextHandle context, uint mesh, When when, uint part, float* @out, UIntPtr size);
        [DllImport(Library)] public static extern Status anic_create_stream(anic_options* options, out StreamHandle @out);
        [DllImport(Library)] public static extern void anic_destroy_stream(IntPtr stream);
        [DllImport(Library)] public static extern Status anic_push_bytes(StreamHandle stream, void* bytes, UIntPtr size);
        [DllImport(Library)] public static extern Status anic_advance_stream(StreamHandle stream);
        [DllImport(Library)] public static extern Status anic_get_stream_info(StreamHandle stream, anic_stream_info* @out);
        [DllImport(Library)] public static extern Status anic_get_stream_failure(StreamHandle stream, anic_failure* @out);
        [DllImport(Library)] public static extern Status anic_open_asset_from_stream(StreamHandle stream, out AssetHandle @out, anic_failure* failure);
    }
}
