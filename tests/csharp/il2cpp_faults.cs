// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// One break of each rule that il2cpp_rules.cs looks for, and what is no break.
using System;
using System.Linq.Expressions;
using System.Runtime.InteropServices;

public sealed class MonoPInvokeCallbackAttribute : Attribute
{
}

public class Faults
{
    private delegate void Call();

    private struct Holder
    {
        public string Text;
    }

    [DllImport("c")] private static extern void takes_delegate(Call call);
    [DllImport("c")] private static extern void takes_struct(Holder holder);
    [DllImport("c")] private static extern void takes_numbers(IntPtr call, ref int number, UIntPtr size);

    private static void Called()
    {
    }

    [MonoPInvokeCallback]
    private static void Marked()
    {
    }

    public static void Lets()
    {
        takes_numbers(Marshal.GetFunctionPointerForDelegate((Call)Called), ref number, UIntPtr.Zero);
    }

    public static void LetsAsItShould()
    {
        takes_numbers(Marshal.GetFunctionPointerForDelegate((Call)Marked), ref number, UIntPtr.Zero);
        takes_delegate(null);
        takes_struct(new Holder { Text = typeof(int).Name });
    }

    private static int number;

    public static object Makes()
    {
        return Activator.CreateInstance(typeof(Faults));
    }

    public static object Searches()
    {
        return typeof(Faults).GetMethod("Makes");
    }

    public static int Compiles()
    {
        return Expression.Lambda<Func<int>>(Expression.Constant(1)).Compile()();
    }

    public virtual T Generic<T>(T value)
    {
        return value;
    }
}
