// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The times that tests/rust/times.c prints, in C#.
//
// usage: times.exe CLIP.anic [ROUNDS]
using System;
using System.IO;
using System.Runtime.InteropServices;
using Anicodec;

internal static class Times
{
    [DllImport("libc")]
    private static extern IntPtr clock();

    /// <summary>Milliseconds of processor time. POSIX counts a million in a second; Mono's own clock has steps of ten.</summary>
    private static double Used()
    {
        return (long)clock() / 1e3;
    }

    private static void Main(string[] arguments)
    {
        int rounds = arguments.Length > 1 ? int.Parse(arguments[1]) : 5;
        byte[] bytes = File.ReadAllBytes(arguments[0]);
        double open = double.PositiveInfinity, frame = double.PositiveInfinity;
        for (int r = 0; r < rounds; ++r)
        {
            double start = Used();
            using (Asset asset = Asset.Open(bytes))
            using (Context context = new Context(asset))
            {
                open = Math.Min(open, Used() - start);
                float[] points = new float[3 * asset.GetMesh().VertexCount];
                start = Used();
                for (int f = 0; f < asset.FrameCount; ++f)
                {
                    context.Seek(asset.GetFrameTime(f));
                    context.WritePositions(points);
                }
                frame = Math.Min(frame, (Used() - start) / asset.FrameCount);
            }
        }
        Console.WriteLine(open.ToString("F3") + " " + frame.ToString("F5"));
    }
}
