// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in React, by @react-three/fiber: a hook, and components over it.
import { createContext, createElement, useContext, useEffect, useLayoutEffect, useMemo, useRef } from 'react';
import { useFrame, useLoader, useThree } from '@react-three/fiber';
import { AnicLoader } from './three.js';

const loaders = new Map();  // by options, as fiber keeps what it has loaded by loader and address
const Shown = createContext(undefined);

function loaderOf(options = {}) {
  const key = JSON.stringify(Object.entries(options).sort());
  if (!loaders.has(key))
    loaders.set(key, new AnicLoader().setOptions(options));
  return loaders.get(key);
}

/** An AnicMesh of the component's own, of a file that is opened once for all. The component suspends until it is there. */
export function useAnic(src, options) {
  const loaded = useLoader(loaderOf(options), src), mesh = useMemo(() => loaded.clone(), [loaded]);
  useEffect(() => () => mesh.dispose(), [mesh]);
  return mesh;
}

useAnic.preload = (src, options) => useLoader.preload(loaderOf(options), src);
useAnic.clear = (src, options) => useLoader.clear(loaderOf(options), src);

/** Plays a clip, or shows it at `time`. */
export function Anic({
  src, options, clip, time, playing = true, speed = 1, loop = true, fade = 0, sampling, wrap, material, field, low, high, castShadow = false,
  receiveShadow = false, children, ...props
}) {
  const mesh = useAnic(src, options), invalidate = useThree((state) => state.invalidate), action = useRef(undefined), held = time !== undefined;
  useLayoutEffect(() => {
    mesh.parts.forEach((part) => Object.assign(part, { castShadow, receiveShadow }));
  }, [mesh, castShadow, receiveShadow]);
  useLayoutEffect(() => {
    const own = mesh.parts.map((part) => part.material);
    mesh.parts.forEach((part) => { part.material = material ?? part.material; });
    mesh.showField(field, { low, high });
    return () => {
      mesh.showField();
      mesh.parts.forEach((part, i) => { part.material = own[i]; });
    };
  }, [mesh, material, field, low, high]);
  useLayoutEffect(() => {
    Object.assign(mesh, { sampling, wrap });
    if (held) {
      mesh.stop();
      Object.assign(mesh, { current: clip, time });
    }
    mesh.refresh();
    invalidate();
  });
  // No layout effects: these begin anew when a Suspense around hides its children for a while.
  useEffect(() => {
    if (!held)
      action.current = mesh.play(clip, { loop, fade });
  }, [mesh, clip, held, loop, fade]);
  useEffect(() => {
    if (held)
      return;
    action.current.timeScale = playing ? speed : 0;
    invalidate();
  }, [mesh, clip, held, loop, fade, playing, speed]);
  useFrame((state, seconds) => {
    if (held || !playing)
      return;
    mesh.update(seconds);
    state.invalidate();
  });
  return createElement(Shown.Provider, { value: mesh }, createElement('primitive', { ...props, object: mesh }, children));
}

/** Children on a point of the surface of the Anic around it. */
export function AnicAnchor({ point, children, ...props }) {
  const mesh = useContext(Shown), group = useRef(undefined);
  useLayoutEffect(() => { mesh.anchor(point, group.current); }, [mesh, point]);
  return createElement('group', { ref: group }, createElement('group', props, children));
}
