// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The part of encode.h that live streams need, as it is: fields keep the names of the header, and tests compare their offsets with those
// of a C compiler.
using System;
using System.Runtime.InteropServices;

namespace Anicodec
{
    internal sealed class LiveHandle : SafeHandle
    {
        public LiveHandle() : base(IntPtr.Zero, true) { }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        protected override bool ReleaseHandle()
        {
            NativeEncoder.anic_destroy_live(handle);
            return true;
        }
    }

    internal static unsafe class NativeEncoder
    {
        private const string Library = NativeLibraries.Encoder;

        static NativeEncoder()
        {
            NativeLibraries.Prepare();
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_source_clip
        {
            public UIntPtr struct_size;
            public byte* name;
            public uint frame_count, rate_numerator, rate_denominator;
            public UpAxis up;
            public byte loop;
            public double start_time, metres_per_unit;
            public double* times;
            public byte** event_names;
            public double* event_seconds;
            public uint event_count;
            public fixed double origin[3];
            public byte find_origin;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_source_mesh
        {
            public UIntPtr struct_size;
            public byte* name;
            public uint vertex_count, polygon_count;
            public uint* offsets;
            public uint* corners;
            public void* positions;
            public IntPtr vertex_stride, frame_stride;
            public int scalar;
            public uint run_count;
            public void* runs;
            public IntPtr user, read;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_source_attribute
        {
            public UIntPtr struct_size;
            public byte* name;
            public AttributeKind kind;
            public Domain domain;
            public uint components, frames;
            public float* values;
            public uint* labels;
            public byte** label_names;
            public uint label_count;
            public void* materials;
            public byte* unit;
            public double error;
            public int bound;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_encode_progress
        {
            public IntPtr user, report;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_writer
        {
            public IntPtr user, write;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_encode_options
        {
            public UIntPtr struct_size;
            public Goal goal;
            public VertexOrder order;
            public double goal_value, max_error;
            public ulong flags, max_bytes;
            public uint threads;
            public Effort effort;
            public int basis;
            public uint keyframes;
            public int selection, interpolation, keyframe_coder, massage;
            public uint uv_bits, colour_bits;
            public double massage_strength, massage_tolerance, attribute_error, normal_error;
            public anic_encode_progress progress;
            public anic_writer writer;
            public byte* metadata;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_options
        {
            public UIntPtr struct_size;
            public double piece_seconds, key_seconds, box;
            public ulong most_waiting_frames;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_frame
        {
            public UIntPtr struct_size;
            public void* positions;
            public IntPtr vertex_stride;
            public int scalar;
            public uint value_count;
            public float** values;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_piece
        {
            public UIntPtr struct_size;
            public byte* file;
            public UIntPtr size;
            public ulong first_frame;
            public double start_time, encode_seconds, max_error, rmse, kg;
            public uint frame_count;
            public byte key, has_mesh;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct anic_live_info
        {
            public UIntPtr struct_size;
            public ulong pushed_frames, waiting_frames, late_frames, waiting_pieces;
            public double encode_seconds;
            public uint piece_frames;
            public byte ended;
        }

        [DllImport(Library)] public static extern Status anic_create_encoder(out IntPtr encoder);
        [DllImport(Library)] public static extern void anic_destroy_encoder(IntPtr encoder);
        [DllImport(Library)] public static extern byte* anic_get_encoder_text(IntPtr encoder);
        [DllImport(Library)] public static extern Status anic_set_source_clip(IntPtr encoder, anic_source_clip* clip);
        [DllImport(Library)] public static extern Status anic_add_source_mesh(IntPtr encoder, anic_source_mesh* mesh, uint* number);
        [DllImport(Library)] public static extern Status anic_add_source_attribute(IntPtr encoder, uint mesh, anic_source_attribute* attribute);
        [DllImport(Library)] public static extern Status anic_begin_live(IntPtr encoder, anic_encode_options* options, anic_live_options* live, out LiveHandle made);
        [DllImport(Library)] public static extern void anic_destroy_live(IntPtr live);
        [DllImport(Library)] public static extern byte* anic_get_live_text();
        [DllImport(Library)] public static extern Status anic_push_live_frame(LiveHandle live, anic_live_frame* frame, double wait);
        [DllImport(Library)] public static extern Status anic_end_live(LiveHandle live);
        [DllImport(Library)] public static extern Status anic_take_live_piece(LiveHandle live, double wait, anic_live_piece* piece);
        [DllImport(Library)] public static extern Status anic_get_live_info(LiveHandle live, anic_live_info* info);
    }
}
