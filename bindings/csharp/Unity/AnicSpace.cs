// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using UnityEngine;

namespace Anicodec.Unity
{
    /// <summary>
    /// The axes of Unity: y up, left-handed. A clip with y up has its x axis negated, one with z up goes to (-x, z, -y);
    /// triangles are turned round when the mesh is made.
    /// </summary>
    public static class AnicSpace
    {
        /// <summary>Converts points or directions, `stride` floats from one to the next.</summary>
        public static unsafe void Convert(float* first, int count, int stride, UpAxis up)
        {
            for (int i = 0; i < count; ++i, first += stride)
            {
                first[0] = -first[0];
                if (up == UpAxis.Z)
                {
                    float y = first[1];
                    first[1] = first[2];
                    first[2] = -y;
                }
            }
        }

        /// <summary>A step of the motion of the whole: what to move by, and degrees to turn about the y axis.</summary>
        public static Vector3 Convert(RootMotion step, UpAxis up, out float degrees)
        {
            degrees = (float)(-step.Turn * 180 / System.Math.PI);
            float x = -(float)step.MoveX, y = (float)step.MoveY, z = (float)step.MoveZ;
            return up == UpAxis.Z ? new Vector3(x, z, -y) : new Vector3(x, y, z);
        }

        public static Bounds Convert(Box box, UpAxis up)
        {
            bool z = up == UpAxis.Z;
            Vector3 min = new Vector3(-box.Max.X, z ? box.Min.Z : box.Min.Y, z ? -box.Max.Y : box.Min.Z);
            Vector3 max = new Vector3(-box.Min.X, z ? box.Max.Z : box.Max.Y, z ? -box.Min.Y : box.Max.Z);
            return new Bounds((min + max) * 0.5f, max - min);
        }
    }
}
