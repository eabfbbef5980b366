// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System.Collections.Generic;
using UnityEngine;

namespace Anicodec.Unity
{
    /// <summary>An imported file. It is opened when a player first needs it, and shared by all players.</summary>
    public sealed class AnicClip : ScriptableObject
    {
        [SerializeField, HideInInspector] private byte[] bytes;

        /// <summary>Leaves the motion of the whole out of positions, where the file has it apart: for AnicPlayer.root.</summary>
        public bool inPlace;

        private Asset asset;
        private readonly Dictionary<int, RenderPlan> plans = new Dictionary<int, RenderPlan>();
        private readonly Dictionary<int, AnicBasisBuffers> buffers = new Dictionary<int, AnicBasisBuffers>();

        /// <summary>Takes a file; for the importer.</summary>
        public void SetBytes(byte[] file)
        {
            Close();
            bytes = file;
        }

        /// <summary>Opens the file; may be called early, from a loading screen.</summary>
        public Asset Asset
        {
            get
            {
                if (asset == null)
                    asset = Asset.Open(bytes, new OpenOptions { Flags = OpenFlags.Bounds | (inPlace ? OpenFlags.InPlace : 0) });
                return asset;
            }
        }

        /// <summary>Render vertices of a mesh, with the hard edges of the source.</summary>
        public RenderPlan Plan(int mesh)
        {
            RenderPlan plan;
            if (!plans.TryGetValue(mesh, out plan))
            {
                plan = new RenderPlan(Asset, mesh, new NormalOptions
                {
                    SourceEdges = true, CreaseAngle = 60, ReferenceFrame = FirstFrame(mesh)
                });
                plans.Add(mesh, plan);
            }
            return plan;
        }

        /// <summary>The first frame that shows a mesh.</summary>
        public int FirstFrame(int mesh)
        {
            Box box;
            int frame = 0;
            while (frame + 1 < Asset.FrameCount && !Asset.GetFrameBounds(frame, out box, mesh))
                ++frame;
            return frame;
        }

        /// <summary>The basis of a segment on the graphics card, uploaded once for all players.</summary>
        public AnicBasisBuffers Buffers(int segment)
        {
            AnicBasisBuffers found;
            if (!buffers.TryGetValue(segment, out found))
            {
                found = new AnicBasisBuffers(Asset.GetBasis(segment));
                buffers.Add(segment, found);
            }
            return found;
        }

        /// <summary>Gives all memory back. Contexts that players still have keep the asset until they go.</summary>
        public void Close()
        {
            foreach (AnicBasisBuffers b in buffers.Values)
                b.Dispose();
            buffers.Clear();
            foreach (RenderPlan plan in plans.Values)
                plan.Dispose();
            plans.Clear();
            if (asset != null)
                asset.Dispose();
            asset = null;
        }

        private void OnDisable()
        {
            Close();
        }
    }
}
