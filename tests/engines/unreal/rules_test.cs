// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The part of UnrealBuildTool that the plug-in's rules use, by its documentation, and a program that prints what they say.
using System;
using System.Collections.Generic;

namespace UnrealBuildTool
{
    public enum ModuleType { CPlusPlus, External }

    public sealed class UnrealTargetPlatform
    {
        private readonly string name;

        private UnrealTargetPlatform(string of)
        {
            name = of;
        }

        public override string ToString()
        {
            return name;
        }

        public static readonly UnrealTargetPlatform Win64 = new UnrealTargetPlatform("Win64");
        public static readonly UnrealTargetPlatform Mac = new UnrealTargetPlatform("Mac");
        public static readonly UnrealTargetPlatform Linux = new UnrealTargetPlatform("Linux");
    }

    public sealed class ReadOnlyTargetRules
    {
        public UnrealTargetPlatform Platform;
    }

    public sealed class BuildException : Exception
    {
        public BuildException(string text) : base(text)
        {
        }
    }

    public sealed class RuntimeDependencyList
    {
        public readonly List<string> Added = new List<string>();

        public void Add(string path)
        {
            Added.Add(path);
        }

        public void Add(string to, string from)
        {
            Added.Add(from);
        }
    }

    public class ModuleRules
    {
        public enum PCHUsageMode { Default, UseExplicitOrSharedPCHs }

        public static string Folder;
        public PCHUsageMode PCHUsage;
        public ModuleType Type;
        public readonly List<string> PublicDependencyModuleNames = new List<string>(), PrivateDependencyModuleNames = new List<string>();
        public readonly List<string> PublicSystemIncludePaths = new List<string>(), PublicAdditionalLibraries = new List<string>();
        public readonly List<string> PublicDelayLoadDLLs = new List<string>(), PublicDefinitions = new List<string>();
        public readonly RuntimeDependencyList RuntimeDependencies = new RuntimeDependencyList();
        public string ModuleDirectory { get { return Folder; } }

        public ModuleRules(ReadOnlyTargetRules target)
        {
        }
    }
}

public static class Program
{
    public static int Main(string[] arguments)
    {
        UnrealBuildTool.ModuleRules.Folder = arguments[1];
        UnrealBuildTool.ReadOnlyTargetRules target = new UnrealBuildTool.ReadOnlyTargetRules
        {
            Platform = (UnrealBuildTool.UnrealTargetPlatform)typeof(UnrealBuildTool.UnrealTargetPlatform).GetField(arguments[0]).GetValue(null)
        };
        foreach (string name in new[] { "Anicodec", "AnicodecEditor", "AnicodecLibrary" })
        {
            try
            {
                // As UnrealBuildTool finds them: by the name of the module.
                UnrealBuildTool.ModuleRules rules = (UnrealBuildTool.ModuleRules)Activator.CreateInstance(Type.GetType(name), target);
                List<string> all = new List<string>(rules.PublicDependencyModuleNames);
                all.AddRange(rules.PrivateDependencyModuleNames);
                all.AddRange(rules.PublicSystemIncludePaths);
                all.AddRange(rules.PublicAdditionalLibraries);
                all.AddRange(rules.RuntimeDependencies.Added);
                all.AddRange(rules.PublicDefinitions);
                Console.WriteLine(name + " " + string.Join(" ", all));
            }
            catch (System.Reflection.TargetInvocationException error)
            {
                Console.WriteLine(name + " refused: " + error.InnerException.Message);
            }
        }
        return 0;
    }
}
