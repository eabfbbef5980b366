// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Sends a capture that is being encoded to all pages that watch it, a message of a WebSocket for each file of the stream:
//
//   capture | anicodec encode --live body.obj --fps 30 --effort fast -o take.anic --json | node server.mjs take.anic [PORT]
//
// A page that joins late gets the last file with meshes, then all since the last that begins anew. The address is printed.
import { open, readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { WebSocketServer } from 'ws';

const root = new URL('../../', import.meta.url);
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };

/** The files of a stream as the command writes them, with what it says of each: { bytes, start, frames, key, has_mesh, seconds }. */
export async function* filesOf(path, lines) {
  let file, at = 0;
  try {
    for await (const line of createInterface({ input: lines })) {
      const facts = JSON.parse(line), bytes = Buffer.alloc(facts.bytes);
      file ??= await open(path);
      await file.read(bytes, 0, bytes.length, at);
      at += bytes.length;
      yield { ...facts, bytes };
    }
  } finally {
    await file?.close();
  }
}

/** Keeps what a page needs that joins now. */
class Backlog {
  files = [];

  add(file) {
    if (file.has_mesh)
      this.files = [];
    else if (file.key)
      this.files.length = 1;
    this.files.push(file);
  }
}

/** A server of the page and of a stream; `lose(number)` says which files get lost on the way. */
export async function serve(files, { port = 0, lose = () => false } = {}) {
  const server = createServer(async ({ url }, response) => {
    const path = new URL(url, 'http://localhost').pathname, name = path === '/' ? 'examples/live/player.html' : path.slice(1);
    try {
      const body = await readFile(fileURLToPath(new URL(name, root)));
      response.writeHead(200, { 'content-type': TYPES[extname(name)] ?? 'application/octet-stream' }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  const sockets = new WebSocketServer({ server, path: '/live' }), backlog = new Backlog();
  let begin;  // of the capture, milliseconds of the clock
  const tell = (socket) => socket.send(JSON.stringify({ begin }));
  sockets.on('connection', (socket) => {
    if (begin !== undefined)
      tell(socket);
    backlog.files.forEach(({ bytes }) => socket.send(bytes));
  });
  await new Promise((resolve) => server.listen(port, '127.0.0.1', resolve));
  const sent = (async () => {
    let number = 0;
    for await (const file of files) {
      // The last frame of a file came before the encoder took it.
      begin ??= Date.now() - 1000 * (file.start + file.length + file.seconds);
      backlog.add(file);
      for (const socket of lose(number) ? [] : sockets.clients) {
        if (number === 0)
          tell(socket);
        socket.send(file.bytes);
      }
      ++number;
    }
    sockets.clients.forEach((socket) => socket.close());
  })();
  const close = () => {
    sockets.clients.forEach((socket) => socket.terminate());
    sockets.close();
    server.close();
  };
  return { url: `http://127.0.0.1:${server.address().port}/`, sent, close };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [path, port] = process.argv.slice(2);
  const { url, sent, close } = await serve(filesOf(path, process.stdin), { port: Number(port ?? 8080) });
  console.log(url);
  await sent;
  close();
}
