// Reads a recording with @mcap/core, by its index and from the front, every checksum compared: node mcap_core.mjs
// NODE_MODULES RECORDING. Prints {"error"} or {"topics", "messages", "streamed", "attachments", "chunks"}.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const [modules, recording] = process.argv.slice(2);

// zstd(1) refuses data whose own checksum is wrong.
const decompressHandlers = {
  zstd: (packed, size) => {
    const bytes = execFileSync('zstd', ['-d', '-c'], { input: packed, maxBuffer: 1 << 28 });
    if (BigInt(bytes.length) !== size) throw new Error(`a chunk unpacks to ${bytes.length} bytes, not ${size}`);
    return new Uint8Array(bytes);
  },
};

try {
  const { McapIndexedReader, McapStreamReader } = createRequire(join(modules, 'node_modules', 'index.js'))('@mcap/core');
  const bytes = new Uint8Array(readFileSync(recording));
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  let messages = 0;
  const topics = {};
  let last = 0n;
  for await (const message of indexed.readMessages({ validateCrcs: true })) {
    if (message.logTime < last) throw new Error('the index is not in order of time');
    last = message.logTime;
    const { topic } = indexed.channelsById.get(message.channelId);
    topics[topic] = (topics[topic] ?? 0) + 1;
    ++messages;
  }
  let attachments = 0;
  for await (const attachment of indexed.readAttachments({ validateCrcs: true })) attachments += attachment.data.length > 0 ? 1 : 0;

  const stream = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  stream.append(bytes);
  let streamed = 0;
  for (let record = stream.nextRecord(); record; record = stream.nextRecord()) streamed += record.type === 'Message' ? 1 : 0;
  if (!stream.done()) throw new Error('read from the front it has no end');
  console.log(JSON.stringify({ topics, messages, streamed, attachments, chunks: indexed.chunkIndexes.length }));
} catch (error) {
  console.log(JSON.stringify({ error: String(error.stack ?? error) }));
}
