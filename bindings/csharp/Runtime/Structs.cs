// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using System.Runtime.InteropServices;

namespace Anicodec
{
    [StructLayout(LayoutKind.Sequential)]
    public struct Point
    {
        public float X, Y, Z;
    }

    /// <summary>An axis-aligned box.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Box
    {
        public Point Min, Max;
    }

    /// <summary>A point of the surface: vertices of a triangle, counter-clockwise seen from its front, and barycentric coordinates
    /// in it, whose sum is 1.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SurfacePoint
    {
        public uint A, B, C;
        public float WeightOfA, WeightOfB, WeightOfC;
    }

    /// <summary>Axes at a point of the surface, of length 1; the third one is normal x tangent.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SurfaceFrame
    {
        public Point Position;
        /// <summary>The normal of the triangle, on its front.</summary>
        public Point Normal;
        /// <summary>From the triangle's first vertex to the second one.</summary>
        public Point Tangent;
    }

    /// <summary>The first point of the surface on a ray.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Hit
    {
        public SurfacePoint Point;
        /// <summary>From the origin, in lengths of the ray's direction; infinite when nothing was hit.</summary>
        public float Distance;
        /// <summary>Its number in the list; uint.MaxValue when nothing was hit.</summary>
        public uint Triangle;
        public Side Side;
    }

    /// <summary>Moves one vertex in one frame, after everything else.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Correction
    {
        public uint Vertex;
        public Point Delta;
    }

    /// <summary>How to open a file. 0 in every field: by default. anic_options describes them.</summary>
    public struct OpenOptions
    {
        public ulong MaxVertices, MaxFrames, MaxComponents, MaxBytes;

        /// <summary>Share of the components to open, in (0, 1]; 0 means 1.</summary>
        public double Quality;

        public OpenFlags Flags;

        /// <summary>Names of the clips to open; null: all.</summary>
        public string[] Clips;
    }

    /// <summary>Memory that a file takes; anic_requirements.</summary>
    public struct Requirements
    {
        public ulong HeadBytes, FileBytes, ResidentBytes, OpeningBytes, DracoBytes, BlockBytes, ContextBytes;
        public int MeshCount, SegmentCount, FrameCount, MaxVertices, MaxComponents;
    }

    /// <summary>A clip: frames FirstFrame .. FirstFrame + FrameCount - 1 of the file; anic_clip.</summary>
    public sealed class ClipInfo
    {
        public string Name;
        public int FirstFrame, FrameCount;
        public double FramesPerSecond;
        public bool Uneven, Loop, Closed, Open;

        /// <summary>Seconds, from the first to the last frame.</summary>
        public double Duration;

        /// <summary>Seconds of one turn of Wrap.Loop.</summary>
        public double LoopDuration;

        public double StartTime, Diagonal, MaxError;
    }

    /// <summary>A named time of a clip; anic_event.</summary>
    public struct ClipEvent
    {
        public string Name;

        /// <summary>From the clip's first frame on.</summary>
        public double Seconds;
    }

    /// <summary>The motion of the whole at a time; anic_root_motion. Vectors are those of the clip's axes.</summary>
    public struct RootMotion
    {
        public bool Moves, Turns;

        /// <summary>Radians about the up axis, counter-clockwise seen from above.</summary>
        public double Turn;

        public double MoveX, MoveY, MoveZ, PivotX, PivotY, PivotZ;
    }

    /// <summary>A mesh; anic_mesh.</summary>
    public sealed class MeshInfo
    {
        public string Name;
        public int VertexCount, CodedVertexCount, PolygonCount, CornerCount, TriangleCount, AttributeCount;
    }

    /// <summary>An attribute as in frame 0; anic_attribute. Its spans are good as long as the asset is open.</summary>
    public unsafe ref struct Attribute
    {
        public string Name;
        public AttributeKind Kind;
        public Domain Domain;

        /// <summary>Elements, and numbers of each.</summary>
        public int Count, Components;

        /// <summary>Count x Components; empty without components.</summary>
        public ReadOnlySpan<float> Values;

        /// <summary>Count; empty with components.</summary>
        public ReadOnlySpan<uint> Labels;

        public int LabelCount;
        public bool Moves;
    }

    /// <summary>The look of a material, in the terms of glTF 2.0; anic_material. Textures are paths or names, or empty.</summary>
    public sealed class MaterialLook
    {
        public string Name;

        /// <summary>Linear red, green, blue and alpha.</summary>
        public float[] BaseColour;

        public float Metallic, Roughness;

        /// <summary>Linear red, green and blue.</summary>
        public float[] Emissive;

        public AlphaMode Alpha;
        public float AlphaCutoff;
        public bool DoubleSided;
        public string BaseColourTexture, MetallicRoughnessTexture, NormalTexture, OcclusionTexture, EmissiveTexture;
    }

    /// <summary>The basis of a segment, for a graphics card; anic_basis. Good as long as the asset is open.</summary>
    public unsafe ref struct Basis
    {
        public BasisKind Kind;
        public Reconstruction Reconstruction;
        public Target Target;
        public int Mesh, FirstFrame, FrameCount, VertexCount, Components, WideComponents, Channels, WeightChannels;
        public Point Origin;
        public ReadOnlySpan<float> Pose;
        public ReadOnlySpan<int> Wide;
        public ReadOnlySpan<short> Narrow;

        /// <summary>Regions of the surface, each with weights and a pose map of its own.</summary>
        public int Regions;

        /// <summary>Region of each vertex; empty: all are of region 0.</summary>
        public ReadOnlySpan<byte> VertexRegion;
    }

    /// <summary>How a basis lies in textures; anic_texture_layout.</summary>
    public struct TextureLayout
    {
        internal Native.anic_texture_layout native;

        public int Width { get { return (int)native.width; } }
        public int Rows { get { return (int)native.rows; } }

        /// <summary>Rows of a texture; 0: there is none.</summary>
        public int Height(BasisTexture texture)
        {
            return (int)(texture == BasisTexture.Pose ? native.pose_height
                : texture == BasisTexture.Wide ? native.wide_height : native.narrow_height);
        }

        /// <summary>Floats that Context.WriteState() writes.</summary>
        public int StateFloats { get { return (int)native.state_floats; } }

        /// <summary>States of so many regions follow one another in them.</summary>
        public int Regions { get { return (int)native.regions; } }
    }

    /// <summary>
    /// One summand of what a context shows, for a graphics card; anic_part. Good until the next but one seek.
    /// </summary>
    public unsafe ref struct Part
    {
        public int Segment;

        /// <summary>The position is the sum of Share * x over the parts.</summary>
        public float Share;

        public ReadOnlySpan<float> Weights;

        /// <summary>Weights of a region, of which Weights are those of region 0.</summary>
        public ReadOnlySpan<float> RegionWeights(int region)
        {
            return new ReadOnlySpan<float>(weights + region * regionStride, Weights.Length);
        }

        /// <summary>The matrix of the pose of a region, of which PoseMap is that of region 0.</summary>
        public ReadOnlySpan<float> RegionPoseMap(int region)
        {
            return new ReadOnlySpan<float>(poseMaps + 12 * region, 12);
        }

        internal float* weights, poseMaps;
        internal int regionStride;

        /// <summary>Three floats for each point; empty unless the basis is of Reconstruction.Msgi.</summary>
        public ReadOnlySpan<float> Shape;

        /// <summary>Matrices of three rows of four.</summary>
        public fixed float PoseMap[12], Motion[12];

        public ReadOnlySpan<Correction> Corrections;
    }

    /// <summary>The place for positions or normals, at an address of the host; anic_output.</summary>
    public unsafe struct Output
    {
        internal Native.anic_output native;

        /// <param name="data">of the first element asked for</param>
        /// <param name="size">bytes that may be written</param>
        /// <param name="stride">bytes from an element to the next; 0: packed</param>
        public Output(void* data, long size, VertexFormat format = VertexFormat.Float32x3, int stride = 0)
        {
            native = default(Native.anic_output);
            native.struct_size = (UIntPtr)sizeof(Native.anic_output);
            native.data = data;
            native.size = (UIntPtr)size;
            native.stride = (UIntPtr)stride;
            native.format = format;
        }

        /// <summary>Offset and scale of the 16-bit formats, for positions in a box.</summary>
        public Output Within(Box box)
        {
            Output result = this;
            bool centred = native.format >= VertexFormat.Snorm16x3;
            result.Set(0, box.Min.X, box.Max.X, centred);
            result.Set(1, box.Min.Y, box.Max.Y, centred);
            result.Set(2, box.Min.Z, box.Max.Z, centred);
            return result;
        }

        private void Set(int axis, float min, float max, bool centred)
        {
            fixed (float* offset = native.offset, scale = native.scale)
            {
                offset[axis] = centred ? min + (max - min) / 2 : min;
                scale[axis] = centred ? (max - min) / 2 : max - min;
            }
        }
    }

    /// <summary>How to make normals; anic_normal_plan_options, anic_render_plan_options.</summary>
    public struct NormalOptions
    {
        /// <summary>Degrees; 0: no edge is hard.</summary>
        public double CreaseAngle;

        public int ReferenceFrame;

        /// <summary>Normals for corners instead of vertices; of a NormalPlan.</summary>
        public bool PerCorner;

        /// <summary>The hard edges of the source, if the file tells.</summary>
        public bool SourceEdges;
    }
}
