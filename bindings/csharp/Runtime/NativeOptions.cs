// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Anicodec
{
    /// <summary>OpenOptions as the library takes them; holds the names of the clips.</summary>
    internal sealed unsafe class NativeOptions : IDisposable
    {
        private IntPtr names;

        public Native.anic_options Options;

        public NativeOptions(OpenOptions options)
        {
            Options = default(Native.anic_options);
            Options.struct_size = (UIntPtr)sizeof(Native.anic_options);
            Options.max_vertices = options.MaxVertices;
            Options.max_frames = options.MaxFrames;
            Options.max_components = options.MaxComponents;
            Options.max_bytes = options.MaxBytes;
            Options.quality = options.Quality;
            Options.flags = (ulong)options.Flags;
            if (options.Clips != null && options.Clips.Length > 0)
                Add(options.Clips);
        }

        /// <summary>One block: the pointers, then the texts.</summary>
        private void Add(string[] clips)
        {
            int bytes = sizeof(byte*) * clips.Length;
            foreach (string clip in clips)
                bytes += Encoding.UTF8.GetByteCount(clip) + 1;
            names = Marshal.AllocHGlobal(bytes);
            byte** pointers = (byte**)names;
            byte* text = (byte*)(pointers + clips.Length);
            for (int i = 0; i < clips.Length; ++i)
            {
                pointers[i] = text;
                byte[] encoded = Encoding.UTF8.GetBytes(clips[i] + "\0");
                Marshal.Copy(encoded, 0, (IntPtr)text, encoded.Length);
                text += encoded.Length;
            }
            Options.clips = pointers;
            Options.clip_count = (uint)clips.Length;
        }

        public void Dispose()
        {
            Marshal.FreeHGlobal(names);
            names = IntPtr.Zero;
            GC.SuppressFinalize(this);
        }

        ~NativeOptions()
        {
            Marshal.FreeHGlobal(names);
        }
    }
}
