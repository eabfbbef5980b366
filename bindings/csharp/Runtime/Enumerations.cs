// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// bindings/generate wrote this from the headers.
using System;

namespace Anicodec
{
    /// <summary>A number keeps its meaning for good. Spec: 12.</summary>
    public enum Status
    {
        Ok = 0,
        /// <summary>An argument makes no sense.</summary>
        Argument = 1,
        /// <summary>The call is not possible now.</summary>
        State = 2,
        /// <summary>a buffer of the caller is too small.</summary>
        BufferSize = 3,
        /// <summary>There is no such frame.</summary>
        FrameRange = 4,
        /// <summary>The mesh is not there at this time.</summary>
        Absent = 5,
        Magic = 10,
        Version = 11,
        Feature = 12,
        Truncated = 20,
        Header = 21,
        HeaderChecksum = 22,
        ChunkBounds = 23,
        ChunkChecksum = 24,
        ChunkDuplicate = 25,
        ChunkMissing = 26,
        ChunkUnknown = 27,
        TrailingBytes = 29,
        FileSize = 30,
        Record = 40,
        Entropy = 41,
        Zstd = 42,
        Topology = 43,
        IndexRange = 44,
        Quantizer = 45,
        NonFinite = 46,
        Draco = 47,
        /// <summary>a segment contradicts its counts or its mesh.</summary>
        Segment = 48,
        Hash = 49,
        /// <summary>a continuation of a live stream follows a file with other meshes.</summary>
        Meshes = 50,
        /// <summary>A file of a live stream continues one that was lost, or not opened in full.</summary>
        SegmentMissing = 51,
        /// <summary>More than anic_options allow.</summary>
        Limit = 60,
        /// <summary>The allocator had no memory.</summary>
        Memory = 70,
        /// <summary>The read callback failed.</summary>
        Read = 71,
        /// <summary>The progress callback stopped the call.</summary>
        Cancelled = 72,
        /// <summary>a defect of the library.</summary>
        Internal = 90,
    }

    /// <summary>ANIC_OPEN_...</summary>
    [Flags]
    public enum OpenFlags
    {
        None = 0,
        /// <summary>Computes the box of every frame while opening, for anic_get_frame_bounds() and anic_get_clip_bounds(). This
        /// costs what playing all frames once does, and 24 bytes for each frame and mesh.</summary>
        Bounds = 1,
        /// <summary>Leaves the order of the source's vertices and polygons alone: they come as in a file of ANIC_ORDER_FREE.
        /// Opening is faster by what decoding the order takes, a microsecond or more for each vertex; for hosts that take faces
        /// and attributes from the asset too.</summary>
        AnyOrder = 2,
        /// <summary>Leaves the motion of the whole out of positions, parts and boxes, in clips that have it apart, for hosts that
        /// move the character themselves: anic_get_root_motion(). Nothing changes in others. Spec: 06, section 11.</summary>
        InPlace = 4,
        /// <summary>Leaves the positions of a lossless file closed and plays all frames from its basis, at the memory and the
        /// time of opening of other files; anic_clip then states errors of 0 that do not hold. Nothing changes in other files. A
        /// quality below 1 does the same. Spec: 09d.</summary>
        Inexact = 8,
    }

    /// <summary>The axis that points up.</summary>
    public enum UpAxis
    {
        Unknown = 0,
        Y = 1,
        Z = 2,
    }

    /// <summary>How much of the source's order the file keeps. It has every source vertex in any case. Spec: 06, section
    /// 5.</summary>
    public enum VertexOrder
    {
        /// <summary>Vertices are numbered as in the source.</summary>
        Vertices = 0,
        /// <summary>The encoder chose the order of vertices and polygons.</summary>
        Free = 1,
        /// <summary>Vertices, polygons and their first corners as in the source.</summary>
        All = 2,
    }

    /// <summary>The meaning of an attribute. Numbers are fixed. Spec: 06, section 10.</summary>
    public enum AttributeKind
    {
        /// <summary>v upwards: (0, 0) is the lower left corner of an image; some graphics interfaces want 1 - v.</summary>
        Uv = 0,
        /// <summary>First frame's normals. Without components: labels that say which corners share a normal, that is, which edges
        /// are hard.</summary>
        Normal = 1,
        Tangent = 2,
        /// <summary>RGB or RGBA, 0 to 1.</summary>
        Colour = 3,
        Custom = 4,
        /// <summary>Names of the polygons' materials.</summary>
        Material = 5,
        /// <summary>Names of the source's meshes or objects, for polygons.</summary>
        Part = 6,
    }

    /// <summary>The elements that have a value each, as anic_get_polygons() numbers them.</summary>
    public enum Domain
    {
        Vertices = 0,
        Corners = 1,
        Polygons = 2,
    }

    /// <summary>How a surface lets light through.</summary>
    public enum AlphaMode
    {
        Opaque = 0,
        /// <summary>All where the base colour's alpha is below alpha_cutoff, else nothing.</summary>
        Mask = 1,
        Blend = 2,
    }

    /// <summary>The picture between two frames. Spec: 10, section 2.</summary>
    public enum Sampling
    {
        /// <summary>The frame before.</summary>
        Step = 0,
        /// <summary>a straight line from the frame before to the frame after.</summary>
        Linear = 1,
        /// <summary>a smooth curve through four frames (Catmull-Rom; knows uneven times).</summary>
        Cubic = 2,
    }

    /// <summary>The picture before the first frame and after the last one.</summary>
    public enum Wrap
    {
        /// <summary>The first and the last frame stay.</summary>
        Clamp = 0,
        /// <summary>Frame 0 follows the last frame; if info.closed, they are one.</summary>
        Loop = 1,
        /// <summary>Backwards after the last frame, forwards after the first.</summary>
        PingPong = 2,
    }

    /// <summary>One of the two times that a context knows.</summary>
    public enum When
    {
        /// <summary>Chosen by the last seek.</summary>
        Current = 0,
        /// <summary>Chosen by the seek before, for motion vectors; the same as the current time after the first seek.</summary>
        Previous = 1,
    }

    /// <summary>How a position or normal is stored, in the machine's byte order. Formats of four components have 1 as the last
    /// one. The 16-bit formats store t = (x - offset) / scale: FLOAT16 as IEEE binary16, rounded to nearest; UNORM16 as
    /// round(65535 t), t clamped to 0 .. 1; SNORM16 as round(32767 t), t clamped to -1 .. 1.</summary>
    public enum VertexFormat
    {
        Float32x3 = 0,
        Float32x4 = 1,
        Float16x3 = 2,
        Float16x4 = 3,
        Unorm16x3 = 4,
        Unorm16x4 = 5,
        Snorm16x3 = 6,
        Snorm16x4 = 7,
    }

    /// <summary>How a value of an attribute is stored, in the machine's byte order.</summary>
    public enum ValueFormat
    {
        Float32 = 0,
        /// <summary>IEEE binary16, rounded to nearest.</summary>
        Float16 = 1,
        /// <summary>Round(255 x), x clamped to 0 .. 1.</summary>
        Unorm8 = 2,
        /// <summary>Round(65535 x), x clamped to 0 .. 1.</summary>
        Unorm16 = 3,
    }

    /// <summary>A side of triangles.</summary>
    public enum Side
    {
        Any = 0,
        /// <summary>Its corners run counter-clockwise.</summary>
        Front = 1,
        Back = 2,
    }

    /// <summary>How the basis of a segment was found.</summary>
    public enum BasisKind
    {
        Keyframes = 0,
        Eigenshapes = 1,
        Eigentrajectories = 2,
    }

    /// <summary>Vertices or values that a basis moves.</summary>
    public enum Target
    {
        /// <summary>The positions of a mesh.</summary>
        Positions = 0,
        /// <summary>Three components of an attribute, or fewer, of its elements in place of vertices.</summary>
        Attribute = 1,
    }

    /// <summary>How positions come from a basis.</summary>
    public enum Reconstruction
    {
        /// <summary>a linear combination.</summary>
        Linear = 0,
        /// <summary>Multi-scale geometry interpolation between key-frames, see anic_part.shape. Spec: 09c.</summary>
        Msgi = 1,
    }

    /// <summary>Textures that hold the basis of a segment for shaders, of four numbers a texel.</summary>
    public enum BasisTexture
    {
        /// <summary>Float32: x, y, z, region.</summary>
        Pose = 0,
        /// <summary>Int32.</summary>
        Wide = 1,
        /// <summary>Int16.</summary>
        Narrow = 2,
    }

    /// <summary>The promise that the file keeps. Spec: 04, section 4.</summary>
    public enum Goal
    {
        /// <summary>With `keyframes` none, else a largest error of 0.05 %.</summary>
        Default = 0,
        /// <summary>Largest distance of any vertex of any frame from its place.</summary>
        MaxError = 1,
        /// <summary>KG error in per cent.</summary>
        Kg = 2,
        /// <summary>Root of the mean squared error.</summary>
        Rmse = 3,
        /// <summary>Bytes, with the smallest error; of one mesh alone.</summary>
        Size = 4,
        /// <summary>Bits per frame and vertex, with the smallest error.</summary>
        Bpfv = 5,
        /// <summary>Largest error of any vertex's move from frame to frame.</summary>
        Displacement = 6,
        /// <summary>STED, an error as viewers see it; of every mesh and clip.</summary>
        Sted = 7,
    }

    /// <summary>How long to search for a small file. Means of five clips at KG 0.1 %, of which README has more.</summary>
    public enum Effort
    {
        Normal = 0,
        /// <summary>a third of the time, for 29 % more bytes.</summary>
        Fast = 1,
        /// <summary>1.8 times the time, for 2 % fewer; the file may take longer to open.</summary>
        Best = 2,
    }
}
