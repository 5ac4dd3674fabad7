// node page_picture.mjs BUNDLE: the page's own code (picture.ts, news.ts, palette.ts) draws the pings that come as lines of
// JSON, {"message": base64, "top": dB}; prints the dots of each, red, green, blue, in base64.
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { writeSync } from "node:fs";

const context = { createImageData: (width, height) => ({ data: new Uint8ClampedArray(width * height * 4) }) };
globalThis.document = { createElement: () => ({ getContext: () => context }) };
const { Picture, pingOf, paletteOf } = createRequire(import.meta.url)(process.argv[2]);

const look = { palette: paletteOf("copper"), span: 60 };
const picture = new Picture(false);
for await (const line of createInterface({ input: process.stdin })) {
  const { message, top } = JSON.parse(line);
  const bytes = Buffer.from(message, "base64");
  picture.take(pingOf(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)));
  picture.top = top; // it depends on the pings before
  const { data } = picture.image(context, look, false);
  writeSync(1, Buffer.from(data.filter((_, i) => i % 4 !== 3)).toString("base64") + "\n");
}
