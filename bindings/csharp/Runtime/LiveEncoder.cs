// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Anicodec
{
    /// <summary>A mesh of which frames will come.</summary>
    public sealed class LiveMesh
    {
        public int VertexCount;

        /// <summary>Polygon p has the corners Offsets[p] .. Offsets[p + 1] - 1; null: all are triangles.</summary>
        public uint[] Offsets;

        /// <summary>The vertex of each corner.</summary>
        public uint[] Corners = new uint[0];

        public List<LiveAttribute> Attributes = new List<LiveAttribute>();
    }

    /// <summary>Values beside the positions.</summary>
    public sealed class LiveAttribute
    {
        public string Name;
        public AttributeKind Kind;
        public Domain Domain;
        public int Components;

        /// <summary>Elements x components; null: it moves, each frame has its values.</summary>
        public float[] Values;
    }

    /// <summary>How to encode. 0 in every field: by default, see anic_encode_options and anic_live_options.</summary>
    public struct LiveOptions
    {
        public string Name;

        /// <summary>Frames per second = RateNumerator / RateDenominator; 0 as denominator counts as 1.</summary>
        public uint RateNumerator, RateDenominator;

        public UpAxis Up;
        public double StartTime, MetresPerUnit;

        /// <summary>The target; by default a largest error of 0.05 %.</summary>
        public Goal Goal;
        public double GoalValue;

        /// <summary>The goal is a length in per cent of Box.</summary>
        public bool Percent;

        /// <summary>Diagonal that per cent are of; 0: that of the first file's frames, which is smaller than the clip's.</summary>
        public double Box;

        /// <summary>Largest error of attributes that move.</summary>
        public double AttributeError;

        /// <summary>Fast is fast enough for 10,000 vertices at 30 frames a second.</summary>
        public Effort Effort;

        public int Threads;

        /// <summary>Seconds of a file; 0: 1.</summary>
        public double PieceSeconds;

        /// <summary>A file begins anew so many seconds after the last that did; 0: 4, below 0: every file does.</summary>
        public double KeySeconds;

        /// <summary>Frames that wait for being encoded at most, at least those of a file; 0: any number.</summary>
        public long MostWaitingFrames;
    }

    /// <summary>A file of a live stream.</summary>
    public sealed class LivePiece
    {
        public byte[] File;
        public long FirstFrame;
        public int FrameCount;
        public double StartTime, EncodeSeconds, MaxError, Rmse, Kg;

        /// <summary>It begins anew: whoever has lost a file goes on here.</summary>
        public bool Key;

        /// <summary>It is no continuation: whoever joins needs the last of these, and then a key.</summary>
        public bool HasMesh;
    }

    /// <summary>How far a live encoder is.</summary>
    public struct LiveInfo
    {
        public long PushedFrames;

        /// <summary>Frames of which no file is made yet.</summary>
        public long WaitingFrames;

        /// <summary>The waiting frames of full files that are not begun: 0 while it keeps up, else how far it is behind.</summary>
        public long LateFrames;

        /// <summary>Files made, and not taken.</summary>
        public long WaitingPieces;

        /// <summary>That the last file took.</summary>
        public double EncodeSeconds;

        public int PieceFrames;

        /// <summary>All files are taken.</summary>
        public bool Ended;
    }

    /// <summary>The encoder, of the library libanicodec_encoder.</summary>
    public static class Encoder
    {
        /// <summary>Begins to encode a capture while it goes on.</summary>
        /// <exception cref="AnicException">what is given makes no sense</exception>
        public static LiveEncoder Live(LiveMesh mesh, LiveOptions options = default(LiveOptions))
        {
            return new LiveEncoder(mesh, options);
        }
    }

    /// <summary>
    /// Frames in, files of a live stream out; AssetStream plays them. A thread of the library encodes. One thread may push while
    /// another takes.
    /// </summary>
    public sealed unsafe class LiveEncoder : IDisposable
    {
        private readonly LiveHandle handle;
        private readonly int[] valueCounts;  // of each attribute that moves
        private readonly int vertexCount;

        internal LiveEncoder(LiveMesh mesh, LiveOptions options)
        {
            vertexCount = mesh.VertexCount;
            List<int> counts = new List<int>();
            EncoderHandle encoder;
            Native.Check(NativeEncoder.anic_create_encoder(out encoder));
            using (encoder)
            {
                SetClip(encoder, options);
                AddMesh(encoder, mesh);
                foreach (LiveAttribute attribute in mesh.Attributes)
                {
                    int count = CountOf(mesh, attribute);
                    if (attribute.Values == null)
                        counts.Add(count);
                    else if (attribute.Values.Length != count)
                        throw new AnicException(Status.Argument, attribute.Name + " has " + attribute.Values.Length + " of " + count + " values");
                    AddAttribute(encoder, attribute);
                }
                handle = Begin(encoder, options);
            }
            valueCounts = counts.ToArray();
        }

        public void Dispose()
        {
            handle.Dispose();
        }

        /// <summary>Adds a frame: x, y, z of each vertex, and of each attribute that moves its values, in their order.</summary>
        /// <returns>false where in so many seconds there is no room: nothing was taken</returns>
        /// <exception cref="AnicException">what does not fit or is not finite: nothing was taken; what ended the encoding</exception>
        public bool Push(ReadOnlySpan<float> positions, float[][] values = null, double wait = 0)
        {
            int count = values == null ? 0 : values.Length;
            if (positions.Length != 3 * vertexCount || count != valueCounts.Length)
                throw new AnicException(Status.Argument, "a frame has " + positions.Length + " coordinates of " + 3 * vertexCount +
                    ", and values of " + count + " attributes of " + valueCounts.Length);
            GCHandle[] pins = new GCHandle[count];
            float** addresses = stackalloc float*[count + 1];
            try
            {
                for (int i = 0; i < count; ++i)
                {
                    if (values[i].Length != valueCounts[i])
                        throw new AnicException(Status.Argument, "attribute " + i + " has " + values[i].Length + " of " + valueCounts[i] + " values");
                    pins[i] = GCHandle.Alloc(values[i], GCHandleType.Pinned);
                    addresses[i] = (float*)pins[i].AddrOfPinnedObject();
                }
                fixed (float* first = positions)
                {
                    NativeEncoder.anic_live_frame frame = default(NativeEncoder.anic_live_frame);
                    frame.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_live_frame);
                    frame.positions = first;
                    frame.value_count = (uint)count;
                    frame.values = addresses;
                    return Check(NativeEncoder.anic_push_live_frame(handle, &frame, wait), Status.Limit);
                }
            }
            finally
            {
                foreach (GCHandle pin in pins)
                {
                    if (pin.IsAllocated)
                        pin.Free();
                }
            }
        }

        /// <summary>No frame follows: the last file gets those that are there.</summary>
        public void End()
        {
            Check(NativeEncoder.anic_end_live(handle), Status.Ok);
        }

        /// <summary>The next file once it is made; null where none is in so many seconds, or all are taken.</summary>
        /// <exception cref="AnicException">what ended the encoding, once all files before are taken</exception>
        public LivePiece Take(double wait = 0)
        {
            NativeEncoder.anic_live_piece piece = default(NativeEncoder.anic_live_piece);
            piece.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_live_piece);
            if (!Check(NativeEncoder.anic_take_live_piece(handle, wait, &piece), Status.Absent))
                return null;
            byte[] file = new byte[(int)piece.size];
            Marshal.Copy((IntPtr)piece.file, file, 0, file.Length);
            return new LivePiece
            {
                File = file, FirstFrame = (long)piece.first_frame, FrameCount = (int)piece.frame_count, StartTime = piece.start_time,
                EncodeSeconds = piece.encode_seconds, MaxError = piece.max_error, Rmse = piece.rmse, Kg = piece.kg,
                Key = piece.key != 0, HasMesh = piece.has_mesh != 0
            };
        }

        /// <summary>All files, each as soon as it is made, until End() was called and all are taken.</summary>
        public IEnumerable<LivePiece> TakeAll()
        {
            for (LivePiece piece; (piece = Take(double.PositiveInfinity)) != null;)
                yield return piece;
        }

        public LiveInfo Info
        {
            get
            {
                NativeEncoder.anic_live_info info = default(NativeEncoder.anic_live_info);
                info.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_live_info);
                Native.Check(NativeEncoder.anic_get_live_info(handle, &info));
                return new LiveInfo
                {
                    PushedFrames = (long)info.pushed_frames, WaitingFrames = (long)info.waiting_frames, LateFrames = (long)info.late_frames,
                    WaitingPieces = (long)info.waiting_pieces, EncodeSeconds = info.encode_seconds, PieceFrames = (int)info.piece_frames,
                    Ended = info.ended != 0
                };
            }
        }

        /// <summary>True for Ok, false for the status that is no error; throws others.</summary>
        private static bool Check(Status status, Status expected)
        {
            if (status != Status.Ok && status != expected)
                throw new AnicException(status, Native.Text(NativeEncoder.anic_get_live_text()));
            return status == Status.Ok;
        }

        private static void Check(EncoderHandle encoder, Status status)
        {
            if (status != Status.Ok)
                throw new AnicException(status, Native.Text(NativeEncoder.anic_get_encoder_text(encoder)));
        }

        private static byte[] Utf8(string text)
        {
            return Encoding.UTF8.GetBytes((text ?? "") + "\0");
        }

        private static int CountOf(LiveMesh mesh, LiveAttribute attribute)
        {
            int polygons = mesh.Offsets == null ? mesh.Corners.Length / 3 : mesh.Offsets.Length - 1;
            int elements = attribute.Domain == Domain.Vertices ? mesh.VertexCount
                : attribute.Domain == Domain.Corners ? mesh.Corners.Length : polygons;
            return elements * attribute.Components;
        }

        private static void SetClip(EncoderHandle encoder, LiveOptions options)
        {
            NativeEncoder.anic_source_clip clip = default(NativeEncoder.anic_source_clip);
            clip.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_source_clip);
            clip.rate_numerator = options.RateNumerator;
            clip.rate_denominator = options.RateDenominator;
            clip.up = options.Up;
            clip.start_time = options.StartTime;
            clip.metres_per_unit = options.MetresPerUnit;
            fixed (byte* name = Utf8(options.Name))
            {
                clip.name = name;
                Check(encoder, NativeEncoder.anic_set_source_clip(encoder, &clip));
            }
        }

        private static void AddMesh(EncoderHandle encoder, LiveMesh mesh)
        {
            NativeEncoder.anic_source_mesh host = default(NativeEncoder.anic_source_mesh);
            host.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_source_mesh);
            host.vertex_count = (uint)mesh.VertexCount;
            int polygons = mesh.Offsets == null ? mesh.Corners.Length / 3 : mesh.Offsets.Length - 1;
            if (mesh.Offsets == null ? mesh.Corners.Length % 3 != 0 : polygons < 0 || mesh.Offsets[polygons] != mesh.Corners.Length)
                throw new AnicException(Status.Argument, "the offsets of the polygons do not fit the corners");
            host.polygon_count = (uint)polygons;
            fixed (uint* offsets = mesh.Offsets, corners = mesh.Corners)
            {
                host.offsets = offsets;
                host.corners = corners;
                Check(encoder, NativeEncoder.anic_add_source_mesh(encoder, &host, null));
            }
        }

        private static void AddAttribute(EncoderHandle encoder, LiveAttribute attribute)
        {
            NativeEncoder.anic_source_attribute host = default(NativeEncoder.anic_source_attribute);
            host.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_source_attribute);
            host.kind = attribute.Kind;
            host.domain = attribute.Domain;
            host.components = (uint)attribute.Components;
            fixed (byte* name = Utf8(attribute.Name))
            fixed (float* values = attribute.Values)
            {
                host.name = name;
                host.values = values;
                Check(encoder, NativeEncoder.anic_add_source_attribute(encoder, 0, &host));
            }
        }

        private static LiveHandle Begin(EncoderHandle encoder, LiveOptions options)
        {
            NativeEncoder.anic_encode_options encode = default(NativeEncoder.anic_encode_options);
            encode.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_encode_options);
            encode.goal = options.Goal;
            encode.goal_value = options.GoalValue;
            encode.flags = options.Percent ? (ulong)NativeEncoder.EncodeFlags.Percent : 0;
            encode.attribute_error = options.AttributeError;
            encode.effort = options.Effort;
            encode.threads = (uint)options.Threads;
            NativeEncoder.anic_live_options live = default(NativeEncoder.anic_live_options);
            live.struct_size = (UIntPtr)sizeof(NativeEncoder.anic_live_options);
            live.piece_seconds = options.PieceSeconds;
            live.key_seconds = options.KeySeconds;
            live.box = options.Box;
            live.most_waiting_frames = (ulong)options.MostWaitingFrames;
            LiveHandle made;
            Check(encoder, NativeEncoder.anic_begin_live(encoder, &encode, &live, out made));
            return made;
        }
    }
}
