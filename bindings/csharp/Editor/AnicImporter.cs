// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System.IO;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Anicodec.Unity
{
    /// <summary>Imports .anic files: a clip, and a prefab with a player for each mesh of it.</summary>
    [ScriptedImporter(1, "anic")]
    public sealed class AnicImporter : ScriptedImporter
    {
        /// <summary>AnicPlay.compute, for players on the graphics card.</summary>
        public ComputeShader shader;

        /// <summary>AnicClip.inPlace of the clip.</summary>
        public bool inPlace;

        public override void OnImportAsset(AssetImportContext context)
        {
            AnicClip clip = ScriptableObject.CreateInstance<AnicClip>();
            clip.name = Path.GetFileNameWithoutExtension(context.assetPath);
            clip.inPlace = inPlace;
            clip.SetBytes(File.ReadAllBytes(context.assetPath));
            try
            {
                GameObject root = new GameObject(clip.name);
                context.AddObjectToAsset("prefab", root);
                context.SetMainObject(root);
                context.AddObjectToAsset("clip", clip);
                for (int m = 0; m < clip.Asset.MeshCount; ++m)
                    AddMesh(context, clip, m, root);
            }
            catch (AnicException failure)
            {
                context.LogImportError(context.assetPath + ": " + failure.Message);
            }
            finally
            {
                clip.Close();
            }
        }

        private void AddMesh(AssetImportContext context, AnicClip clip, int index, GameObject root)
        {
            string name = clip.Asset.GetMesh(index).Name;
            Mesh mesh = AnicMesh.Create(clip, index, name);
            context.AddObjectToAsset("mesh " + index, mesh);
            GameObject child = new GameObject(name);
            child.transform.SetParent(root.transform, false);
            child.AddComponent<MeshFilter>().sharedMesh = mesh;
            Material[] materials = new Material[mesh.subMeshCount];
            for (int i = 0; i < materials.Length; ++i)
            {
                materials[i] = MakeMaterial(clip, index, i);
                context.AddObjectToAsset("material " + index + " " + i, materials[i]);
            }
            child.AddComponent<MeshRenderer>().sharedMaterials = materials;
            AnicPlayer player = child.AddComponent<AnicPlayer>();
            player.clip = clip;
            player.mesh = index;
            player.shader = shader;
        }

        /// <summary>The material of a submesh, with the look that the file tells; images are for the project to assign.</summary>
        private static Material MakeMaterial(AnicClip clip, int mesh, int submesh)
        {
            Material material = new Material(Shader.Find("Standard")) { name = "material" };
            int label = (int)clip.Plan(mesh).GroupMaterials[submesh] - 1;
            for (int a = 0; label >= 0 && a < clip.Asset.GetMesh(mesh).AttributeCount; ++a)
            {
                if (clip.Asset.GetAttribute(a, mesh).Kind != AttributeKind.Material)
                    continue;
                material.name = clip.Asset.GetLabelName(a, label, mesh);
                MaterialLook look = clip.Asset.GetMaterial(a, label, mesh);
                if (look == null)
                    break;
                float[] c = look.BaseColour;
                material.color = new Color(c[0], c[1], c[2], c[3]).gamma;
                material.SetFloat("_Metallic", look.Metallic);
                material.SetFloat("_Glossiness", 1 - look.Roughness);
                break;
            }
            return material;
        }
    }
}
