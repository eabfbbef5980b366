// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;

namespace Anicodec
{
    /// <summary>A call of the library failed.</summary>
    public sealed class AnicException : Exception
    {
        public Status Status { get; private set; }

        /// <summary>Chunk of the file that is at fault: four characters; empty outside any chunk.</summary>
        public string Chunk { get; private set; }

        /// <summary>Byte offset in the file, as exact as is known.</summary>
        public ulong Offset { get; private set; }

        internal unsafe AnicException(Status status) : base(Native.Text(Native.anic_get_status_text(status)))
        {
            Status = status;
            Chunk = "";
        }

        internal AnicException(Status status, string text) : base(text)
        {
            Status = status;
            Chunk = "";
        }

        internal unsafe AnicException(Native.anic_failure failure) : base(Describe(failure))
        {
            Status = failure.status;
            Chunk = Native.Text(failure.chunk);
            Offset = failure.offset;
        }

        private static unsafe string Describe(Native.anic_failure failure)
        {
            string text = Native.Text(Native.anic_get_status_text(failure.status));
            string detail = Native.Text(failure.detail);
            return string.IsNullOrEmpty(detail) ? text : text + ": " + detail + " (byte " + failure.offset + ")";
        }
    }
}
