// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The Unity part of bindings/csharp against stubs: importer, player, Timeline mixer.
using System;
using System.IO;
using System.Reflection;
using Anicodec;
using Anicodec.Unity;
using UnityEditor.AssetImporters;
using UnityEngine;
using UnityEngine.Playables;

internal static class UnityTest
{
    private static void Call(object of, string method)
    {
        of.GetType().GetMethod(method, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(of, null);
    }

    private static AssetImportContext Import(string path)
    {
        AssetImportContext context = new AssetImportContext { assetPath = path };
        new AnicImporter().OnImportAsset(context);
        return context;
    }

    private static void ImportsMeshesInUnitysAxes(string folder)
    {
        AssetImportContext made = Import(Path.Combine(folder, "painted_box.anic"));
        Check.That(made.Errors.Count == 0, "imports");
        Mesh mesh = (Mesh)made.Added["mesh 0"];
        using (Asset asset = Asset.Open(Path.Combine(folder, "painted_box.anic")))
        using (RenderPlan plan = new RenderPlan(asset, 0, new NormalOptions { SourceEdges = true, CreaseAngle = 60 }))
        using (Context context = new Context(asset))
        {
            context.SeekFrame(0);
            float[] positions = new float[3 * plan.VertexCount];
            plan.WritePositions(context, positions);
            float[] vertices = (float[])mesh.Streams[0];
            uint[] indices = (uint[])mesh.Indices;
            Check.That(vertices.Length == AnicMesh.Floats * plan.VertexCount && mesh.Vertices == plan.VertexCount, "sizes");
            Check.That(asset.Up == UpAxis.Z ? vertices[1] == positions[2] : vertices[1] == positions[1], "y is up");
            Check.That(vertices[0] == -positions[0], "x is negated");
            Check.That(indices[0] == plan.Indices[0] && indices[1] == plan.Indices[2], "triangles are turned round");
            // A front is clockwise in left-handed axes, where the same cross product then points to the viewer.
            int agree = 0;
            for (int t = 0; t < plan.TriangleCount; ++t)
                agree += Along(vertices, indices, 3 * t) > 0 ? 1 : 0;
            Check.That(agree > plan.TriangleCount * 9 / 10, "normals point to the front: " + agree);
            Check.That(mesh.subMeshCount == plan.GroupCount, "a submesh for each material");
            Material wood = null;
            foreach (UnityEngine.Object added in made.Added.Values)
            {
                if (added is Material && added.name == "wood")
                    wood = (Material)added;
            }
            Check.That(wood != null && wood.Floats.Count == 2 && wood.color.a > 0, "materials look as in the file");
        }
    }

    private static double Along(float[] vertices, uint[] indices, int at)
    {
        double[][] p = new double[3][];
        for (int i = 0; i < 3; ++i)
        {
            int v = AnicMesh.Floats * (int)indices[at + i];
            p[i] = new double[] { vertices[v], vertices[v + 1], vertices[v + 2], vertices[v + 3], vertices[v + 4], vertices[v + 5] };
        }
        double sum = 0;
        for (int c = 0; c < 3; ++c)
        {
            int d = (c + 1) % 3, e = (c + 2) % 3;
            double cross = (p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) - (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]);
            sum += cross * p[0][3 + c];
        }
        return sum;
    }

    private static AnicPlayer Player(string path)
    {
        AnicClip clip = ScriptableObject.CreateInstance<AnicClip>();
        clip.SetBytes(File.ReadAllBytes(path));
        GameObject o = new GameObject("player");
        o.AddComponent<MeshFilter>();
        o.AddComponent<MeshRenderer>();
        AnicPlayer player = o.AddComponent<AnicPlayer>();
        player.clip = clip;
        return player;
    }

    private static float[] Shown(AnicPlayer player)
    {
        return (float[])player.GetComponent<MeshFilter>().sharedMesh.Streams[0];
    }

    private static void PlaysAndCrossFades(string folder)
    {
        AnicPlayer player = Player(Path.Combine(folder, "clips.anic"));
        Call(player, "OnEnable");
        Check.That(player.clip.Asset.ClipCount > 1, "the file has several clips");
        string other = player.clip.Asset.GetClip(1).Name;
        player.Show(0);
        float[] first = Shown(player);
        player.Show(0, 1, 0, 1);
        float[] second = Shown(player);
        player.Show(0, 1, 0, 0.5);
        float[] between = Shown(player);
        bool moved = false;
        for (int i = 0; i < first.Length; ++i)
            moved |= first[i] != second[i] && between[i] != first[i];
        Check.That(moved, "a cross-fade shows something else");
        Time.deltaTime = 0.1f;
        player.CrossFade(other, 0.25);
        for (int i = 0; i < 4; ++i)
            Call(player, "Update");
        Check.That(Math.Abs(player.time - 0.4) < 1e-6, "the new clip goes on where the fade has brought it: " + player.time);
        Call(player, "OnDisable");
        player.clip.Close();
    }

    private static void MovesTheRootOn(string folder)
    {
        AnicPlayer still = Player(Path.Combine(folder, "walk.anic")), whole = Player(Path.Combine(folder, "walk.anic"));
        still.clip.Close();
        still.clip.inPlace = true;
        still.root = new Transform();
        Time.deltaTime = 0.05f;
        foreach (AnicPlayer player in new[] { still, whole })
        {
            player.clipName = "turn";
            player.wrap = Wrap.Clamp;
            Call(player, "OnEnable");
            for (int i = 0; i < 8; ++i)
                Call(player, "Update");
        }
        float[] p = Shown(still), q = Shown(whole);
        double far = 0, apart = 0;
        for (int i = 0; i < p.Length; i += AnicMesh.Floats)
        {
            Vector3 moved = still.root.TransformPoint(new Vector3(p[i], p[i + 1], p[i + 2]));
            far = Math.Max(far, Math.Abs(moved.x - q[i]) + Math.Abs(moved.y - q[i + 1]) + Math.Abs(moved.z - q[i + 2]));
            apart = Math.Max(apart, Math.Abs(p[i] - q[i]) + Math.Abs(p[i + 2] - q[i + 2]));
        }
        Check.That(far < 1e-3 && apart > 0.1, "the root moves on: " + far + " " + apart);
        whole.CrossFade("stand", 0.2);
        still.CrossFade("stand", 0.2);
        float before = still.root.degrees;
        for (int i = 0; i < 8; ++i)
            Call(still, "Update");
        float faded = still.root.degrees;
        for (int i = 0; i < 8; ++i)
            Call(still, "Update");
        Check.That(Math.Abs(faded - before) > 5 && Math.Abs(still.root.degrees - faded) < 4, "it all but stands after a cross-fade");
        foreach (AnicPlayer player in new[] { still, whole })
        {
            Call(player, "OnDisable");
            player.clip.Close();
        }
    }

    private static void PlaysOnTheGraphicsCard(string folder)
    {
        AnicPlayer player = Player(Path.Combine(folder, "limb_default.anic"));
        player.shader = new ComputeShader();
        Call(player, "OnEnable");
        player.Show(0.1);
        Check.That(player.shader.Dispatches == 2, "two passes");
        Check.That(player.shader.Numbers["components"] == player.clip.Asset.GetBasis(0).Components, "all components");
        player.quality = 0.5f;
        player.Show(0.1);
        Check.That(player.shader.Numbers["components"] == (player.clip.Asset.GetBasis(0).Components + 1) / 2, "half of them");
        Check.That(GraphicsBuffer.Alive > 0, "buffers are made");
        Call(player, "OnDisable");
        player.clip.Close();
        Check.That(GraphicsBuffer.Alive == 0, "buffers are given back: " + GraphicsBuffer.Alive);
    }

    private static void MixesOnTheTimeline(string folder)
    {
        AnicPlayer player = Player(Path.Combine(folder, "clips.anic"));
        Call(player, "OnEnable");
        PlayableGraph graph = default(PlayableGraph);
        Playable mixer = new AnicTrack().CreateTrackMixer(graph, player.gameObject, 2);
        for (int i = 0; i < 2; ++i)
        {
            AnicTimelineClip clip = new AnicTimelineClip { clipName = player.clip.Asset.GetClip(i).Name };
            mixer.Node.Inputs.Add(clip.CreatePlayable(graph, player.gameObject));
            mixer.Node.Weights.Add(i == 0 ? 0.25f : 0.75f);
        }
        mixer.Node.Behaviour.ProcessFrame(mixer, default(FrameData), player);
        float[] mixed = Shown(player);
        player.SetClip(player.clip.Asset.GetClip(1).Name);
        player.Show(0, 0, 0, 0.25);
        float[] expected = Shown(player);
        bool same = true;
        for (int i = 0; i < mixed.Length; ++i)
            same &= mixed[i] == expected[i];
        Check.That(same && !player.playing, "the heavier clip, blended with the other");
        Call(player, "OnDisable");
        player.clip.Close();
    }

    private static void ImportsMeshesThatComeLater(string folder)
    {
        AssetImportContext made = Import(Path.Combine(folder, "scene.anic"));
        Check.That(made.Errors.Count == 0, "imports a scene");
        using (Asset asset = Asset.Open(Path.Combine(folder, "scene.anic")))
        {
            for (int m = 0; m < asset.MeshCount; ++m)
                Check.That(((Mesh)made.Added["mesh " + m]).Streams.Count == 2, "mesh " + m);
        }
    }

    private static void ReportsDamagedFiles(string folder)
    {
        string path = Path.Combine(Path.GetTempPath(), "anicodec_damaged_" + Guid.NewGuid() + ".anic");
        File.WriteAllBytes(path, new byte[100]);
        AssetImportContext made = Import(path);
        File.Delete(path);
        Check.That(made.Errors.Count == 1, "an error of the import");
    }

    public static void Main(string[] arguments)
    {
        ImportsMeshesInUnitysAxes(arguments[0]);
        PlaysAndCrossFades(arguments[0]);
        MovesTheRootOn(arguments[0]);
        PlaysOnTheGraphicsCard(arguments[0]);
        MixesOnTheTimeline(arguments[0]);
        ImportsMeshesThatComeLater(arguments[0]);
        ReportsDamagedFiles(arguments[0]);
        Check.Done();
    }
}
