// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;

internal static class Check
{
    private static int failures, checks;

    public static void That(bool holds, string what)
    {
        ++checks;
        if (holds)
            return;
        ++failures;
        Console.WriteLine("FAILED: " + what);
    }

    public static void Throws(Anicodec.Status status, Action action, string what)
    {
        try
        {
            action();
            That(false, what + ": nothing was thrown");
        }
        catch (Anicodec.AnicException e)
        {
            That(e.Status == status, what + ": " + e.Status + ", " + e.Message);
        }
    }

    public static void Done()
    {
        Console.WriteLine(checks + " checks, " + failures + " failed");
        Environment.Exit(failures == 0 ? 0 : 1);
    }
}
