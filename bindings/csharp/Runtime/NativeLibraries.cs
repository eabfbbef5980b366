// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using System.IO;
using System.Reflection;
using System.Runtime.InteropServices;

namespace Anicodec
{
    /// <summary>
    /// Finds the native libraries: the file that the variable ANICODEC_LIBRARY names, of the encoder ANICODEC_ENCODER_LIBRARY, else
    /// that in runtimes/PLATFORM/native beside the assembly, as the NuGet package lays it out, else as the system finds libraries.
    /// </summary>
    /// <remarks>
    /// .NET asks here; Mono reads Anicodec.dll.config instead, and Unity the import settings of its plug-ins.
    /// </remarks>
    internal static class NativeLibraries
    {
        public const string Encoder = "anicodec_encoder";

#if NET5_0_OR_GREATER
        static NativeLibraries()
        {
            NativeLibrary.SetDllImportResolver(typeof(NativeLibraries).Assembly, Resolve);
        }
#endif

        public static void Prepare()
        {
            // The constructor does all.
        }

        /// <summary>The name of this platform in packages of NuGet: linux-x64, osx-arm64, win-x64 ...</summary>
        public static string Platform()
        {
            string system = RuntimeInformation.IsOSPlatform(OSPlatform.Windows) ? "win"
                : RuntimeInformation.IsOSPlatform(OSPlatform.OSX) ? "osx" : "linux";
            return system + "-" + RuntimeInformation.ProcessArchitecture.ToString().ToLowerInvariant();
        }

        /// <summary>The name of the library's file on this platform.</summary>
        public static string FileName(string library = "anicodec")
        {
            return RuntimeInformation.IsOSPlatform(OSPlatform.Windows) ? library + ".dll"
                : "lib" + library + (RuntimeInformation.IsOSPlatform(OSPlatform.OSX) ? ".dylib" : ".so");
        }

        /// <summary>The file to load, or null: as the system finds it.</summary>
        public static string Find(string folder, string library = "anicodec")
        {
            string named = Environment.GetEnvironmentVariable(library == Encoder ? "ANICODEC_ENCODER_LIBRARY" : "ANICODEC_LIBRARY");
            if (!string.IsNullOrEmpty(named))
                return named;
            string packed = Path.Combine(folder, "runtimes", Platform(), "native", FileName(library));
            return File.Exists(packed) ? packed : null;
        }

#if NET5_0_OR_GREATER
        private static IntPtr Resolve(string name, Assembly assembly, DllImportSearchPath? path)
        {
            string file = name == "anicodec" || name == Encoder ? Find(AppContext.BaseDirectory, name) : null;
            return file == null ? IntPtr.Zero : NativeLibrary.Load(file);
        }
#endif
    }
}
