// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C# package on conformance files. With --layout it prints its structs, functions and enumerations instead, which run.py
// compares with the header's.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using Anicodec;

internal static class PackageTest
{
    private static string folder;

    private static byte[] Bytes(string name)
    {
        return File.ReadAllBytes(Path.Combine(folder, name + ".anic"));
    }

    private static void OpensAndTells()
    {
        Requirements needs = Asset.GetRequirements(Bytes("limb_default"));
        using (Asset asset = Asset.Open(Path.Combine(folder, "limb_default.anic"), new OpenOptions { Flags = OpenFlags.Bounds }))
        {
            Check.That(asset.MeshCount == 1 && asset.FrameCount > 1 && asset.Diagonal > 0, "counts");
            Check.That(asset.FrameCount == needs.FrameCount && asset.GetMesh().VertexCount == needs.MaxVertices, "requirements");
            Check.That(asset.GetClip(0).FrameCount == asset.FrameCount && asset.ClipCount == 1, "one clip");
            Check.That(asset.FindClip("no such clip") == -1, "a clip that is not there");
            Box box;
            Check.That(asset.GetClipBounds(out box) && box.Min.X < box.Max.X, "bounds");
            uint[] indices = new uint[3 * asset.GetMesh().TriangleCount];
            asset.WriteIndices(indices);
            ushort[] small = new ushort[indices.Length];
            asset.WriteIndices(small);
            Check.That(indices.Max() < asset.GetMesh().VertexCount && small.Select(i => (uint)i).SequenceEqual(indices), "indices");
            ReadOnlySpan<uint> offsets, corners;
            asset.GetPolygons(0, out offsets, out corners);
            Check.That(offsets[asset.GetMesh().PolygonCount] == corners.Length, "polygons");
            Check.That(asset.GetCodedVertices().Length == asset.GetMesh().VertexCount, "coded vertices");
            Check.That(asset.ResidentBytes > 0 && asset.ContextBytes > 0 && Asset.LibraryVersion > 0, "figures");
            asset.Verify();
        }
    }

    private static void PlaysAndBlends()
    {
        using (Asset asset = Asset.Open(Bytes("clips")))
        using (Context context = new Context(asset))
        {
            int clips = asset.ClipCount;
            using (Asset alone = asset.Share(new OpenOptions { Clips = new[] { asset.GetClip(1).Name } }))
            {
                Check.That(alone.GetClip(1).Open && !alone.GetClip(0).Open && alone.ResidentBytes < 4096, "a shared asset");
                Check.Throws(Status.Absent, () => alone.Share(new OpenOptions { Clips = new[] { asset.GetClip(0).Name } }), "a clip that is not open");
            }
            Check.That(clips > 1 && asset.FindClip(asset.GetClip(1).Name) == 1, "several clips");
            float[] a = new float[3 * asset.GetMesh().VertexCount], b = new float[a.Length], c = new float[a.Length];
            context.SetClip(1);
            context.Seek(0);
            Check.That(context.WritePositions(a), "positions");
            context.SeekFrame(asset.GetClip(1).FirstFrame);
            context.WritePositions(b);
            Check.That(a.SequenceEqual(b), "time 0 of a clip is its first frame");
            context.Blend(0, 0, 1);
            context.WritePositions(b);
            context.WritePositions(c, 0, When.Previous);
            Check.That(c.SequenceEqual(a), "what was shown before");
            context.SeekFrame(asset.GetClip(0).FirstFrame);
            context.WritePositions(c);
            Check.That(b.SequenceEqual(c) && !a.SequenceEqual(c), "a blend of weight 1 shows the other clip");
            context.SeekFrame(asset.GetClip(1).FirstFrame);
            context.ForgetPrevious();
            context.WritePositions(b, 0, When.Previous);
            Check.That(b.SequenceEqual(a), "no motion after a cut");
            Box box;
            Check.That(context.ComputeBounds(out box) && a.Where((x, i) => i % 3 == 0).Min() == box.Min.X, "bounds");
            MeetsTheSurface(asset, context);
        }
    }

    private static void MeetsTheSurface(Asset asset, Context context)
    {
        uint[] triangles = new uint[3 * asset.GetMesh(0).TriangleCount];
        asset.WriteIndices(triangles);
        float[] work = new float[3 * asset.GetMesh(0).VertexCount];
        SurfacePoint middle = new SurfacePoint { A = triangles[0], B = triangles[1], C = triangles[2], WeightOfA = 0.25f, WeightOfB = 0.25f, WeightOfC = 0.5f };
        SurfaceFrame frame;
        Check.That(context.GetSurfaceFrame(middle, out frame), "axes of a point of the surface");
        Point n = frame.Normal, t = frame.Tangent, p = frame.Position;
        Check.That(Math.Abs(n.X * t.X + n.Y * t.Y + n.Z * t.Z) < 1e-5 && Math.Abs(n.X * n.X + n.Y * n.Y + n.Z * n.Z - 1) < 1e-5, "axes");
        Point above = new Point { X = p.X + 1e-3f * n.X, Y = p.Y + 1e-3f * n.Y, Z = p.Z + 1e-3f * n.Z };
        Point down = new Point { X = -n.X, Y = -n.Y, Z = -n.Z };
        Hit hit;
        Check.That(context.IntersectRay(above, down, triangles, work, out hit) && hit.Triangle == 0 && hit.Side == Side.Front &&
            Math.Abs(hit.Distance - 1e-3) < 1e-5 && Math.Abs(hit.Point.WeightOfC - 0.5) < 1e-2, "a ray from above the surface");
        Check.That(!context.IntersectRay(above, down, triangles, work, out hit, 1e-4f) && float.IsInfinity(hit.Distance), "a ray that is too short");
        Check.That(!context.IntersectRay(above, down, new ReadOnlySpan<uint>(triangles, 0, 3), work, out hit, 0, Side.Back), "the other side");
    }

    private static unsafe void MakesWhatACardNeeds()
    {
        using (Asset asset = Asset.Open(Bytes("painted_box")))
        using (Context context = new Context(asset))
        using (RenderPlan plan = new RenderPlan(asset, 0, new NormalOptions { CreaseAngle = 30 }))
        using (NormalPlan normals = new NormalPlan(asset))
        {
            context.Seek(0.1);
            float[] source = new float[3 * asset.GetMesh().VertexCount], positions = new float[3 * plan.VertexCount];
            context.WritePositions(source);
            plan.WritePositions(context, positions);
            for (int r = 0; r < plan.VertexCount; ++r)
                Check.That(positions[3 * r] == source[3 * plan.Vertices[r]], "render vertex " + r);
            float[] n = new float[positions.Length];
            plan.WriteNormals(positions, n);
            Check.That(Math.Abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-5, "normals of render vertices");
            float[] smooth = new float[3 * normals.Count];
            normals.WriteNormals(source, smooth);
            Check.That(Math.Abs(smooth[0] * smooth[0] + smooth[1] * smooth[1] + smooth[2] * smooth[2] - 1) < 1e-5, "normals");
            ushort[] halves = new ushort[4 * plan.VertexCount];
            fixed (ushort* first = halves)
            {
                Output to = new Output(first, 2 * halves.Length, VertexFormat.Snorm16x4);
                plan.WriteNormals((float*)Pin(positions), 0, ref to, 0, plan.VertexCount);
            }
            Check.That(halves[3] == 32767 && Math.Abs((short)halves[0] / 32767.0 - n[0]) < 1e-4, "normals of 16 bits");
            bool uv = false;
            for (int i = 0; i < asset.GetMesh().AttributeCount; ++i)
            {
                Anicodec.Attribute attribute = asset.GetAttribute(i);
                if (attribute.Kind == AttributeKind.Material)
                {
                    MaterialLook look = asset.GetMaterial(i, 0);
                    Check.That(look.Name == asset.GetLabelName(i, 0) && look.BaseColour.Length == 4 && look.Roughness <= 1, "a material");
                    Check.Throws(Status.Argument, () => asset.GetMaterial(i, 99), "no such material");
                }
                if (attribute.Kind != AttributeKind.Uv)
                    continue;
                uv = true;
                float[] values = new float[attribute.Components * plan.VertexCount];
                Check.That(plan.WriteAttribute(context, i, values) && values.Any(x => x != 0), "texture coordinates");
            }
            Check.That(uv, "the box has texture coordinates");
            Check.That(plan.GroupBegin[plan.GroupCount] == plan.TriangleCount && plan.Indices.Length == 3 * plan.TriangleCount, "groups");
        }
    }

    private static readonly List<GCHandle> pins = new List<GCHandle>();

    private static IntPtr Pin(float[] array)
    {
        pins.Add(GCHandle.Alloc(array, GCHandleType.Pinned));
        return pins[pins.Count - 1].AddrOfPinnedObject();
    }

    /// <summary>Positions as a shader would compute them, from the spans.</summary>
    private static unsafe void GivesTheBasis(string name)
    {
        using (Asset asset = Asset.Open(Bytes(name)))
        using (Context context = new Context(asset))
        {
            context.Seek(0.21);
            float[] expected = new float[3 * asset.GetMesh().VertexCount];
            context.WritePositions(expected);
            double worst = 0;
            for (int v = 0; v < asset.GetMesh().VertexCount; ++v)
            {
                double[] sum = new double[3];
                for (int p = 0; p < context.GetPartCount(); ++p)
                {
                    Part part = context.GetPart(p);
                    Basis basis = asset.GetBasis(part.Segment);
                    double[] x = { basis.Origin.X, basis.Origin.Y, basis.Origin.Z };
                    int b = v / 16, i = v % 16, narrow = basis.Components - basis.WideComponents;
                    int region = basis.VertexRegion.Length > 0 ? basis.VertexRegion[v] : 0;
                    ReadOnlySpan<float> weights = part.RegionWeights(region);
                    ReadOnlySpan<float> map = basis.Pose.Length > 0 ? part.RegionPoseMap(region) : default(ReadOnlySpan<float>);
                    for (int c = 0; c < 3 && basis.Pose.Length > 0; ++c)
                    {
                        for (int d = 0; d < 3; ++d)
                            x[c] += map[4 * c + d] * basis.Pose[(b * 3 + d) * 16 + i];
                        x[c] += map[4 * c + 3];
                    }
                    for (int j = 0; j < basis.Components; ++j)
                    {
                        for (int c = 0; c < 3; ++c)
                        {
                            int channel = basis.Channels == 3 ? c : 0;
                            double value = j < basis.WideComponents
                                ? basis.Wide[((b * basis.WideComponents + j) * basis.Channels + channel) * 16 + i]
                                : basis.Narrow[((b * narrow + j - basis.WideComponents) * basis.Channels + channel) * 16 + i];
                            x[c] += value * weights[basis.WeightChannels == 3 ? 3 * j + c : j];
                        }
                    }
                    for (int c = 0; c < 3; ++c)
                    {
                        double moved = part.Motion[4 * c + 3];
                        for (int d = 0; d < 3; ++d)
                            moved += part.Motion[4 * c + d] * x[d];
                        sum[c] += part.Share * moved;
                    }
                }
                for (int c = 0; c < 3; ++c)
                    worst = Math.Max(worst, Math.Abs(sum[c] - expected[3 * v + c]));
            }
            Check.That(worst < 1e-5 * asset.Diagonal, "positions from the basis: " + worst);
        }
    }

    private static void PlaysCoarserAndFillsTextures()
    {
        using (Asset asset = Asset.Open(Bytes("limb_default")))
        using (Context context = new Context(asset))
        {
            float[] fine = new float[3 * asset.GetMesh().VertexCount], coarse = new float[fine.Length];
            context.Seek(0.2);
            context.WritePositions(fine);
            context.SetQuality(0.3);
            context.Seek(0.2);
            context.WritePositions(coarse);
            Check.That(!fine.SequenceEqual(coarse), "fewer components");
            Part part = context.GetPart(0);
            Check.That(part.Weights.Length < asset.GetBasis(0).Components * asset.GetBasis(0).WeightChannels, "fewer weights");
            TextureLayout layout = asset.GetTextureLayout(0, 4096);
            byte[] texture = new byte[8 * layout.Width * layout.Height(BasisTexture.Narrow)];
            asset.WriteTexture(0, BasisTexture.Narrow, layout, texture);
            Check.That(BitConverter.ToInt16(texture, 0) == asset.GetBasis(0).Narrow[0], "the first number of the texture");
            float[] state = new float[layout.StateFloats];
            Check.That(context.WriteState(0, state) && state[26] == 1, "a share of one");
            Check.Throws(Status.Limit, () => asset.GetTextureLayout(0, 4), "a small texture");
        }
    }

    private static void ReadsStreams()
    {
        byte[] file = Bytes("limb_default");
        using (AssetStream stream = new AssetStream())
        {
            for (int at = 0; at < file.Length; at += 1000)
                stream.Push(new ReadOnlySpan<byte>(file, at, Math.Min(1000, file.Length - at)));
            Check.That(stream.Complete && stream.Playable && stream.FileBytes == file.Length, "a complete stream");
            using (Asset asset = stream.Open())
                asset.Verify();
            Check.Throws(Status.TrailingBytes, () => stream.Push(new byte[1]), "a byte too many");
        }
        byte[] live = Bytes("streams/live");
        using (AssetStream stream = new AssetStream())
        {
            Check.Throws(Status.State, () => stream.Advance(), "a file that is not complete");
            stream.Push(live);
            int frames = 0;
            for (; stream.Complete; stream.Advance())
            {
                Check.That(stream.FileNumber < 3 && (stream.WaitingBytes > 0) == (stream.FileNumber < 2), "the files of a stream");
                using (Asset asset = stream.Open())
                {
                    asset.Verify();
                    frames += asset.FrameCount;
                }
            }
            Check.That(frames == 20, "the frames of a stream");
        }
    }

    private static void RefusesWhatIsWrong()
    {
        byte[] file = Bytes("limb_default");
        Check.Throws(Status.Magic, () => Asset.Open(new byte[100]), "no file");
        file[file.Length / 2] ^= 1;
        Check.Throws(Status.ChunkChecksum, () => Asset.Open(file), "a damaged file");
        Check.Throws(Status.Limit, () => Asset.Open(Bytes("limb_default"), new OpenOptions { MaxVertices = 3 }), "a limit");
        Asset asset = Asset.Open(Bytes("limb_default"));
        Context context = new Context(asset);
        Check.Throws(Status.State, () => context.WritePositions(new float[3 * asset.GetMesh().VertexCount]), "nothing is chosen");
        context.Seek(0);
        Check.Throws(Status.BufferSize, () => context.WritePositions(new float[3]), "a small buffer");
        Check.Throws(Status.FrameRange, () => context.SeekFrame(100000), "no such frame");
        asset.Dispose();
        float[] points = new float[3 * 100000];
        context.Seek(0.1);  // a context keeps its asset
        context.Dispose();
        try
        {
            context.Seek(0);
            Check.That(false, "a context that is gone");
        }
        catch (ObjectDisposedException)
        {
            Check.That(true, "a context that is gone");
        }
        using (Asset scene = Asset.Open(Bytes("scene")))
        using (Context one = new Context(scene))
        {
            bool absent = false;
            for (int f = 0; f < scene.FrameCount; ++f)
            {
                one.SeekFrame(f);
                for (int m = 0; m < scene.MeshCount; ++m)
                    absent |= !one.WritePositions(points, m);
            }
            Check.That(absent, "a mesh that is not there is no error");
        }
    }

    private static void OpensNamedClips()
    {
        using (Asset all = Asset.Open(Bytes("clips")))
        using (Asset asset = Asset.Open(Bytes("clips"), new OpenOptions { Clips = new[] { all.GetClip(1).Name } }))
        {
            Check.That(!asset.GetClip(0).Open && asset.GetClip(1).Open, "one clip is open");
            using (Context context = new Context(asset))
                Check.Throws(Status.Absent, () => context.SetClip(0), "a clip that is not open");
        }
    }

    private static void Morphs()
    {
        float[] flat = { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, high = { 0, 0, 1, 1, 0, 1, 0, 1, 1 }, made = new float[9];
        using (Morpher morpher = new Morpher(new uint[] { 0, 1, 2 }, new[] { flat, high }))
        {
            morpher.Morph(new double[] { 0.5, 0.5 }, made);
            Check.That(Math.Abs(made[2] - 0.5f) < 1e-5, "half way: " + made[2]);
            Check.Throws(Status.Argument, () => morpher.Morph(new double[] { 1, 1 }, made), "weights that do not sum to one");
        }
    }

    /// <summary>A frame allocates nothing on the heap of the runtime.</summary>
    private static void AllocatesNothingPerFrame()
    {
        using (Asset asset = Asset.Open(Bytes("clips")))
        using (Context context = new Context(asset))
        using (RenderPlan plan = new RenderPlan(asset))
        {
            float[] points = new float[3 * asset.GetMesh().VertexCount], render = new float[3 * plan.VertexCount];
            float[] normals = new float[render.Length];
            long before = 0;
            for (int f = 0; f < 200; ++f)
            {
                if (f == 100)
                    before = GC.GetAllocatedBytesForCurrentThread();
                context.Seek(0.01 * f, Sampling.Linear, Wrap.Loop);
                context.Blend(1, 0.02 * f, 0.5);
                context.WritePositions(points);
                plan.WritePositions(context, render);
                plan.WriteNormals(render, normals);
                Check.That(context.GetPart(0).Share == 1, "one part");
                Box box;
                context.ComputeBounds(out box);
            }
            long bytes = GC.GetAllocatedBytesForCurrentThread() - before;
            Check.That(bytes == 0, "a hundred frames allocate " + bytes + " bytes");
        }
    }

    private static void FindsLibrariesByPlatform()
    {
        Type type = typeof(Asset).Assembly.GetType("Anicodec.NativeLibraries");
        string platform = (string)type.GetMethod("Platform").Invoke(null, null);
        string file = (string)type.GetMethod("FileName").Invoke(null, new object[] { "anicodec" });
        Check.That(platform.StartsWith("linux-") && file == "libanicodec.so", platform + " " + file);
        string root = Path.Combine(Path.GetTempPath(), "anicodec_" + Guid.NewGuid());
        MethodInfo find = type.GetMethod("Find");
        Check.That(find.Invoke(null, new object[] { root, "anicodec" }) == null, "none: as the system finds it");
        string packed = Path.Combine(root, "runtimes", platform, "native", file);
        Directory.CreateDirectory(Path.GetDirectoryName(packed));
        File.WriteAllBytes(packed, new byte[0]);
        Check.That((string)find.Invoke(null, new object[] { root, "anicodec" }) == packed, "beside the assembly");
        Directory.Delete(root, true);
    }

    /// <summary>A strip that waves, a frame at a time, with a heat of each vertex.</summary>
    private static void EncodesACapture()
    {
        const int Vertices = 60, Frames = 25;
        LiveMesh mesh = new LiveMesh { VertexCount = Vertices };
        mesh.Corners = Enumerable.Range(0, Vertices - 2).SelectMany(i => new[] { (uint)i, (uint)i + 1, (uint)i + 2 }).ToArray();
        mesh.Attributes.Add(new LiveAttribute { Name = "heat", Kind = AttributeKind.Custom, Components = 1 });
        LiveOptions options = new LiveOptions { RateNumerator = 10, Effort = Effort.Fast, Goal = Goal.MaxError, GoalValue = 0.001, Threads = 1, KeySeconds = 2 };
        using (LiveEncoder live = Encoder.Live(mesh, options))
        using (AssetStream stream = new AssetStream())
        {
            Check.That(live.Take() == null && live.Info.PieceFrames == 10 && !live.Info.Ended, "nothing yet");
            float[][] all = new float[Frames][];
            for (int f = 0; f < Frames; ++f)
            {
                float[] points = all[f] = new float[3 * Vertices], heat = new float[Vertices];
                for (int v = 0; v < Vertices; ++v)
                {
                    points[3 * v] = 0.1f * v;
                    points[3 * v + 1] = (float)Math.Sin(0.2 * v + 0.3 * f);
                    heat[v] = (float)Math.Cos(0.1 * v + 0.2 * f);
                }
                Check.That(live.Push(points, new[] { heat }), "room for a frame");
            }
            Check.Throws(Status.Argument, () => live.Push(new float[3]), "a frame of another mesh");
            Check.Throws(Status.Argument, () => live.Push(all[0]), "a frame without heat");
            live.End();
            List<LivePiece> pieces = live.TakeAll().ToList();
            Check.That(pieces.Count == 3 && live.Info.Ended && live.Info.PushedFrames == Frames, "three files");
            Check.That(pieces[0].HasMesh && pieces[0].Key && !pieces[1].HasMesh && !pieces[1].Key && pieces[2].Key, "what they are");
            Check.That(pieces[2].FirstFrame == 20 && pieces[2].FrameCount == 5 && pieces[2].StartTime == 2, "their place");
            int frame = 0;
            foreach (LivePiece piece in pieces)
            {
                if (frame > 0)
                    stream.Advance();
                stream.Push(piece.File);
                using (Asset asset = stream.Open())
                using (Context context = new Context(asset))
                {
                    float[] points = new float[3 * Vertices];
                    for (int f = 0; f < asset.FrameCount; ++f, ++frame)
                    {
                        context.SeekFrame(f);
                        context.WritePositions(points);
                        Check.That(points.Zip(all[frame], (a, b) => Math.Abs(a - b)).Max() <= 0.001f, "frame " + frame);
                    }
                }
            }
            Check.That(frame == Frames, "all frames");
        }
        Check.Throws(Status.Argument, () => Encoder.Live(mesh, new LiveOptions { Goal = Goal.Size, GoalValue = 100 }), "a size");
        mesh.Corners[0] = 99;
        Check.Throws(Status.IndexRange, () => Encoder.Live(mesh), "a corner that is no vertex");
    }

    private static void PrintLayout()
    {
        Assembly assembly = typeof(Asset).Assembly;
        Type[] natives = { assembly.GetType("Anicodec.Native"), assembly.GetType("Anicodec.NativeEncoder") };
        List<Type> structs = natives.SelectMany(t => t.GetNestedTypes(BindingFlags.Public | BindingFlags.NonPublic))
            .Where(t => t.Name.StartsWith("anic_")).ToList();
        foreach (Type t in structs)
        {
            Console.WriteLine("struct {0} {1}", t.Name, Marshal.SizeOf(t));
            foreach (FieldInfo f in t.GetFields(BindingFlags.Instance | BindingFlags.Public))
                Console.WriteLine("field {0} {1} {2}", t.Name, f.Name, Marshal.OffsetOf(t, f.Name));
        }
        foreach (MethodInfo m in natives.SelectMany(t => t.GetMethods(BindingFlags.Static | BindingFlags.Public)).Where(m => m.Name.StartsWith("anic_")))
            Console.WriteLine("function {0} {1}", m.Name, m.GetParameters().Length);
        foreach (Type t in assembly.GetTypes().Where(t => t.IsEnum && (t.IsPublic || t.IsNestedPublic)))
        {
            foreach (string name in Enum.GetNames(t))
                Console.WriteLine("constant {0} {1} {2}", t.Name, name, (int)Enum.Parse(t, name));
        }
    }

    public static void Main(string[] arguments)
    {
        if (arguments[0] == "--layout")
        {
            PrintLayout();
            return;
        }
        folder = arguments[0];
        OpensAndTells();
        PlaysAndBlends();
        MakesWhatACardNeeds();
        GivesTheBasis("limb_default");
        GivesTheBasis("regions");
        PlaysCoarserAndFillsTextures();
        ReadsStreams();
        RefusesWhatIsWrong();
        OpensNamedClips();
        Morphs();
        AllocatesNothingPerFrame();
        FindsLibrariesByPlatform();
        EncodesACapture();
        Check.Done();
    }
}
