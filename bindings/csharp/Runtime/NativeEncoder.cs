// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// bindings/generate wrote this from codec/include/anicodec/encode.h.
using System;
using System.Runtime.InteropServices;

namespace Anicodec
{
    internal sealed partial class EncoderHandle : SafeHandle
    {
        public EncoderHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            NativeEncoder.anic_destroy_encoder(handle);
            Released();
            return true;
        }
    }

    internal sealed partial class LiveHandle : SafeHandle
    {
        public LiveHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        /// <summary>Runs behind the release, for handles that keep others open.</summary>
        partial void Released();

        protected override bool ReleaseHandle()
        {
            NativeEncoder.anic_destroy_live(handle);
            Released();
            return true;
        }
    }

    internal static unsafe partial class NativeEncoder
    {
        /// <summary>How a coordinate of the host is stored.</summary>
        public enum Scalar
        {
            Float32 = 0,
            /// <summary>Rounded to the nearest float32, which is what the codec keeps.</summary>
            Float64 = 1,
        }

        /// <summary>The largest error of the numbers of an attribute.</summary>
        public enum Bound
        {
            /// <summary>If it moves, attribute_error of anic_encode_options; if it rests, steps of uv_bits, of colour_bits, or of
            /// a 4095th of its range.</summary>
            Usual = 0,
            /// <summary>`error`, in units of its values.</summary>
            Units = 1,
            /// <summary>`error`, in per cent of its range: of the component with the largest, over all frames.</summary>
            Percent = 2,
            /// <summary>None once values are rounded: they are whole, up to 2^24, up to 2^18 of one that moves. The metadata's
            /// "fields" say "whole": true of its name.</summary>
            Exact = 3,
        }

        /// <summary>Kind of basis.</summary>
        public enum BasisChoice
        {
            Smallest = 0,
            Keyframes = 1,
            Eigenshapes = 2,
            Eigentrajectories = 3,
        }

        /// <summary>How key-frames are chosen.</summary>
        public enum Selection
        {
            Pivot = 0,
            Gas = 1,
            Uniform = 2,
        }

        /// <summary>How frames come from key-frames.</summary>
        public enum Interpolation
        {
            /// <summary>Between key-frames that were asked for linear; else best, where a file by geometry interpolation is a
            /// tenth smaller.</summary>
            Usual = 0,
            /// <summary>Any decoder plays the file.</summary>
            Linear = 1,
            /// <summary>Geometry interpolation, which decoders may lack: of key-frames alone.</summary>
            Msgi = 2,
            Best = 3,
        }

        /// <summary>The coder of the poses of key-frames.</summary>
        public enum KeyframeCoder
        {
            /// <summary>The coder of poses: any decoder plays the file.</summary>
            Native = 0,
            /// <summary>Draco, which decoders may lack.</summary>
            Draco = 1,
            Smallest = 2,
        }

        /// <summary>Whether vertices are moved along their surface first, of one mesh alone.</summary>
        public enum Massage
        {
            Off = 0,
            On = 1,
            /// <summary>If the file becomes smaller.</summary>
            Auto = 2,
        }

        /// <summary>ANIC_ENCODE_...</summary>
        [Flags]
        public enum EncodeFlags
        {
            None = 0,
            /// <summary>Goal_value is a length in per cent of the diagonal of the box around all frames, of several clips each of
            /// its own, not in units of the clip.</summary>
            Percent = 1,
            /// <summary>The same of max_error.</summary>
            CapPercent = 2,
            /// <summary>Attribute_error is in per cent of the range of its values.</summary>
            ErrorPercent = 4,
            /// <summary>Positions and polygons alone.</summary>
            NoAttributes = 8,
            /// <summary>The motion of the whole apart, of one mesh alone: anic_root_motion.</summary>
            RootMotion = 16,
            /// <summary>The positions come back bit for bit; instead of a goal, of max_error and of massage.</summary>
            Lossless = 32,
            /// <summary>The smallest file that the search finds, however long it takes to open; else bytes and the time of
            /// opening are in balance.</summary>
            Smallest = 64,
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_source_clip
        {
            public UIntPtr struct_size;
            public byte* name;
            public uint frame_count;
            public uint rate_numerator;
            public uint rate_denominator;
            public UpAxis up;
            public byte loop;
            public double start_time;
            public double metres_per_unit;
            public double* times;
            public byte** event_names;
            public double* event_seconds;
            public uint event_count;
            public fixed double origin[3];
            public byte find_origin;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_frame_run
        {
            public uint first;
            public uint count;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_source_mesh
        {
            public UIntPtr struct_size;
            public byte* name;
            public uint vertex_count;
            public uint polygon_count;
            public uint* offsets;
            public uint* corners;
            public void* positions;
            public IntPtr vertex_stride;
            public IntPtr frame_stride;
            public Scalar scalar;
            public uint run_count;
            public anic_frame_run* runs;
            public IntPtr user;
            public IntPtr read;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_source_attribute
        {
            public UIntPtr struct_size;
            public byte* name;
            public AttributeKind kind;
            public Domain domain;
            public uint components;
            public uint frames;
            public float* values;
            public uint* labels;
            public byte** label_names;
            public uint label_count;
            public Native.anic_material** materials;
            public byte* unit;
            public double error;
            public Bound bound;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_encode_progress
        {
            public IntPtr user;
            public IntPtr report;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_writer
        {
            public IntPtr user;
            public IntPtr write;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_encode_options
        {
            public UIntPtr struct_size;
            public Goal goal;
            public VertexOrder order;
            public double goal_value;
            public double max_error;
            public ulong flags;
            public ulong max_bytes;
            public uint threads;
            public Effort effort;
            public BasisChoice basis;
            public uint keyframes;
            public Selection selection;
            public Interpolation interpolation;
            public KeyframeCoder keyframe_coder;
            public Massage massage;
            public uint uv_bits;
            public uint colour_bits;
            public double massage_strength;
            public double massage_tolerance;
            public double attribute_error;
            public double normal_error;
            public anic_encode_progress progress;
            public anic_writer writer;
            public byte* metadata;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_encoding
        {
            public UIntPtr struct_size;
            public void* file;
            public UIntPtr size;
            public double max_error;
            public double rmse;
            public double kg;
            public double diagonal;
            public double surface_error;
            public uint components;
            public BasisKind basis;
            public byte massaged;
            public double max_displacement_error;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_options
        {
            public UIntPtr struct_size;
            public double piece_seconds;
            public double key_seconds;
            public double box;
            public ulong most_waiting_frames;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_frame
        {
            public UIntPtr struct_size;
            public void* positions;
            public IntPtr vertex_stride;
            public Scalar scalar;
            public uint value_count;
            public float** values;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_piece
        {
            public UIntPtr struct_size;
            public void* file;
            public UIntPtr size;
            public ulong first_frame;
            public double start_time;
            public double encode_seconds;
            public double max_error;
            public double rmse;
            public double kg;
            public uint frame_count;
            public byte key;
            public byte has_mesh;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_info
        {
            public UIntPtr struct_size;
            public ulong pushed_frames;
            public ulong waiting_frames;
            public ulong late_frames;
            public ulong waiting_pieces;
            public double encode_seconds;
            public uint piece_frames;
            public byte ended;
        }

        [DllImport(Library)] public static extern uint anic_get_encoder_version();
        [DllImport(Library)] public static extern Status anic_create_encoder(out EncoderHandle @out);
        [DllImport(Library)] public static extern void anic_destroy_encoder(IntPtr encoder);
        [DllImport(Library)] public static extern byte* anic_get_encoder_text(EncoderHandle encoder);
        [DllImport(Library)] public static extern Status anic_set_source_clip(EncoderHandle encoder, anic_source_clip* clip);
        [DllImport(Library)] public static extern Status anic_add_source_clip(EncoderHandle encoder, anic_source_clip* clip);
        [DllImport(Library)] public static extern Status anic_add_source_mesh(EncoderHandle encoder, anic_source_mesh* mesh, uint* number);
        [DllImport(Library)] public static extern Status anic_add_source_attribute(EncoderHandle encoder, uint mesh, anic_source_attribute* attribute);
        [DllImport(Library)] public static extern Status anic_encode(EncoderHandle encoder, anic_encode_options* options, anic_encoding* @out);
        [DllImport(Library)] public static extern Status anic_begin_live(EncoderHandle encoder, anic_encode_options* options, anic_live_options* live, out LiveHandle @out);
        [DllImport(Library)] public static extern void anic_destroy_live(IntPtr live);
        [DllImport(Library)] public static extern byte* anic_get_live_text();
        [DllImport(Library)] public static extern Status anic_push_live_frame(LiveHandle live, anic_live_frame* frame, double wait);
        [DllImport(Library)] public static extern Status anic_end_live(LiveHandle live);
        [DllImport(Library)] public static extern Status anic_take_live_piece(LiveHandle live, double wait, anic_live_piece* @out);
        [DllImport(Library)] public static extern Status anic_get_live_info(LiveHandle live, anic_live_info* @out);
    }
}
