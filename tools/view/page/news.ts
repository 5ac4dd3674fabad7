// What the program tells the page, and how its bytes are read (tools/view/picture.h, ticker.h).

export type PoseNumbers = [number, number, number, number, number, number, number]; // x y z, w x y z

export interface PingHead {
  type: "ping";
  device: string;
  number: number;
  t: number; // s, of the run
  late: number; // s
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

export interface Ping extends PingHead {
  levels: Uint8Array; // beam by beam; 0: nothing
  seen: Uint16Array | null; // 1 + index of the object
}

export interface Hello {
  type: "hello";
  version: string;
  scenario: string;
  control: boolean;
  devices: { name: string; title: string; places: string[] }[];
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
  parts?: number; // messages of the kind in a row that this one stands for
}

/** Numbers that a device has said, of the longest array of a message. */
export interface Said {
  device: string;
  name: string; // "HeadData.bins"
  unit: string;
  numbers: number[];
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
  connected: string[];
  faults: Record<string, number>;
}

export type News =
  | Hello
  | Ping
  | { type: "messages"; left_out: number; messages: Message[]; said: Said[] }
  | { type: "status"; status: { t: number; devices: DeviceStatus[] } }
  | { type: "answer"; id: number; answer: { ok: boolean; error?: string; cleared?: number } };

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
  const { head, rest } = headOf<PingHead>(buffer);
  const count = head.rows * head.beams * head.bins;
  const levels = new Uint8Array(buffer, rest, count);
  const seen = head.objects ? new Uint16Array(buffer.slice(rest + count, rest + 3 * count)) : null;
  return { ...head, levels, seen };
}

/** dB of a byte; NaN for nothing. */
export function levelOf(ping: Ping, byte: number): number {
  return byte === 0 ? NaN : ping.floor + (byte - 1) * ping.step;
}
