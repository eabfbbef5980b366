// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
using System;
using UnityEngine;
using UnityEngine.Playables;
using UnityEngine.Timeline;

namespace Anicodec.Unity
{
    /// <summary>A track that plays clips of a file on an AnicPlayer; where two overlap, they cross-fade.</summary>
    [TrackClipType(typeof(AnicTimelineClip))]
    [TrackBindingType(typeof(AnicPlayer))]
    public sealed class AnicTrack : TrackAsset
    {
        public override Playable CreateTrackMixer(PlayableGraph graph, GameObject owner, int inputCount)
        {
            return ScriptPlayable<AnicMixer>.Create(graph, inputCount);
        }
    }

    /// <summary>A clip of the file on the track.</summary>
    public sealed class AnicTimelineClip : PlayableAsset, ITimelineClipAsset
    {
        /// <summary>Empty: the first clip of the file.</summary>
        public string clipName = "";

        public ClipCaps clipCaps { get { return ClipCaps.Blending | ClipCaps.ClipIn | ClipCaps.SpeedMultiplier | ClipCaps.Looping; } }

        public override Playable CreatePlayable(PlayableGraph graph, GameObject owner)
        {
            ScriptPlayable<AnicMoment> playable = ScriptPlayable<AnicMoment>.Create(graph, 0);
            playable.GetBehaviour().clipName = clipName;
            return playable;
        }
    }

    [Serializable]
    public sealed class AnicMoment : PlayableBehaviour
    {
        public string clipName = "";
    }

    /// <summary>Shows the two clips that weigh most.</summary>
    public sealed class AnicMixer : PlayableBehaviour
    {
        public override void ProcessFrame(Playable playable, FrameData info, object playerData)
        {
            AnicPlayer player = playerData as AnicPlayer;
            if (player == null || player.clip == null)
                return;
            player.playing = false;
            int first = -1, second = -1;
            float most = 0, next = 0;
            for (int i = 0; i < playable.GetInputCount(); ++i)
            {
                float weight = playable.GetInputWeight(i);
                if (weight > most)
                {
                    second = first;
                    next = most;
                    first = i;
                    most = weight;
                }
                else if (weight > next)
                {
                    second = i;
                    next = weight;
                }
            }
            if (first < 0)
                return;
            ScriptPlayable<AnicMoment> one = (ScriptPlayable<AnicMoment>)playable.GetInput(first);
            player.SetClip(one.GetBehaviour().clipName);
            if (second < 0)
            {
                player.Show(one.GetTime());
                return;
            }
            ScriptPlayable<AnicMoment> other = (ScriptPlayable<AnicMoment>)playable.GetInput(second);
            player.Show(one.GetTime(), player.FindClip(other.GetBehaviour().clipName), other.GetTime(), next / (most + next));
        }
    }
}
