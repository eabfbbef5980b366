// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Two dancers of one file, half a turn apart. A click on one puts a ball there, which stays on the surface.
import { Component, Suspense, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { Canvas } from '@react-three/fiber';
import { Anic, AnicAnchor } from 'anicodec/react';

function Dancer(props) {
  const [hit, setHit] = useState();
  const place = (event) => {
    event.stopPropagation();
    setHit(event);
  };
  return (
    <Anic src="dancer.anic" onClick={place} {...props}>
      {hit && (
        <AnicAnchor point={hit}>
          <mesh>
            <sphereGeometry args={[0.06]} />
            <meshStandardMaterial color="crimson" />
          </mesh>
        </AnicAnchor>
      )}
    </Anic>
  );
}

/** Says what could not be shown. */
class Problem extends Component {
  state = {};

  static getDerivedStateFromError(error) {
    return { error };
  }

  render() {
    return this.state.error ? <p>{String(this.state.error)}</p> : this.props.children;
  }
}

createRoot(document.getElementById('root')).render(
  <Problem>
    <Canvas camera={{ position: [0, 0, 3] }}>
      <hemisphereLight args={['white', 'slategray']} />
      <directionalLight position={[1, 2, 3]} intensity={2} />
      <Suspense fallback={null}>
        <Dancer position={[-0.8, -1, 0]} />
        <Dancer position={[0.8, -1, 0]} rotation={[0, Math.PI, 0]} speed={0.5} />
      </Suspense>
    </Canvas>
  </Problem>,
);
