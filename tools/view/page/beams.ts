// Where a ping's beams are in the world. East, north, up.
import { levelOf, type Ping, type PoseNumbers } from "./news";
import { farthest } from "./sketch";

export type Vector = [number, number, number];
export type Matrix = Float32Array; // 4 x 4, column by column

/** A vector of a body in the world. */
export function rotated([, , , w, x, y, z]: PoseNumbers, [a, b, c]: Vector): Vector {
  return [
    (1 - 2 * (y * y + z * z)) * a + 2 * (x * y - w * z) * b + 2 * (x * z + w * y) * c,
    2 * (x * y + w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z - w * x) * c,
    2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b + (1 - 2 * (x * x + y * y)) * c,
  ];
}

export function matrixOf(pose: PoseNumbers): Matrix {
  const columns = [rotated(pose, [1, 0, 0]), rotated(pose, [0, 1, 0]), rotated(pose, [0, 0, 1])];
  return new Float32Array([...columns[0], 0, ...columns[1], 0, ...columns[2], 0, pose[0], pose[1], pose[2], 1]);
}

/** Corners of lines: the outline of what a ping sees, each end at its last bin. */
export function beamsOf(ping: Ping): number[] {
  const far = farthest(ping);
  const place = (bearing: number, elevation: number): Vector => placeOf(ping, far, bearing, elevation);
  const first = ping.bearings[0] - ping.beam_width / 2;
  const last = ping.bearings[ping.beams - 1] + ping.beam_width / 2;
  const low = (ping.elevations[0] ?? 0) - ping.fan_height / 2;
  const high = (ping.elevations[ping.rows - 1] ?? 0) + ping.fan_height / 2;
  const steps = 24;
  const out: number[] = [];
  const own = ping.sonar.slice(0, 3);
  for (const e of [low, high])
    for (let i = 0; i < steps; i++)
      out.push(...place(first + ((last - first) * i) / steps, e), ...place(first + ((last - first) * (i + 1)) / steps, e));
  for (const b of [first, last]) {
    out.push(...place(b, low), ...place(b, high));
    for (const e of [low, high]) out.push(...own, ...place(b, e));
  }
  return out;
}

function placeOf(ping: Ping, range: number, bearing: number, elevation: number): Vector {
  const e = elevation + ping.tilt;
  const b = bearing + ping.pan;
  const [x, y, z] = rotated(ping.sonar, [Math.cos(e) * Math.cos(b), -Math.cos(e) * Math.sin(b), Math.sin(e)]);
  return [ping.sonar[0] + x * range, ping.sonar[1] + y * range, ping.sonar[2] + z * range];
}

/** Corners of lines: what a beam covers where its loudest echo of an object is, of at most 64 columns and 16 rows. */
export function footprintsOf(ping: Ping): number[] {
  const out: number[] = [];
  const [wide, tall] = [Math.ceil(ping.beams / 64), Math.ceil(ping.rows / 16)];
  const across = (ping.beam_width * wide) / 2;
  const up = (ping.fan_height * tall) / 2;
  for (let row = 0; row < ping.rows; row += tall)
    for (let column = 0; column < ping.beams; column += wide) {
      const range = loudestRange(ping, row * ping.beams + column);
      if (range === 0) continue;
      const [b, e] = [ping.bearings[column], ping.elevations[row] ?? 0];
      const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => placeOf(ping, range, b + x * across, e + y * up));
      corners.forEach((corner, i) => out.push(...corner, ...corners[(i + 1) % 4]));
    }
  return out;
}

/** Of an object; where objects were not drawn, of what stands out of the noise. */
function loudestRange(ping: Ping, beam: number): number {
  const quiet = ping.noise === null ? Infinity : ping.noise + 13; // dB
  const counts = (at: number): boolean => (ping.seen !== null ? ping.seen[at] > 0 : levelOf(ping, ping.levels[at]) > quiet);
  let best = -1;
  for (let at = beam * ping.bins; at < (beam + 1) * ping.bins; at++)
    if (counts(at) && ping.levels[at] > (best < 0 ? 0 : ping.levels[best])) best = at;
  return best < 0 ? 0 : ping.first_range + (best - beam * ping.bins + 0.5) * ping.bin_size;
}
