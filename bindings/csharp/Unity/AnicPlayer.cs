// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using Unity.Collections;
using UnityEngine;

namespace Anicodec.Unity
{
    /// <summary>Shows a mesh of a clip at `time`: by the CPU, or by the graphics card if it has the compute shader.</summary>
    [AddComponentMenu("anicodec/Anic Player")]
    [RequireComponent(typeof(MeshFilter), typeof(MeshRenderer))]
    public sealed class AnicPlayer : MonoBehaviour
    {
        public AnicClip clip;

        /// <summary>Mesh of the file.</summary>
        public int mesh;

        /// <summary>Clip of the file by its name; empty: the first one.</summary>
        public string clipName = "";

        /// <summary>Seconds; 0 is the first frame of the clip.</summary>
        public double time;

        public float speed = 1;
        public bool playing = true;
        public Sampling sampling = Sampling.Linear;
        public Wrap wrap = Wrap.Loop;

        /// <summary>Share of the components to play: less for what is far away.</summary>
        [Range(0.01f, 1)] public float quality = 1;

        /// <summary>AnicPlay.compute, to play on the graphics card; none: the CPU does.</summary>
        public ComputeShader shader;

        /// <summary>The transform that root motion moves, for a clip with inPlace; none: it stays where it is.</summary>
        public Transform root;

        private Context context;
        private AnicCompute compute;
        private Mesh shown;
        private NativeArray<float> vertices;
        private int current, fadeTo = -1;
        private double fadeTime, fadeLength, fadeDone;

        private void OnEnable()
        {
            if (clip == null)
                return;
            context = new Context(clip.Asset);
            current = FindClip(clipName);
            context.SetClip(current);
            shown = AnicMesh.Create(clip, mesh, name);
            shown.MarkDynamic();
            GetComponent<MeshFilter>().sharedMesh = shown;
            vertices = new NativeArray<float>(AnicMesh.Floats * clip.Plan(mesh).VertexCount, Allocator.Persistent);
            if (shader != null && SystemInfo.supportsComputeShaders)
                compute = new AnicCompute(clip, mesh, shader, shown);
        }

        private void OnDisable()
        {
            if (context == null)
                return;
            if (compute != null)
                compute.Dispose();
            compute = null;
            vertices.Dispose();
            context.Dispose();
            context = null;
            Destroy(shown);
        }

        /// <summary>Number of a clip of the file; that of the first one when there is none of the name.</summary>
        public int FindClip(string of)
        {
            return string.IsNullOrEmpty(of) ? 0 : System.Math.Max(0, clip.Asset.FindClip(of));
        }

        /// <summary>Chooses the clip whose times Show() means.</summary>
        public void SetClip(string of)
        {
            current = FindClip(of);
            if (context != null)
                context.SetClip(current);
        }

        /// <summary>Fades to a clip of the file within some seconds.</summary>
        public void CrossFade(string to, double seconds)
        {
            fadeTo = FindClip(to);
            fadeTime = 0;
            fadeDone = 0;
            fadeLength = seconds;
        }

        private void Update()
        {
            if (!playing || context == null)
                return;
            double step = speed * Time.deltaTime;
            time += step;
            if (fadeTo < 0)
            {
                MoveRoot(current, time - step, time, 1);
                Show(time);
                return;
            }
            fadeTime += step;
            fadeDone += Time.deltaTime;
            double weight = System.Math.Min(fadeDone / fadeLength, 1);
            MoveRoot(current, time - step, time, 1 - weight);
            MoveRoot(fadeTo, fadeTime - step, fadeTime, weight);
            if (fadeDone >= fadeLength)
            {
                current = fadeTo;
                context.SetClip(current);
                time = fadeTime;
                fadeTo = -1;
                Show(time);
            }
            else
            {
                Show(time, fadeTo, fadeTime, weight);
            }
        }

        private void MoveRoot(int of, double from, double to, double weight)
        {
            if (root == null)
                return;
            float degrees;
            Vector3 move = AnicSpace.Convert(clip.Asset.GetRootStep(of, from, to, sampling, wrap), clip.Asset.Up, out degrees);
            root.Translate(move * (float)weight, Space.Self);
            root.Rotate(0, degrees * (float)weight, 0, Space.Self);
        }

        /// <summary>Shows a time of the chosen clip.</summary>
        public void Show(double seconds)
        {
            Show(seconds, -1, 0, 0);
        }

        /// <summary>Shows a time of the chosen clip, cross-faded with one of another clip.</summary>
        public void Show(double seconds, int other, double otherSeconds, double weight)
        {
            if (context == null)
                return;
            context.SetQuality(quality);
            context.Seek(seconds, sampling, wrap);
            if (other >= 0)
                context.Blend(other, otherSeconds, weight, sampling, wrap);
            MeshRenderer renderer = GetComponent<MeshRenderer>();
            if (compute != null && compute.Show(context))
            {
                renderer.enabled = true;
                return;
            }
            renderer.enabled = AnicMesh.Fill(clip, mesh, context, vertices);
            if (renderer.enabled)
                AnicMesh.Store(shown, vertices, clip.Plan(mesh).VertexCount);
        }
    }
}
