// node validate.mjs MODULES FILE: reads a bag from its start and by its index with @mcap/core, all CRCs checked; prints
// the number of messages of each.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const [modules, file] = process.argv.slice(2);
const require = createRequire(modules + "/");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { loadDecompressHandlers } = require("@mcap/support");

const bytes = readFileSync(file);
const decompressHandlers = await loadDecompressHandlers();
const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(bytes);
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") streamed++;

const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
};
const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
let last = 0n;
let found = 0;
for await (const message of indexed.readMessages({ validateCrcs: true })) {
  if (message.logTime < last) throw new Error("messages are not in their order");
  last = message.logTime;
  found++;
}
for await (const attachment of indexed.readAttachments({ validateCrcs: true })) void attachment;
console.log(JSON.stringify({ done: stream.done(), streamed, indexed: found, counted: Number(indexed.statistics.messageCount) }));
