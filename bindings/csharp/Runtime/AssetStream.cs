// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;

namespace Anicodec
{
    /// <summary>A file that arrives from the front, piece by piece; of a live stream, one file after the other.</summary>
    public sealed unsafe class AssetStream : IDisposable
    {
        private readonly StreamHandle handle;
        private readonly NativeOptions options;  // the library reads the names of clips until the end

        public AssetStream(OpenOptions wanted = default(OpenOptions))
        {
            options = new NativeOptions(wanted);
            Native.anic_options given = options.Options;
            Native.Check(Native.anic_create_stream(&given, out handle));
        }

        public void Dispose()
        {
            handle.Dispose();
            options.Dispose();
        }

        /// <summary>Takes the next bytes and checks them.</summary>
        /// <exception cref="AnicException">the bytes cannot become a good file</exception>
        public void Push(ReadOnlySpan<byte> bytes)
        {
            fixed (byte* first = bytes)
            {
                Check(Native.anic_push_bytes(handle, first, (UIntPtr)bytes.Length));
            }
        }

        /// <summary>Turns to the next file of a live stream, once the one at hand is complete and opened.</summary>
        /// <exception cref="AnicException">Status.State: it is not complete; the bytes that waited cannot become a good file</exception>
        public void Advance()
        {
            Check(Native.anic_advance_stream(handle));
        }

        private void Check(Status status)
        {
            if (status == Status.Ok)
                return;
            if (status == Status.State)
                Native.Check(status);
            Native.anic_failure failure = Asset.Failure();
            Native.Check(Native.anic_get_stream_failure(handle, &failure));
            throw new AnicException(failure);
        }

        private Native.anic_stream_info Info
        {
            get
            {
                Native.anic_stream_info info = default(Native.anic_stream_info);
                info.struct_size = (UIntPtr)sizeof(Native.anic_stream_info);
                Native.Check(Native.anic_get_stream_info(handle, &info));
                return info;
            }
        }

        public long ReceivedBytes { get { return (long)Info.received_bytes; } }

        /// <summary>0 while the header is not there.</summary>
        public long FileBytes { get { return (long)Info.file_bytes; } }

        /// <summary>Open() gives an asset that plays, coarsely at least.</summary>
        public bool Playable { get { return Info.playable != 0; } }

        public bool Complete { get { return Info.complete != 0; } }

        /// <summary>In a live stream, from 0 on.</summary>
        public int FileNumber { get { return (int)Info.file_number; } }

        /// <summary>Bytes that follow the file: they are of the next ones of a live stream.</summary>
        public long WaitingBytes { get { return (long)Info.waiting_bytes; } }

        /// <summary>Opens what has arrived; assets made before stay as they are.</summary>
        public Asset Open()
        {
            Native.anic_failure failure = Asset.Failure();
            AssetHandle asset;
            if (Native.anic_open_asset_from_stream(handle, out asset, &failure) != Status.Ok)
                throw new AnicException(failure);
            return new Asset(asset);
        }
    }
}
