// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A thread that opens one file, sends the memory of the decoders, and is ended by whoever started it.
import { Opening, packError } from './opening.js';
import { provideModule } from './module.js';

let opening;
let last = Promise.resolve();  // messages are taken one after the other

const take = {
  begin({ options, modules }) {
    for (const [kind, module] of Object.entries(modules))
      provideModule(kind, module);
    opening = new Opening({
      ...options,
      onProgress: (done) => postMessage({ type: 'progress', done }),
      onDecoder(decoder, complete) {
        const snapshot = decoder.snapshot();
        postMessage({ type: 'decoder', snapshot, complete, kind: opening.kind }, [snapshot.memory]);
      },
    });
  },
  push: ({ bytes }) => opening.push(bytes),
  end: () => opening.end(),
};

onmessage = ({ data }) => {
  last = last.then(() => take[data.type](data)).catch((error) => postMessage({ type: 'error', error: packError(error) }));
};
