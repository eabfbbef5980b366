// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The part of Unity's interface that bindings/csharp uses, by its documentation, with just enough behind it that tests see what an
// importer and a player do. Not Unity: what a real editor does with the package is not tested here.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Unity.Collections
{
    public enum Allocator { Invalid, None, Temp, TempJob, Persistent }

    public unsafe struct NativeArray<T> : IDisposable where T : struct
    {
        internal IntPtr memory;
        private readonly int length;

        public NativeArray(int count, Allocator allocator)
        {
            length = count;
            int bytes = Math.Max(1, count * Marshal.SizeOf(typeof(T)));
            memory = Marshal.AllocHGlobal(bytes);
            new Span<byte>((void*)memory, bytes).Clear();
        }

        public int Length { get { return length; } }
        public bool IsCreated { get { return memory != IntPtr.Zero; } }

        public T this[int i]
        {
            get { return new Span<T>((void*)memory, length)[i]; }
            set { new Span<T>((void*)memory, length)[i] = value; }
        }

        public void Dispose()
        {
            Marshal.FreeHGlobal(memory);
            memory = IntPtr.Zero;
        }
    }
}

namespace Unity.Collections.LowLevel.Unsafe
{
    public static class NativeArrayUnsafeUtility
    {
        public static unsafe void* GetUnsafePtr<T>(this NativeArray<T> array) where T : struct
        {
            return (void*)array.memory;
        }
    }
}

namespace UnityEngine
{
    using Unity.Collections;
    using UnityEngine.Rendering;

    [AttributeUsage(AttributeTargets.Field)] public sealed class SerializeField : System.Attribute { }
    [AttributeUsage(AttributeTargets.Field)] public sealed class HideInInspector : System.Attribute { }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class RangeAttribute : System.Attribute { public RangeAttribute(float min, float max) { } }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class AddComponentMenu : System.Attribute
    {
        public AddComponentMenu(string menu) { }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class RequireComponent : System.Attribute
    {
        public RequireComponent(Type one, Type two) { }
    }

    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
        public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }
        public static Vector3 operator *(Vector3 a, float f) { return new Vector3(a.x * f, a.y * f, a.z * f); }
    }

    public struct Vector4
    {
        public float x, y, z, w;
        public Vector4(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
    }

    public struct Bounds
    {
        public Vector3 center, size;
        public Bounds(Vector3 center, Vector3 size) { this.center = center; this.size = size; }
    }

    public class Object
    {
        public string name { get; set; }
        public static void Destroy(Object which) { }
    }

    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject, new() { return new T(); }
    }

    public class Component : Object
    {
        public GameObject gameObject;
        public T GetComponent<T>() where T : Component { return gameObject.GetComponent<T>(); }
    }

    public class Behaviour : Component { public bool enabled { get; set; } }
    public class MonoBehaviour : Behaviour { }
    public class MeshFilter : Component { public Mesh sharedMesh { get; set; } }
    public class Renderer : Component { public bool enabled { get; set; } public Material[] sharedMaterials { get; set; } }
    public class MeshRenderer : Renderer { }
    public class Shader : Object { public static Shader Find(string name) { return new Shader(); } }
    public class Material : Object
    {
        public readonly Dictionary<string, float> Floats = new Dictionary<string, float>();
        public Material(Shader shader) { }
        public Color color { get; set; }
        public void SetFloat(string name, float value) { Floats[name] = value; }
    }

    public struct Color
    {
        public float r, g, b, a;
        public Color(float r, float g, float b, float a) { this.r = r; this.g = g; this.b = b; this.a = a; }
        public Color gamma { get { return new Color((float)Math.Sqrt(r), (float)Math.Sqrt(g), (float)Math.Sqrt(b), a); } }
    }

    public enum Space { World, Self }

    public class Transform : Component
    {
        public Vector3 position;
        public float degrees;

        public void SetParent(Transform parent, bool worldPositionStays) { }
        public void Translate(Vector3 by, Space relativeTo) { position = position + TransformDirection(by); }
        public void Rotate(float x, float y, float z, Space relativeTo) { degrees += y; }
        public Vector3 TransformPoint(Vector3 p) { return position + TransformDirection(p); }

        /// <summary>A positive turn about the y axis of a left-handed space leads from z to x.</summary>
        public Vector3 TransformDirection(Vector3 v)
        {
            float c = (float)Math.Cos(degrees * Math.PI / 180), s = (float)Math.Sin(degrees * Math.PI / 180);
            return new Vector3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
        }
    }

    public static class Time { public static float deltaTime { get; set; } }
    public static class SystemInfo { public static bool supportsComputeShaders { get { return true; } } }

    public sealed class GameObject : Object
    {
        private readonly List<Component> components = new List<Component>();
        public Transform transform = new Transform();
        public GameObject(string name) { this.name = name; }
        public T GetComponent<T>() where T : Component { return (T)components.Find(c => c is T); }

        public T AddComponent<T>() where T : Component, new()
        {
            T made = new T { gameObject = this, name = name };
            components.Add(made);
            return made;
        }
    }

    public sealed class GraphicsBuffer : IDisposable
    {
        [Flags] public enum Target { Vertex = 1, Index = 2, Structured = 16, Raw = 32 }
        public int count { get; private set; }
        public static int Alive;
        public GraphicsBuffer(Target target, int count, int stride) { this.count = count; ++Alive; }
        public void SetData(Array data) { Check(data.Length); }
        public void SetData<T>(NativeArray<T> data) where T : struct { Check(data.Length); }
        public void Dispose() { --Alive; }

        private void Check(int length)
        {
            if (length > count)
                throw new ArgumentException("more than the buffer holds");
        }
    }

    public sealed class ComputeShader : Object
    {
        public readonly Dictionary<string, int> Numbers = new Dictionary<string, int>();
        public int Dispatches;
        public int FindKernel(string name) { return name.Length; }
        public void SetInt(string name, int value) { Numbers[name] = value; }
        public void SetVector(string name, Vector4 value) { }

        public void SetBuffer(int kernel, string name, GraphicsBuffer buffer)
        {
            if (buffer == null)
                throw new ArgumentNullException("buffer");
        }

        public void Dispatch(int kernel, int x, int y, int z) { ++Dispatches; }
    }

    public sealed class Mesh : Object
    {
        public readonly Dictionary<int, Array> Streams = new Dictionary<int, Array>();
        public Array Indices;
        public int Vertices;
        public readonly List<SubMeshDescriptor> SubMeshes = new List<SubMeshDescriptor>();
        public int subMeshCount { get { return SubMeshes.Count; } set { while (SubMeshes.Count < value) SubMeshes.Add(default(SubMeshDescriptor)); } }
        public Bounds bounds { get; set; }
        public GraphicsBuffer.Target vertexBufferTarget { get; set; }
        public GraphicsBuffer GetVertexBuffer(int stream) { return new GraphicsBuffer(GraphicsBuffer.Target.Raw, 1, 4); }
        public void MarkDynamic() { }
        public void SetVertexBufferParams(int count, params VertexAttributeDescriptor[] attributes) { Vertices = count; }

        public void SetVertexBufferData<T>(NativeArray<T> data, int dataStart, int bufferStart, int count, int stream = 0,
            MeshUpdateFlags flags = MeshUpdateFlags.Default) where T : struct
        {
            Streams[stream] = Copy(data, count);
        }

        public void SetIndexBufferParams(int count, IndexFormat format) { }

        public void SetIndexBufferData<T>(NativeArray<T> data, int dataStart, int bufferStart, int count,
            MeshUpdateFlags flags = MeshUpdateFlags.Default) where T : struct
        {
            Indices = Copy(data, count);
        }

        public void SetSubMesh(int index, SubMeshDescriptor sub, MeshUpdateFlags flags = MeshUpdateFlags.Default)
        {
            SubMeshes[index] = sub;
        }

        private static T[] Copy<T>(NativeArray<T> data, int count) where T : struct
        {
            T[] copy = new T[count];
            for (int i = 0; i < count; ++i)
                copy[i] = data[i];
            return copy;
        }
    }
}

namespace UnityEngine.Rendering
{
    public enum VertexAttribute { Position, Normal, Tangent, Color, TexCoord0 }
    public enum VertexAttributeFormat { Float32, Float16 }
    public enum IndexFormat { UInt16, UInt32 }

    [Flags]
    public enum MeshUpdateFlags
    {
        Default = 0, DontValidateIndices = 1, DontResetBoneBounds = 2, DontNotifyMeshUsers = 4, DontRecalculateBounds = 8
    }

    public struct VertexAttributeDescriptor
    {
        public VertexAttributeDescriptor(VertexAttribute attribute, VertexAttributeFormat format, int dimension, int stream) { }
    }

    public struct SubMeshDescriptor
    {
        public int indexStart, indexCount;
        public SubMeshDescriptor(int start, int count) { indexStart = start; indexCount = count; }
    }
}

namespace UnityEngine.Playables
{
    public struct FrameData { }
    public struct PlayableGraph { }
    public interface IPlayable { }

    public class PlayableBehaviour
    {
        public virtual void ProcessFrame(Playable playable, FrameData info, object playerData) { }
    }

    public abstract class PlayableAsset : ScriptableObject
    {
        public abstract Playable CreatePlayable(PlayableGraph graph, GameObject owner);
    }

    public sealed class Node
    {
        public PlayableBehaviour Behaviour;
        public double Time;
        public readonly List<Playable> Inputs = new List<Playable>();
        public readonly List<float> Weights = new List<float>();
    }

    public struct Playable : IPlayable
    {
        public Node Node;
    }

    public struct ScriptPlayable<T> : IPlayable where T : PlayableBehaviour, new()
    {
        public Node Node;
        public static ScriptPlayable<T> Create(PlayableGraph graph, int inputCount = 0)
        {
            return new ScriptPlayable<T> { Node = new Node { Behaviour = new T() } };
        }

        public T GetBehaviour() { return (T)Node.Behaviour; }
        public static implicit operator Playable(ScriptPlayable<T> from) { return new Playable { Node = from.Node }; }
        public static explicit operator ScriptPlayable<T>(Playable from) { return new ScriptPlayable<T> { Node = from.Node }; }
    }

    public static class PlayableExtensions
    {
        public static int GetInputCount(this Playable p) { return p.Node.Inputs.Count; }
        public static float GetInputWeight(this Playable p, int i) { return p.Node.Weights[i]; }
        public static Playable GetInput(this Playable p, int i) { return p.Node.Inputs[i]; }
        public static double GetTime<T>(this ScriptPlayable<T> p) where T : PlayableBehaviour, new() { return p.Node.Time; }
    }
}

namespace UnityEngine.Timeline
{
    using UnityEngine.Playables;

    [Flags] public enum ClipCaps { None = 0, Looping = 1, Extrapolation = 2, ClipIn = 4, SpeedMultiplier = 8, Blending = 16 }
    public interface ITimelineClipAsset { ClipCaps clipCaps { get; } }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class TrackClipTypeAttribute : System.Attribute { public TrackClipTypeAttribute(Type type) { } }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class TrackBindingTypeAttribute : System.Attribute { public TrackBindingTypeAttribute(Type type) { } }

    public class TrackAsset : ScriptableObject
    {
        public virtual Playable CreateTrackMixer(PlayableGraph graph, GameObject owner, int inputCount) { return default(Playable); }
    }
}

namespace UnityEditor.AssetImporters
{
    [AttributeUsage(AttributeTargets.Class)]
    public sealed class ScriptedImporterAttribute : System.Attribute { public ScriptedImporterAttribute(int version, string extension) { } }

    public abstract class ScriptedImporter : UnityEngine.Object
    {
        public abstract void OnImportAsset(AssetImportContext context);
    }

    public class AssetImportContext
    {
        public readonly Dictionary<string, UnityEngine.Object> Added = new Dictionary<string, UnityEngine.Object>();
        public readonly List<string> Errors = new List<string>();
        public UnityEngine.Object Main;
        public string assetPath { get; set; }
        public void AddObjectToAsset(string identifier, UnityEngine.Object made) { Added.Add(identifier, made); }
        public void SetMainObject(UnityEngine.Object main) { Main = main; }
        public void LogImportError(string text) { Errors.Add(text); }
    }
}
