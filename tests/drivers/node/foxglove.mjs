// node foxglove.mjs MODULES URL TOPIC...: subscribes by @foxglove/ws-protocol, and prints a line of JSON for the server,
// for each channel, and for the first message of each topic; then it ends.
import { writeSync } from "node:fs";
import { createRequire } from "node:module";

const [modules, url, ...topics] = process.argv.slice(2);
const require = createRequire(modules + "/");
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");

const say = (line) => writeSync(1, JSON.stringify(line) + "\n"); // process.exit() waits for no other
const client = new FoxgloveClient({ ws: new WebSocket(url, ["foxglove.sdk.v1", FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
const wanted = new Map();
const left = new Set(topics);
client.on("serverInfo", (info) => say({ server: info.name, capabilities: info.capabilities }));
client.on("error", (error) => { say({ error: String(error.message ?? error) }); process.exit(1); });
client.on("advertise", (channels) => {
  for (const channel of channels) {
    say({ channel: channel.topic, type: channel.schemaName, encoding: channel.encoding, schema: channel.schema });
    if (left.has(channel.topic)) wanted.set(client.subscribe(channel.id), channel.topic);
  }
});
client.on("message", ({ subscriptionId, timestamp, data }) => {
  const topic = wanted.get(subscriptionId);
  if (!left.delete(topic)) return;
  say({ topic, time: String(timestamp), data: Buffer.from(data.buffer, data.byteOffset, data.byteLength).toString("base64") });
  if (left.size === 0) process.exit(0);
});
