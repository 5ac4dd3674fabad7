// Where each dot of a picture comes from: which line, beam and bin, by the kind of sonar.
import type { Ping } from "./news";

export type Kind = "fan" | "circle" | "echogram" | "sidescan" | "range image" | "strength image" | "profile" | "depth";

export const width = 480;
export const height = 360;

/** A fan seen from above, its axis up, or from astern, its axis down. */
export interface Frame {
  centre: [number, number]; // dots
  scale: number; // dots a metre
  down: boolean;
}

/** Of one dot: index of a level of a ping, -1 for none. */
export interface Sketch {
  key: string;
  index: Int32Array; // of width x height dots
  frame: Frame;
}

/** `turns`: its pings look in several directions. `waterfall`: a side-scan of one beam. */
export function kindOf(ping: Ping, turns: boolean, waterfall: boolean): Kind {
  if (ping.rows > 1) return ping.bins === 1 ? "strength image" : "range image";
  if (ping.bins === 0) return ping.numbered || ping.beams === 1 ? "depth" : "profile";
  if (waterfall || (ping.sides && ping.beams === 2)) return "sidescan";
  if (ping.sides || ping.numbered) return "echogram"; // of several beams that look to all sides
  if (ping.beams > 1) return "fan";
  return turns ? "circle" : "echogram";
}

/** m; of a picture without levels the farthest range, rounded up. */
export function farthest(ping: Ping): number {
  if (ping.bins > 0) return ping.first_range + ping.bins * ping.bin_size;
  let far = 0;
  for (const range of ping.ranges ?? []) far = Math.max(far, range);
  const step = ringStep(Math.max(far, 1));
  return Math.ceil((far * 1.05) / step) * step || 1;
}

/** Beyond half a circle the sonar is in the middle. */
export function frameOf(ping: Ping, far: number): Frame {
  const wide = Math.max(Math.abs(ping.bearings[0] + ping.pan), Math.abs(ping.bearings[ping.beams - 1] + ping.pan));
  const below = wide > Math.PI / 2 ? -Math.cos(Math.min(wide, Math.PI)) : 0;
  const across = wide > Math.PI / 2 ? 1 : Math.max(Math.sin(wide), 0.1);
  const scale = Math.min((height - 24) / (far * (1 + below)), (width - 16) / (2 * far * across));
  const y = height - 12 - far * below * scale;
  return { centre: [width / 2, ping.down ? height - y : y], scale, down: ping.down };
}

/** m to the right and along the axis, of a dot. */
export function placeIn(frame: Frame, x: number, y: number): [number, number] {
  const along = (frame.centre[1] - y) / frame.scale;
  return [(x - frame.centre[0]) / frame.scale, frame.down ? -along : along];
}

/** The dot of a place. */
export function dotIn(frame: Frame, range: number, bearing: number): [number, number] {
  const along = range * Math.cos(bearing) * frame.scale;
  return [frame.centre[0] + range * Math.sin(bearing) * frame.scale, frame.centre[1] + (frame.down ? along : -along)];
}

export function fanSketch(ping: Ping): Sketch {
  const frame = frameOf(ping, farthest(ping));
  const index = new Int32Array(width * height).fill(-1);
  const half = ping.beams > 1 ? (ping.bearings[ping.beams - 1] - ping.bearings[0]) / (ping.beams - 1) : ping.beam_width;
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const [right, ahead] = placeIn(frame, x + 0.5, y + 0.5);
      const bin = Math.floor((Math.hypot(right, ahead) - ping.first_range) / ping.bin_size);
      if (bin < 0 || bin >= ping.bins) continue;
      const beam = nearest(ping.bearings, Math.atan2(right, ahead) - ping.pan, half);
      if (beam >= 0) index[y * width + x] = beam * ping.bins + bin;
    }
  return { key: fanKey(ping), index, frame };
}

/** Four digits of ranges: those of a message vary with the speed of sound that it tells, by less than a dot. */
export function fanKey(ping: Ping): string {
  return [ping.beams, ping.bins, ping.first_range.toPrecision(4), ping.bin_size.toPrecision(4), ping.pan, ping.bearings[0], ping.bearings[ping.beams - 1], ping.down].join(" ");
}

/** Index of the value next to `at` in an ascending row; -1 where none is within `reach`. */
export function nearest(row: number[], at: number, reach: number): number {
  let low = 0;
  let high = row.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (row[middle] <= at) low = middle;
    else high = middle;
  }
  const best = Math.abs(row[low] - at) <= Math.abs(row[high] - at) ? low : high;
  return Math.abs(row[best] - at) <= reach ? best : -1;
}

export function ringStep(far: number): number {
  const rough = far / 4;
  const ten = 10 ** Math.floor(Math.log10(rough));
  return ten * (rough / ten >= 5 ? 5 : rough / ten >= 2 ? 2 : 1);
}

export function plain(value: number): string {
  return String(Math.round(value * 100) / 100);
}
