// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Rules of code that is compiled ahead of time, as IL2CPP does it by Unity's manual: nothing makes code or finds members by name
// at run time, functions of C are called with values that need no code of their own to be passed, and C calls static methods alone that
// say so. A program that reads the instructions of assemblies and prints a line for each break.
//
// usage: il2cpp_rules ASSEMBLY...      exit status 1 if there is any
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Reflection.Emit;
using System.Runtime.InteropServices;

internal static class Program
{
    private const BindingFlags All = BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Instance | BindingFlags.Static | BindingFlags.DeclaredOnly;

    private static readonly Dictionary<short, OpCode> Codes = typeof(OpCodes).GetFields(BindingFlags.Public | BindingFlags.Static)
        .Select(field => (OpCode)field.GetValue(null)).ToDictionary(code => code.Value);

    /// <summary>Namespaces and types of which nothing may be called.</summary>
    private static readonly string[] Forbidden =
    {
        "System.Reflection.", "System.Linq.Expressions.", "System.Runtime.Remoting.", "System.CodeDom.", "Microsoft.CSharp.",
        "System.Runtime.CompilerServices.CallSite", "System.Activator", "System.AppDomain"
    };

    /// <summary>Functions of Type that look for members or types by name.</summary>
    private static bool IsSearch(MethodBase called)
    {
        return called.DeclaringType == typeof(Type) && called.Name.StartsWith("Get") && called.Name != "GetTypeFromHandle" && called.Name != "GetHashCode" ||
            called.DeclaringType == typeof(Type) && called.Name.StartsWith("Make");
    }

    private static int faults;

    private static void Fault(MethodBase where, string what)
    {
        ++faults;
        Console.WriteLine(where.DeclaringType + "." + where.Name + " " + what);
    }

    /// <summary>Whether a value goes to C as it is, or is of a type that IL2CPP passes by itself.</summary>
    private static bool Passes(Type type)
    {
        if (type.IsByRef)
            type = type.GetElementType();
        if (type == typeof(void) || type.IsPointer || type.IsPrimitive || type.IsEnum || typeof(SafeHandle).IsAssignableFrom(type))
            return true;
        return type.IsValueType && !type.IsGenericType && type.GetFields(All & ~BindingFlags.Static).All(field => Passes(field.FieldType));
    }

    private static void CheckImport(MethodInfo method)
    {
        if (method.DeclaringType.IsGenericType || method.IsGenericMethod)
            Fault(method, "is a function of C and generic");
        foreach (ParameterInfo parameter in method.GetParameters().Concat(new[] { method.ReturnParameter }))
        {
            if (!Passes(parameter.ParameterType))
                Fault(method, "passes a " + parameter.ParameterType + " to C");
        }
    }

    private static bool SaysCalledByC(MethodBase method)
    {
        return method.IsStatic && method.GetCustomAttributesData().Any(one => one.Constructor.DeclaringType.Name == "MonoPInvokeCallbackAttribute");
    }

    private static void CheckBody(MethodBase method)
    {
        byte[] code = method.GetMethodBody().GetILAsByteArray();
        Type[] ofType = method.DeclaringType.IsGenericType ? method.DeclaringType.GetGenericArguments() : null;
        Type[] ofMethod = method.IsGenericMethod ? method.GetGenericArguments() : null;
        List<MethodBase> pointers = new List<MethodBase>();
        bool givesToC = false;
        for (int at = 0; at < code.Length;)
        {
            OpCode op = Codes[code[at] == 0xFE ? unchecked((short)(0xFE00 | code[at + 1])) : code[at]];
            at += op.Size;
            int operand = at;
            switch (op.OperandType)
            {
                case OperandType.InlineNone: break;
                case OperandType.ShortInlineBrTarget: case OperandType.ShortInlineI: case OperandType.ShortInlineVar: at += 1; break;
                case OperandType.InlineVar: at += 2; break;
                case OperandType.InlineI8: case OperandType.InlineR: at += 8; break;
                case OperandType.InlineSwitch: at += 4 + 4 * BitConverter.ToInt32(code, at); break;
                default: at += 4; break;
            }
            if (op.OperandType != OperandType.InlineMethod)
                continue;
            MethodBase called = method.Module.ResolveMethod(BitConverter.ToInt32(code, operand), ofType, ofMethod);
            string of = called.DeclaringType + ".";
            // The name of a type that is there is none of them.
            bool isName = called.DeclaringType == typeof(MemberInfo) && called.Name == "get_Name";
            if (Forbidden.Any(name => of.StartsWith(name)) && !isName || IsSearch(called))
                Fault(method, "calls " + of + called.Name);
            if (op == OpCodes.Ldftn)
                pointers.Add(called);
            givesToC |= called.DeclaringType == typeof(Marshal) && called.Name == "GetFunctionPointerForDelegate";
        }
        foreach (MethodBase pointer in pointers.Where(one => givesToC && !SaysCalledByC(one)))
            Fault(method, "lets C call " + pointer.Name + ", which is not static with [MonoPInvokeCallback]");
        if (givesToC && pointers.Count == 0)
            Fault(method, "lets C call a delegate that is made elsewhere");
    }

    private static int Main(string[] arguments)
    {
        int methods = 0, imports = 0;
        foreach (Type type in arguments.SelectMany(path => Assembly.LoadFrom(path).GetTypes()))
        {
            foreach (MethodBase method in type.GetMethods(All).Cast<MethodBase>().Concat(type.GetConstructors(All)))
            {
                ++methods;
                if ((method.Attributes & MethodAttributes.PinvokeImpl) != 0)
                {
                    ++imports;
                    CheckImport((MethodInfo)method);
                }
                else if (method.IsVirtual && method.IsGenericMethod)
                {
                    Fault(method, "is virtual and generic");
                }
                else if (method.GetMethodBody() != null)
                {
                    CheckBody(method);
                }
            }
        }
        Console.WriteLine(methods + " methods, " + imports + " functions of C, " + faults + " breaks of the rules of IL2CPP");
        return faults == 0 ? 0 : 1;
    }
}
