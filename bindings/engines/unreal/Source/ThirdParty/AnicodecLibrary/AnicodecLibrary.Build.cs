// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System.IO;
using UnrealBuildTool;

/// <summary>The decoder, as README.md says how to build it: headers in include/, a library for each platform in lib/PLATFORM/.</summary>
public class AnicodecLibrary : ModuleRules
{
    public AnicodecLibrary(ReadOnlyTargetRules Target) : base(Target)
    {
        Type = ModuleType.External;
        PublicSystemIncludePaths.Add(Path.Combine(ModuleDirectory, "include"));

        string folder = Path.Combine(ModuleDirectory, "lib", Target.Platform.ToString());
        if (Target.Platform == UnrealTargetPlatform.Win64)
        {
            PublicDefinitions.Add("ANIC_SHARED=1");
            PublicAdditionalLibraries.Add(Find(folder, "anicodec.lib"));
            PublicDelayLoadDLLs.Add("anicodec.dll");
            RuntimeDependencies.Add("$(BinaryOutputDir)/anicodec.dll", Find(folder, "anicodec.dll"));
            return;
        }
        // Shared, with a C++ library of its own inside: Unreal's is another one.
        string library = Find(folder, Target.Platform == UnrealTargetPlatform.Mac ? "libanicodec.dylib" : "libanicodec.so");
        PublicAdditionalLibraries.Add(library);
        RuntimeDependencies.Add(library);
    }

    private static string Find(string folder, string name)
    {
        string path = Path.Combine(folder, name);
        if (!File.Exists(path))
            throw new BuildException("anicodec: there is no " + path + ": see the plug-in's README.md");
        return path;
    }
}
