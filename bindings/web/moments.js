// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Moments out of the animation systems of engines, which mix numbers: for each clip of a file its weight, and its time by the weight.

/** Moments of the clips that play, the largest weight first; where none does, that of `set`. */
export function momentsOf(weights, times, set) {
  const moments = weights.map((weight, clip) => ({ clip, weight, time: times[clip] / weight })).filter(({ weight }) => weight > 0);
  return moments.length > 0 ? moments.sort((a, b) => b.weight - a.weight) : [{ ...set, weight: 1 }];
}

/** The same as a time and options of ClipMesh.positions(), and a text that differs if they do. */
export function sampleOf([{ clip, time, weight }, ...others], { sampling, wrap }) {
  let all = weight;
  const blend = others.map((moment) => ({ ...moment, weight: moment.weight / (all += moment.weight) }));
  return { time, options: { sampling, wrap, clip, blend }, key: JSON.stringify([clip, time, blend, sampling, wrap]) };
}

/**
 * The step of a character between the moments shown before and the moments shown now: a turn, and a move. Clips that came in
 * since then have not moved. A time before that of a loop is one of its next turn.
 */
export function rootStepOf(file, before, now, { sampling, wrap }) {
  const total = now.reduce((sum, { weight }) => sum + weight, 0), step = { turn: 0, move: [0, 0, 0] };
  for (const { clip, time, weight } of now) {
    const last = before.find((moment) => moment.clip === clip), { loop, loopDuration } = file.clips[clip];
    if (!last)
      continue;
    const turns = (wrap ?? (loop ? 'loop' : 'clamp')) === 'loop';
    const { turn, move } = file.rootStep(last.time, turns && time < last.time ? time + loopDuration : time, { clip, sampling, wrap });
    step.turn += turn * weight / total;
    move.forEach((x, c) => { step.move[c] += x * weight / total; });
  }
  return step;
}
