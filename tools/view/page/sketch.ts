// Where each dot of a card's picture comes from: which line, beam and bin, by the kind of sonar.
import type { Ping } from "./news";

export type Kind = "fan" | "circle" | "echogram" | "sidescan" | "range image";

export const width = 480;
export const height = 360;

/** Of one dot: index of a level in a line, -1 for none. */
export interface Sketch {
  key: string;
  index: Int32Array; // of width x height dots, into the levels of a ping or of all lines
  metres: (range: number) => number; // dots
  centre: [number, number];
}

export function kindOf(ping: Ping, turns: boolean): Kind {
  if (ping.rows > 1) return "range image";
  if (ping.sides) return "sidescan";
  if (ping.beams > 1) return "fan";
  return turns ? "circle" : "echogram";
}

export function farthest(ping: Ping): number {
  return ping.first_range + ping.bins * ping.bin_size;
}

/** A fan seen from above, its axis up; beyond half a circle the sonar is in the middle. */
export function fanSketch(ping: Ping): Sketch {
  const first = ping.bearings[0] + ping.pan;
  const last = ping.bearings[ping.beams - 1] + ping.pan;
  const wide = Math.max(Math.abs(first), Math.abs(last));
  const far = farthest(ping);
  const below = wide > Math.PI / 2 ? -Math.cos(Math.min(wide, Math.PI)) : 0;
  const across = wide > Math.PI / 2 ? 1 : Math.max(Math.sin(wide), 0.1);
  const scale = Math.min((height - 24) / (far * (1 + below)), (width - 16) / (2 * far * across));
  const cx = width / 2;
  const cy = height - 12 - far * below * scale;
  const index = new Int32Array(width * height).fill(-1);
  const half = ping.beams > 1 ? (last - first) / (ping.beams - 1) : ping.beam_width;
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const right = (x + 0.5 - cx) / scale;
      const ahead = (cy - y - 0.5) / scale;
      const bin = Math.floor((Math.hypot(right, ahead) - ping.first_range) / ping.bin_size);
      if (bin < 0 || bin >= ping.bins) continue;
      const bearing = Math.atan2(right, ahead) - ping.pan;
      const beam = nearest(ping.bearings, bearing, half);
      if (beam >= 0) index[y * width + x] = beam * ping.bins + bin;
    }
  return { key: fanKey(ping), index, metres: (range) => range * scale, centre: [cx, cy] };
}

export function fanKey(ping: Ping): string {
  return [ping.beams, ping.bins, ping.first_range, ping.bin_size, ping.pan, ping.bearings[0], ping.bearings[ping.beams - 1]].join(" ");
}

/** Index of the value next to `at` in an ascending row; -1 where none is within `reach`. */
function nearest(row: number[], at: number, reach: number): number {
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
