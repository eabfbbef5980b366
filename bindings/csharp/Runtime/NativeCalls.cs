// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Helpers beside the declarations of Native.cs and NativeEncoder.cs: libraries, errors, texts.
using System;
using System.Text;

namespace Anicodec
{
    /// <summary>A context keeps its asset open, whichever the garbage collector finds first.</summary>
    internal sealed partial class ContextHandle
    {
        private AssetHandle asset;

        public void Keep(AssetHandle kept)
        {
            bool added = false;
            kept.DangerousAddRef(ref added);
            asset = kept;
        }

        partial void Released()
        {
            if (asset != null)
                asset.DangerousRelease();
        }
    }

    internal static unsafe partial class Native
    {
#if UNITY_IOS && !UNITY_EDITOR || UNITY_WEBGL && !UNITY_EDITOR
        private const string Library = "__Internal";  // linked into the program
#else
        private const string Library = "anicodec";
#endif

        static Native()
        {
            NativeLibraries.Prepare();
        }

        public static RootMotion Motion(anic_root_motion m)
        {
            return new RootMotion
            {
                Moves = m.moves != 0, Turns = m.turns != 0, Turn = m.turn, MoveX = m.move[0], MoveY = m.move[1], MoveZ = m.move[2],
                PivotX = m.pivot[0], PivotY = m.pivot[1], PivotZ = m.pivot[2]
            };
        }

        /// <summary>A string of the library; UTF-8.</summary>
        public static string Text(byte* text)
        {
            if (text == null)
                return null;
            int length = 0;
            while (text[length] != 0)
                ++length;
            return Encoding.UTF8.GetString(text, length);
        }

        /// <summary>Throws unless the status is OK.</summary>
        public static void Check(Status status)
        {
            if (status != Status.Ok)
                throw new AnicException(status);
        }

        /// <summary>False when the mesh is not there; throws what else goes wrong.</summary>
        public static bool Present(Status status)
        {
            if (status == Status.Absent)
                return false;
            Check(status);
            return true;
        }
    }

    internal static unsafe partial class NativeEncoder
    {
        private const string Library = NativeLibraries.Encoder;

        static NativeEncoder()
        {
            NativeLibraries.Prepare();
        }
    }
}
