// One picture of a sonar in dB or counts, drawn as it comes, and what lies under the pointer.
import { drawOverlay, type Look } from "./overlay";
import { levelOf, type Ping } from "./news";
import { dotIn, fanKey, fanSketch, farthest, frameOf, height, kindOf, nearest, placeIn, width, type Kind, type Sketch } from "./sketch";

/** A level of the picture: the ping, the beam (all rows counted) and the bin; -1: the beam's range alone. */
export interface Spot {
  ping: Ping;
  beam: number;
  bin: number;
}

const slots = 720; // directions of a full circle
export const scopeWidth = 70; // dots of an echogram's A-scan
export const beamColours = ["#ffd27f", "#7fd8ff", "#ff9ecb", "#a5e88a"]; // of a Doppler log's

export class Picture {
  readonly canvas = document.createElement("canvas");
  kind: Kind = "fan";
  last: Ping | null = null;
  top = -Infinity; // dB
  private bottom = Infinity; // dB, the quietest that was said
  far = 1; // m, of profiles and depths: it grows with what comes
  private began = 1; // m, `far` of the first of the lines
  pointer: [number, number] | null = null;
  ruler: [number, number] | null = null; // dots, where it begins
  stale = false;
  private lines: (Ping | undefined)[] = []; // circle: by direction; others: by time
  private sketch: Sketch | null = null;
  private pans = new Set<number>();

  /** `waterfall`: it is a side-scan of one beam. */
  constructor(private readonly waterfall: boolean) {
    this.canvas.width = width;
    this.canvas.height = height;
  }

  reset(): void {
    this.last = null;
    this.lines = [];
    this.top = -Infinity;
    this.bottom = Infinity;
    this.far = 1;
    this.pans.clear();
    this.stale = true;
    this.canvas.getContext("2d")!.clearRect(0, 0, width, height);
  }

  take(ping: Ping): void {
    this.pans.add(Math.round(ping.pan * 1000));
    const kind = kindOf(ping, this.pans.size > 1, this.waterfall || ping.waterfall);
    const grows = kind === "profile" || kind === "depth";
    // the speed of sound that a message tells varies a little, and its ranges with it
    const alike = this.last !== null && ping.bins === this.last.bins && (grows || Math.abs(farthest(ping) / this.began - 1) < 0.01);
    if (!alike || kind !== this.kind) {
      const first = alike && kind === "circle" ? this.last : null; // before it turned
      this.lines = [];
      if (first !== null) this.lines[slotOf(first.pan)] = first;
      this.top = -Infinity;
      this.bottom = Infinity;
      this.kind = kind;
      this.began = farthest(ping);
    }
    if (kind !== "echogram" && kind !== "sidescan") inheritObjects(ping, kind === "circle" ? this.lineAt(slotOf(ping.pan)) : this.last);
    this.last = ping;
    this.far = grows ? Math.max(this.far, farthest(ping)) : farthest(ping);
    let loudest = 0;
    let quietest = 256;
    for (const byte of ping.levels) {
      if (byte > loudest) loudest = byte;
      if (byte > 0 && byte < quietest) quietest = byte;
    }
    if (ping.type === "said" && quietest < 256) this.bottom = Math.min(this.bottom, levelOf(ping, quietest));
    this.top = Math.max(this.top - 0.2, levelOf(ping, loudest) || -Infinity); // sinks slowly
    if (kind === "circle") this.lines[slotOf(ping.pan)] = ping;
    if (kind === "echogram" || kind === "sidescan" || kind === "depth") {
      this.lines.push(ping);
      if (this.lines.length > width) this.lines.shift();
    }
    this.stale = true;
  }

  /** dB that is drawn black: what was said goes no lower than its scale. */
  low(look: Look): number {
    const low = this.top - look.span;
    return this.last?.type === "said" && this.bottom < this.top ? Math.max(low, this.bottom) : low;
  }

  /** `truth`: the object of each bin instead of its level. */
  draw(look: Look, truth: boolean): void {
    const context = this.canvas.getContext("2d")!;
    this.stale = false;
    if (this.last === null) return;
    if (this.kind === "profile" || this.kind === "depth") {
      context.fillStyle = "#000";
      context.fillRect(0, 0, width, height);
    } else {
      context.putImageData(this.image(context, look, truth), 0, 0);
    }
    this.drawRanges(context);
    drawOverlay(context, this, look);
  }

  spotAt(x: number, y: number): Spot | null {
    const ping = this.last;
    x = Math.floor(x);
    y = Math.floor(y);
    if (ping === null || x < 0 || y < 0 || x >= width || y >= height) return null;
    switch (this.kind) {
      case "fan": {
        if (this.sketch?.key !== fanKey(ping)) this.sketch = fanSketch(ping);
        const index = this.sketch.index[y * width + x];
        return index < 0 ? null : { ping, beam: Math.floor(index / ping.bins), bin: index % ping.bins };
      }
      case "circle": {
        const scale = (height / 2 - 8) / farthest(ping);
        const right = x + 0.5 - width / 2;
        const ahead = height / 2 - y - 0.5;
        const line = this.lineAt(slotOf(Math.atan2(right, ahead)));
        const bin = Math.floor((Math.hypot(right, ahead) / scale - ping.first_range) / ping.bin_size);
        return line === undefined || bin < 0 || bin >= line.bins ? null : { ping: line, beam: 0, bin };
      }
      case "echogram":
        return this.echogramSpot(ping, x, y);
      case "sidescan": {
        const line = this.lines[this.lines.length - 1 - y];
        if (line === undefined) return null;
        const right = x >= width / 2;
        const along = line.beams === 1 ? x / width : right ? (x - width / 2) / (width / 2) : (width / 2 - 1 - x) / (width / 2);
        const bin = Math.floor((along * this.far - line.first_range) / line.bin_size);
        return bin < 0 || bin >= line.bins ? null : { ping: line, beam: right ? line.beams - 1 : 0, bin };
      }
      case "profile": {
        const [right, ahead] = placeIn(this.frame(ping), x, y);
        const beam = nearest(ping.bearings, Math.atan2(right, ahead) - ping.pan, 0.1);
        return beam < 0 || (ping.ranges![beam] ?? 0) === 0 ? null : { ping, beam, bin: -1 };
      }
      case "depth": {
        const line = this.lines[this.lines.length - width + x];
        return line === undefined ? null : { ping: line, beam: beamOfRange(line, (y / height) * this.far), bin: -1 };
      }
      default: {
        const column = Math.min(ping.beams - 1, Math.floor((x / width) * ping.beams));
        const row = Math.min(ping.rows - 1, Math.floor(((height - 1 - y) / height) * ping.rows));
        return loudestOf(ping, row * ping.beams + column);
      }
    }
  }

  /** m to the right and along of a dot; of pictures over time the range alone. */
  placeAt(x: number, y: number): [number, number] | null {
    const ping = this.last;
    if (ping === null) return null;
    const far = this.far;
    if (this.kind === "fan" || this.kind === "profile") return placeIn(this.frame(ping), x, y);
    if (this.kind === "circle") return [((x - width / 2) / (height / 2 - 8)) * far, ((height / 2 - y) / (height / 2 - 8)) * far];
    if (this.kind === "echogram") return [0, ping.first_range + (y / height) * (far - ping.first_range)];
    if (this.kind === "depth") return [0, (y / height) * far];
    if (this.kind === "sidescan") return [ping.beams === 1 ? (x / width) * far : ((x - width / 2) / (width / 2)) * far, 0];
    return null;
  }

  frame(ping: Ping): { centre: [number, number]; scale: number; down: boolean } {
    return frameOf(ping, this.far);
  }

  /** The loudest echo, not of the ring-down where that is known; the range of the middle beam where there are no levels. */
  loudest(): Spot | null {
    const ping = this.last;
    if (ping === null) return null;
    if (ping.bins === 0) return { ping, beam: Math.floor(ping.rows / 2) * ping.beams + Math.floor(ping.beams / 2), bin: -1 };
    const echo = (i: number): boolean => ping.seen === null || ping.seen[i] > 0;
    let best = 0;
    for (let i = 0; i < ping.levels.length; i++) if (echo(i) && (!echo(best) || ping.levels[i] > ping.levels[best])) best = i;
    return { ping, beam: Math.floor(best / ping.bins), bin: best % ping.bins };
  }

  private image(context: CanvasRenderingContext2D, look: Look, truth: boolean): ImageData {
    const image = context.createImageData(width, height);
    const low = this.low(look);
    for (let y = 0, at = 0; y < height; y++)
      for (let x = 0; x < width; x++, at += 4) {
        const spot = this.spotAt(x, y);
        image.data[at + 3] = 255;
        if (spot === null) continue;
        const { ping, beam, bin } = spot;
        if (truth && bin >= 0) {
          objectColour(ping.seen === null ? null : ping.seen[beam * ping.bins + bin], image.data, at);
          continue;
        }
        let share = 0;
        if (this.kind === "range image") share = 1 - rangeOf(spot) / this.far;
        else {
          const byte = ping.levels[beam * ping.bins + bin];
          if (byte > 0) share = ping.unit === "counts" ? byte / 255 : (levelOf(ping, byte) - low) / (this.top - low);
        }
        const c = 3 * Math.max(0, Math.min(255, Math.round(share * 255)));
        for (let i = 0; i < 3; i++) image.data[at + i] = look.palette[c + i];
      }
    return image;
  }

  /** Several beams stand side by side, one has its last line beside it. */
  private echogramSpot(ping: Ping, x: number, y: number): Spot | null {
    const bin = Math.floor((y / height) * ping.bins);
    if (ping.beams > 1) {
      const wide = Math.floor(width / ping.beams);
      const beam = Math.min(ping.beams - 1, Math.floor(x / wide));
      const line = this.lines[this.lines.length - wide + (x - beam * wide)];
      return line === undefined || x % wide === 0 ? null : { ping: line, beam, bin };
    }
    const shown = width - scopeWidth;
    if (x < shown) {
      const line = this.lines[this.lines.length - shown + x];
      return line === undefined ? null : { ping: line, beam: 0, bin };
    }
    const byte = ping.levels[bin];
    const level = ping.unit === "counts" ? byte / 255 : (levelOf(ping, byte) - this.top + 60) / 60;
    return x - shown > level * scopeWidth ? null : { ping, beam: 0, bin };
  }

  /** Told ranges, as dots; over time as lines. */
  private drawRanges(context: CanvasRenderingContext2D): void {
    const ping = this.last!;
    if (ping.ranges === null || ping.rows > 1) return;
    context.fillStyle = this.kind === "profile" || this.kind === "depth" ? "#ffd27f" : "#40ff80";
    const dot = (x: number, y: number): void => context.fillRect(x - 1, y - 1, 2.5, 2.5);
    if (this.kind === "fan" || this.kind === "profile")
      ping.ranges.forEach((range, beam) => range > 0 && dot(...dotIn(this.frame(ping), range, ping.bearings[beam] + ping.pan)));
    if (this.kind !== "depth" && this.kind !== "echogram") return;
    const shown = this.kind === "depth" || ping.beams > 1 ? width : width - scopeWidth;
    const own = context.fillStyle;
    this.lines.slice(-shown).forEach((line, i, all) => {
      line?.ranges?.forEach((range, beam) => {
        context.fillStyle = line.numbered ? beamColours[beam % beamColours.length] : own;
        if (range > 0) dot(shown - all.length + i, ((range - ping.first_range) / (this.far - ping.first_range)) * height);
      });
    });
  }

  /** The line of a direction, or the nearest within 2.5 deg: a head's steps may be as wide. */
  private lineAt(slot: number): Ping | undefined {
    for (let away = 0; away <= 5; away++)
      for (const at of [slot - away, slot + away]) {
        const line = this.lines[(at + slots) % slots];
        if (line !== undefined) return line;
      }
    return undefined;
  }
}

/** 0: none is told. */
export function rangeOf({ ping, beam, bin }: Spot): number {
  if (ping.rows > 1 && ping.bins === 1) return 0; // a strength alone
  return bin < 0 ? ping.ranges?.[beam] ?? 0 : ping.first_range + (bin + 0.5) * ping.bin_size;
}

/** The beam whose told range lies nearest. */
function beamOfRange(ping: Ping, range: number): number {
  let best = 0;
  const away = (beam: number): number => (ping.ranges![beam] > 0 ? Math.abs(ping.ranges![beam] - range) : Infinity);
  for (let beam = 1; beam < ping.beams; beam++) if (away(beam) < away(best)) best = beam;
  return best;
}

function slotOf(pan: number): number {
  const turn = pan / (2 * Math.PI);
  return Math.round((turn - Math.floor(turn)) * slots) % slots;
}

function loudestOf(ping: Ping, beam: number): Spot | null {
  if (ping.ranges !== null) return ping.ranges[beam] > 0 ? { ping, beam, bin: -1 } : null;
  let best = 0;
  for (let bin = 1; bin < ping.bins; bin++) if (ping.levels[beam * ping.bins + bin] > ping.levels[beam * ping.bins + best]) best = bin;
  const level = levelOf(ping, ping.levels[beam * ping.bins + best]);
  return Number.isNaN(level) || (ping.noise !== null && level < ping.noise + 13) ? null : { ping, beam, bin: best };
}

/** Where a ping's objects were not drawn: those of the one before in that direction, or the one next to it. */
function inheritObjects(ping: Ping, before: Ping | null | undefined): void {
  if (ping.type !== "ping" || ping.seen !== null || !before?.seen) return;
  if (before.seen.length !== ping.levels.length || farthest(before) !== farthest(ping)) return;
  ping.seen = before.seen;
  ping.seenOf = before.seenOf;
}

/** null: not told, dark grey. */
function objectColour(object: number | null, out: Uint8ClampedArray, at: number): void {
  if (object === null) out.fill(45, at, at + 3);
  if (!object) return;
  const hue = object * 2.399963; // golden angle: neighbours differ
  for (let i = 0; i < 3; i++) out[at + i] = 140 + 100 * Math.cos(hue + (i * 2 * Math.PI) / 3);
}
