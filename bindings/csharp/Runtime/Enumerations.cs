// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The enumerations of anicodec.h. A test compares names and numbers.
using System;

namespace Anicodec
{
    /// <summary>Tells what went wrong; anic_status.</summary>
    public enum Status
    {
        Ok = 0,
        Argument = 1, State = 2, BufferSize = 3, FrameRange = 4, Absent = 5,
        Magic = 10, Version = 11, Feature = 12,
        Truncated = 20, Header = 21, HeaderChecksum = 22, ChunkBounds = 23, ChunkChecksum = 24, ChunkDuplicate = 25,
        ChunkMissing = 26, ChunkUnknown = 27, TrailingBytes = 29, FileSize = 30,
        Record = 40, Entropy = 41, Zstd = 42, Topology = 43, IndexRange = 44, Quantizer = 45, NonFinite = 46, Draco = 47,
        Segment = 48, Hash = 49, Meshes = 50, SegmentMissing = 51,
        Limit = 60,
        Memory = 70, Read = 71, Cancelled = 72,
        Internal = 90
    }

    /// <summary>The axis that points up.</summary>
    public enum UpAxis { Unknown = 0, Y = 1, Z = 2 }

    /// <summary>The target of an encoder: the default is a largest error of 0.05 %.</summary>
    public enum Goal { Default = 0, MaxError = 1, Kg = 2, Rmse = 3, Size = 4, Bpfv = 5, Displacement = 6, Sted = 7 }

    /// <summary>How much of the source's order the file keeps.</summary>
    public enum VertexOrder { Vertices = 0, Free = 1, All = 2 }

    /// <summary>How long to search for a small file.</summary>
    public enum Effort { Normal = 0, Fast = 1, Best = 2 }

    public enum AttributeKind { Uv = 0, Normal = 1, Tangent = 2, Colour = 3, Custom = 4, Material = 5, Part = 6 }

    /// <summary>The elements that have a value each.</summary>
    public enum Domain { Vertices = 0, Corners = 1, Polygons = 2 }

    /// <summary>How much of a surface lets light through.</summary>
    public enum AlphaMode { Opaque = 0, Mask = 1, Blend = 2 }

    /// <summary>The picture between two frames.</summary>
    public enum Sampling { Step = 0, Linear = 1, Cubic = 2 }

    /// <summary>The picture before the first frame and after the last one.</summary>
    public enum Wrap { Clamp = 0, Loop = 1, PingPong = 2 }

    /// <summary>The time of the last seek, or of the one before.</summary>
    public enum When { Current = 0, Previous = 1 }

    /// <summary>A side of triangles: corners run counter-clockwise on the front.</summary>
    public enum Side { Any = 0, Front = 1, Back = 2 }

    /// <summary>How a position or normal is stored.</summary>
    public enum VertexFormat
    {
        Float32x3 = 0, Float32x4 = 1, Float16x3 = 2, Float16x4 = 3, Unorm16x3 = 4, Unorm16x4 = 5, Snorm16x3 = 6, Snorm16x4 = 7
    }

    /// <summary>How a value of an attribute is stored.</summary>
    public enum ValueFormat { Float32 = 0, Float16 = 1, Unorm8 = 2, Unorm16 = 3 }

    public enum BasisKind { Keyframes = 0, Eigenshapes = 1, Eigentrajectories = 2 }

    /// <summary>Vertices or values that a basis moves.</summary>
    public enum Target { Positions = 0, Attribute = 1 }

    /// <summary>How positions come from a basis.</summary>
    public enum Reconstruction { Linear = 0, Msgi = 1 }

    /// <summary>Textures of a basis, of four numbers a texel: float32, int32, int16.</summary>
    public enum BasisTexture { Pose = 0, Wide = 1, Narrow = 2 }

    /// <summary>How to open a file; ANIC_OPEN_...</summary>
    [Flags]
    public enum OpenFlags { None = 0, Bounds = 1, AnyOrder = 2, InPlace = 4, Inexact = 8 }
}
