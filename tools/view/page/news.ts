// What the program tells the page, and how its bytes are read (tools/view/picture.h, ticker.h).

export type PoseNumbers = [number, number, number, number, number, number, number]; // x y z, w x y z

export interface PingHead {
  type: "ping";
  device: string;
  number: number;
  t: number; // s, of the run
  late: number; // s
  drawn: number; // s after the transmission, when the echogram was there
  due: number; // s after the transmission
  unit: string;
  floor: number; // dB of byte 1
  step: number; // dB
  noise: number | null; // dB
  rows: number;
  beams: number; // of one row
  bins: number;
  bearings: number[]; // rad, clockwise
  elevations: number[]; // rad
  beam_width: number; // rad
  fan_height: number; // rad
  pan: number;
  tilt: number;
  sides: boolean;
  first_range: number; // m, leading edge of bin 0
  bin_size: number; // m
  frequency: number;
  pulse_length: number;
  source_level: number;
  sonar: PoseNumbers;
  objects: boolean;
  movers: PoseNumbers[];
}

/** What a picture is drawn from: what a sonar has heard, or what it has said. */
export interface Ping extends Omit<PingHead, "type"> {
  type: "ping" | "said";
  name: string; // of the message that said it; "" of what was heard
  series: string; // whose pictures go on from each other: of one frequency, or of one message
  down: boolean; // the middle looks down
  waterfall: boolean; // a side-scan
  assumed: boolean; // ranges are those at 1500 m/s
  numbered: boolean; // bearings are numbers of beams
  levels: Uint8Array; // beam by beam; 0: nothing
  seen: Uint16Array | null; // 1 + index of the object; null: not told
  seenOf: number; // the ping that these objects are of: not each has its own (tools/view/feed.h)
  ranges: Float32Array | null; // m, of each beam; 0: none
}

/** The head of a picture that was read back from the wire (tools/view/said_picture.h); t is s since 1970. */
interface SaidHead {
  type: "said";
  device: string;
  name: string;
  number: number;
  t: number;
  unit: string;
  floor: number;
  step: number;
  rows: number;
  beams: number;
  bins: number;
  bearings: number[];
  elevations: number[];
  pan: number;
  numbered: boolean;
  waterfall: boolean;
  down: boolean;
  assumed: boolean;
  first_range: number;
  bin_size: number;
  ranges: boolean;
}

export interface Hello {
  type: "hello";
  version: string;
  scenario: string;
  captured: boolean; // of a capture: nothing is heard, there is no scene
  control: boolean;
  record: boolean; // the page may begin a recording
  devices: { name: string; model: string; title: string; places: string[]; sonar?: boolean }[]; // false: a unit that sends no pings
  faults: { name: string; help: string; momentary: boolean; parameters: Record<string, number> }[];
}

export interface Message {
  n: number;
  unix: number;
  device: string;
  port: string;
  sent: boolean;
  size: number;
  name: string;
  reason: string;
  bytes: string;
  fields: [string, string, string][];
  fault?: string; // what was made on it
  parts?: number; // messages of the kind in a row that this one stands for
}

/** Numbers that a device has said, of the longest array of a message. */
export interface Said {
  device: string;
  name: string; // "HeadData.bins"
  unit: string;
  numbers: number[];
}

/** The last message of its kind that a driver has said. */
export interface Setting {
  device: string;
  name: string;
  unix: number;
  times: number;
  fields: [string, string, string][];
  changed: string[]; // names of the fields that differ from the one before
}

/** What a port has carried. */
export interface Line {
  device: string;
  port: string;
  in: number; // bytes to the device since somebody looks
  out: number;
  rate: number; // bit/s of a serial line; 0: of none
}

export interface Answer {
  ok: boolean;
  error?: string;
  cleared?: number;
  id?: number;
  recording?: string;
  recorded?: string;
  packets?: number;
  faults?: { id: number; device: string; kind: string; on: boolean; made: number }[];
}

export interface DeviceStatus {
  name: string;
  pings: number;
  late_pings: number;
  messages: number;
  rejected: number;
  skipped_bytes: number;
  bytes_in: number;
  bytes_out: number;
  waiting: number; // messages in the outbox
  waiting_bytes: number;
  connected: string[];
  faults: Record<string, number>;
}

/** Pings in the render threads. */
export interface Rendering {
  threads: number;
  drawing: number;
  waiting: number;
}

export type News =
  | Hello
  | Ping
  | { type: "messages"; left_out: number; messages: Message[]; said: Said[]; set: Setting[] }
  | { type: "lines"; t: number; lines: Line[] }
  | { type: "status"; status: { t: number; recording?: string; rendering?: Rendering; devices: DeviceStatus[] } }
  | { type: "answer"; id: number; answer: Answer };

export interface SceneNews {
  name: string;
  objects: string[];
  triangles: number;
  parts: { mover: number; corners: number }[];
  bounds: [[number, number, number], [number, number, number]];
}

/** The JSON in front, and where the rest begins. */
export function headOf<T>(buffer: ArrayBuffer): { head: T; rest: number } {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as T;
  return { head, rest: 4 + length };
}

export function pingOf(buffer: ArrayBuffer): Ping {
  const { head, rest } = headOf<PingHead | SaidHead>(buffer);
  const count = head.rows * head.beams * head.bins;
  const levels = new Uint8Array(buffer, rest, count);
  if (head.type === "said") {
    const directions = head.rows * head.beams;
    const ranges = head.ranges ? new Float32Array(buffer.slice(rest + count, rest + count + 4 * directions)) : null;
    const spacing = head.beams > 1 ? Math.abs(head.bearings[head.beams - 1] - head.bearings[0]) / (head.beams - 1) : 0.02;
    return {
      ...head, series: head.name, levels, ranges, seen: null, seenOf: 0, late: 0, drawn: 0, due: 0, noise: null, beam_width: spacing, fan_height: 0, tilt: 0,
      sides: head.waterfall && head.beams === 2, frequency: 0, pulse_length: 0, source_level: 0, sonar: [0, 0, 0, 1, 0, 0, 0],
      objects: false, movers: [],
    };
  }
  const seen = head.objects ? new Uint16Array(buffer.slice(rest + count, rest + 3 * count)) : null;
  const [, , , w, x, y, z] = head.sonar;
  const down = 2 * (x * z - w * y) < -0.7; // the axis in the world
  const series = `${Math.round(head.frequency / 1000)} kHz`;
  return { ...head, name: "", series, down, waterfall: false, assumed: false, numbered: false, levels, seen, seenOf: head.number, ranges: null };
}

/** dB of a byte; NaN for nothing. */
export function levelOf(ping: Ping, byte: number): number {
  return byte === 0 ? NaN : ping.floor + (byte - 1) * ping.step;
}
