// One sonar: its picture in dB, drawn as it comes, with range rings and what lies under the pointer.
import { levelOf, type Ping, type Said } from "./news";
import type { Palette } from "./palette";
import { fanKey, fanSketch, farthest, height, kindOf, width, type Kind, type Sketch } from "./sketch";

export interface Look {
  palette: Palette;
  span: number; // dB below the loudest that are shown
}

/** A level of the picture: the ping, the beam (all rows counted) and the bin. */
interface Spot {
  ping: Ping;
  beam: number;
  bin: number;
}

const slots = 720; // directions of a full circle
const scopeWidth = 70; // dots of an echogram's A-scan

export class Card {
  readonly element: HTMLElement;
  private readonly canvas: HTMLCanvasElement;
  private readonly facts: HTMLElement;
  private readonly read: HTMLElement;
  private readonly layer: HTMLSelectElement;
  private kind: Kind = "fan";
  private last: Ping | null = null;
  private lines: (Ping | undefined)[] = []; // circle: by direction; echogram, sidescan: by time
  private sketch: Sketch | null = null;
  private pans = new Set<number>();
  private top = -Infinity; // dB
  private pointer: [number, number] | null = null;
  private stale = false;
  private said = new Map<string, Said>(); // by name

  constructor(readonly device: string, title: string, places: string[], private readonly objects: () => string[]) {
    this.element = document.createElement("article");
    this.element.className = "card";
    this.element.dataset.device = device;
    const head = document.createElement("h2");
    head.append(device);
    const hint = document.createElement("span");
    hint.className = "hint";
    hint.textContent = title;
    this.layer = document.createElement("select");
    this.layer.setAttribute("aria-label", "layer of " + device);
    for (const [value, text] of [["heard", "heard: levels in the water"], ["said", "said: numbers on the wire"], ["true", "true: objects"]]) this.layer.add(new Option(text, value));
    this.layer.onchange = () => (this.stale = true);
    head.append(hint, this.layer);
    this.facts = document.createElement("p");
    this.facts.className = "facts";
    this.canvas = document.createElement("canvas");
    this.canvas.width = width;
    this.canvas.height = height;
    this.read = document.createElement("p");
    this.read.className = "read";
    this.read.append("no ping yet: a driver has to ask for one, or to be connected", ...places.flatMap((place) => [document.createElement("br"), place]));
    this.canvas.onpointermove = (event) => {
      const box = this.canvas.getBoundingClientRect();
      this.pointer = [((event.clientX - box.left) / box.width) * width, ((event.clientY - box.top) / box.height) * height];
      this.tellPointer();
    };
    this.canvas.onpointerleave = () => {
      this.pointer = null;
      this.tellLoudest();
    };
    this.element.append(head, this.facts, this.canvas, this.read);
  }

  take(ping: Ping): void {
    this.pans.add(Math.round(ping.pan * 1000));
    const kind = kindOf(ping, this.pans.size > 1);
    const other = this.last === null || kind !== this.kind || ping.bins !== this.last.bins || farthest(ping) !== farthest(this.last);
    if (other) {
      this.lines = [];
      this.top = -Infinity;
      this.kind = kind;
    }
    this.last = ping;
    let loudest = 0;
    for (const byte of ping.levels) if (byte > loudest) loudest = byte;
    this.top = Math.max(this.top - 0.2, levelOf(ping, loudest) || -Infinity); // sinks slowly
    if (kind === "circle") this.lines[slotOf(ping.pan)] = ping;
    if (kind === "echogram" || kind === "sidescan") {
      this.lines.push(ping);
      if (this.lines.length > width) this.lines.shift();
    }
    this.stale = true;
  }

  hear(said: Said): void {
    this.said.set(said.name, said);
    this.stale = true;
  }

  /** Draws what has come since the last call. */
  draw(look: Look, force: boolean): void {
    if (!this.stale && !force) return;
    this.stale = false;
    const context = this.canvas.getContext("2d")!;
    if (this.layer.value === "said") return this.drawSaid(context, look);
    if (this.last === null) return;
    const image = context.createImageData(width, height);
    const truth = this.layer.value === "true";
    const colour = this.colours(look);
    for (let y = 0, at = 0; y < height; y++)
      for (let x = 0; x < width; x++, at += 4) {
        const spot = this.spotAt(x, y);
        image.data[at + 3] = 255;
        if (spot === null) continue;
        if (this.kind === "range image") rangeColour(spot, look, image.data, at);
        else if (truth) objectColour(spot, image.data, at);
        else {
          const byte = spot.ping.levels[spot.beam * spot.ping.bins + spot.bin];
          const c = 3 * colour(spot.ping, byte);
          image.data[at] = look.palette[c];
          image.data[at + 1] = look.palette[c + 1];
          image.data[at + 2] = look.palette[c + 2];
        }
      }
    context.putImageData(image, 0, 0);
    this.drawRings(context, look);
    this.tellFacts(look);
    if (this.pointer) this.tellPointer();
    else this.tellLoudest();
  }

  /** The longest row of numbers that it has said last, as bars. */
  private drawSaid(context: CanvasRenderingContext2D, look: Look): void {
    const said = this.longest();
    context.fillStyle = "#000";
    context.fillRect(0, 0, width, height);
    if (said === null) return void this.read.replaceChildren("it has said no row of numbers yet");
    const high = Math.max(...said.numbers);
    const low = Math.min(0, ...said.numbers);
    const span = high > low ? high - low : 1;
    const c = 3 * 190;
    context.fillStyle = `rgb(${look.palette[c]},${look.palette[c + 1]},${look.palette[c + 2]})`;
    const wide = width / said.numbers.length;
    said.numbers.forEach((value, i) => {
      const tall = ((value - low) / span) * (height - 30);
      context.fillRect(i * wide, height - tall, Math.max(1, wide), tall);
    });
    context.fillStyle = "rgba(200, 220, 230, 0.9)";
    context.font = "11px sans-serif";
    context.fillText(`${said.name}: ${said.numbers.length} numbers, ${plain(low)} to ${plain(high)} ${said.unit}`, 6, 16);
    this.tellSaid(said);
  }

  private longest(): Said | null {
    let best: Said | null = null;
    for (const said of this.said.values()) if (best === null || said.numbers.length > best.numbers.length) best = said;
    return best;
  }

  private tellSaid(said: Said): void {
    const most = said.numbers.indexOf(Math.max(...said.numbers));
    const at = this.pointer === null ? most : Math.min(said.numbers.length - 1, Math.floor((this.pointer[0] / width) * said.numbers.length));
    this.read.replaceChildren(this.pointer === null ? "largest: " : "", `${said.name}[${at}] = `, bold(plain(said.numbers[at]) + (said.unit ? " " + said.unit : "")));
  }

  private colours(look: Look): (ping: Ping, byte: number) => number {
    const low = this.top - look.span;
    return (ping, byte) => (byte === 0 ? 0 : Math.max(0, Math.min(255, Math.round(((levelOf(ping, byte) - low) / look.span) * 255))));
  }

  private spotAt(x: number, y: number): Spot | null {
    const ping = this.last!;
    x = Math.floor(x);
    y = Math.floor(y);
    if (x < 0 || y < 0 || x >= width || y >= height) return null;
    if (this.kind === "fan") {
      if (this.sketch?.key !== fanKey(ping)) this.sketch = fanSketch(ping);
      const index = this.sketch.index[y * width + x];
      return index < 0 ? null : { ping, beam: Math.floor(index / ping.bins), bin: index % ping.bins };
    }
    if (this.kind === "circle") {
      const scale = (height / 2 - 8) / farthest(ping);
      const right = x + 0.5 - width / 2;
      const ahead = height / 2 - y - 0.5;
      const line = this.lineAt(slotOf(Math.atan2(right, ahead)));
      const bin = Math.floor((Math.hypot(right, ahead) / scale - ping.first_range) / ping.bin_size);
      return line === undefined || bin < 0 || bin >= line.bins ? null : { ping: line, beam: 0, bin };
    }
    if (this.kind === "echogram") {
      const shown = width - scopeWidth;
      const bin = Math.floor((y / height) * ping.bins);
      if (x < shown) {
        const line = this.lines[this.lines.length - shown + x];
        return line === undefined ? null : { ping: line, beam: 0, bin };
      }
      const level = (levelOf(ping, ping.levels[bin]) - this.top + 60) / 60;
      return x - shown > level * scopeWidth ? null : { ping, beam: 0, bin };
    }
    if (this.kind === "sidescan") {
      const line = this.lines[this.lines.length - 1 - y];
      if (line === undefined) return null;
      const right = x >= width / 2;
      const along = right ? (x - width / 2) / (width / 2) : (width / 2 - 1 - x) / (width / 2);
      return { ping: line, beam: right ? line.beams - 1 : 0, bin: Math.min(line.bins - 1, Math.floor(along * line.bins)) };
    }
    const column = Math.min(ping.beams - 1, Math.floor((x / width) * ping.beams));
    const row = Math.min(ping.rows - 1, Math.floor(((height - 1 - y) / height) * ping.rows));
    return loudestOf(ping, row * ping.beams + column);
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

  private drawRings(context: CanvasRenderingContext2D, look: Look): void {
    const ping = this.last!;
    const far = farthest(ping);
    const step = ringStep(far);
    context.strokeStyle = "rgba(160, 190, 200, 0.35)";
    context.fillStyle = "rgba(200, 220, 230, 0.9)";
    context.font = "11px sans-serif";
    for (let range = step; range <= far * 1.001; range += step) {
      const text = plain(range) + " m";
      context.beginPath();
      if (this.kind === "fan" && this.sketch) {
        const [cx, cy] = this.sketch.centre;
        context.arc(cx, cy, this.sketch.metres(range), -Math.PI, ping.bearings[ping.beams - 1] > Math.PI / 2 ? Math.PI : 0);
        context.fillText(text, cx + 3, cy - this.sketch.metres(range) + 12);
      } else if (this.kind === "circle") {
        const radius = (range / far) * (height / 2 - 8);
        context.arc(width / 2, height / 2, radius, 0, 2 * Math.PI);
        context.fillText(text, width / 2 + 3, height / 2 - radius + 12);
      } else if (this.kind === "echogram") {
        const y = ((range - ping.first_range) / (far - ping.first_range)) * height;
        context.moveTo(0, y);
        context.lineTo(width, y);
        context.fillText(text, 3, y - 3);
      } else if (this.kind === "sidescan") {
        for (const side of [-1, 1]) {
          const x = width / 2 + (side * width * range) / (2 * far);
          context.moveTo(x, 0);
          context.lineTo(x, height);
          context.fillText(text, x + 3, height - 5);
        }
      }
      context.stroke();
    }
    const high = this.kind === "range image" ? plain(far) + " m" : this.top.toFixed(0) + " dB";
    const low = this.kind === "range image" ? "0 m" : (this.top - look.span).toFixed(0) + " dB";
    for (let i = 0; i < 100; i++) {
      const c = 3 * Math.round((i / 99) * 255);
      context.fillStyle = `rgb(${look.palette[c]},${look.palette[c + 1]},${look.palette[c + 2]})`;
      context.fillRect(width - 16, 110 - i, 8, 1);
    }
    context.fillStyle = "rgba(200, 220, 230, 0.9)";
    context.textAlign = "right";
    context.fillText(high, width - 20, 18);
    context.fillText(low, width - 20, 112);
    context.textAlign = "left";
  }

  private tellFacts(look: Look): void {
    const ping = this.last!;
    const beams = ping.rows > 1 ? `${ping.rows} x ${ping.beams} beams` : ping.beams > 1 ? `${ping.beams} beams` : "1 beam";
    const late = ping.late > 0.001 ? `, ${(ping.late * 1000).toFixed(0)} ms late` : "";
    this.facts.textContent =
      `${this.kind} · ping ${ping.number} at ${ping.t.toFixed(2)} s${late} · ${beams}, ${plain(ping.first_range)} to ` +
      `${plain(farthest(ping))} m · ${(ping.frequency / 1000).toFixed(0)} kHz, ${(ping.pulse_length * 1e6).toFixed(0)} us · ${look.span} dB shown`;
  }

  private tellPointer(): void {
    const said = this.layer.value === "said" ? this.longest() : null;
    if (said !== null) return this.tellSaid(said);
    if (this.pointer === null || this.last === null) return;
    const spot = this.spotAt(...this.pointer);
    if (spot !== null) this.tellSpot("", spot);
  }

  private tellLoudest(): void {
    const ping = this.last;
    if (ping === null || this.layer.value === "said") return;
    const echo = (i: number): boolean => ping.seen === null || ping.seen[i] > 0; // not the ring-down
    let best = 0;
    for (let i = 0; i < ping.levels.length; i++)
      if (echo(i) && (!echo(best) || ping.levels[i] > ping.levels[best])) best = i;
    this.tellSpot("loudest echo: ", { ping, beam: Math.floor(best / ping.bins), bin: best % ping.bins });
  }

  private tellSpot(before: string, { ping, beam, bin }: Spot): void {
    const at = beam * ping.bins + bin;
    const range = ping.first_range + (bin + 0.5) * ping.bin_size;
    const bearing = ((ping.pan + ping.bearings[beam % ping.beams]) * 180) / Math.PI;
    const elevation = ping.rows > 1 ? `, ${((ping.elevations[Math.floor(beam / ping.beams)] * 180) / Math.PI).toFixed(1)} deg up` : "";
    const level = levelOf(ping, ping.levels[at]);
    const object = ping.seen && ping.seen[at] > 0 ? this.objects()[ping.seen[at] - 1] ?? "" : "";
    this.read.replaceChildren(before, bold(range.toFixed(2) + " m"), ` at ${bearing.toFixed(1)} deg${elevation}, `,
      bold(Number.isNaN(level) ? "silence" : level.toFixed(1) + " " + ping.unit), object ? ", " : "", object ? bold(object) : "");
  }
}

function slotOf(pan: number): number {
  const turn = pan / (2 * Math.PI);
  return Math.round((turn - Math.floor(turn)) * slots) % slots;
}

function loudestOf(ping: Ping, beam: number): Spot | null {
  let best = 0;
  for (let bin = 1; bin < ping.bins; bin++) if (ping.levels[beam * ping.bins + bin] > ping.levels[beam * ping.bins + best]) best = bin;
  const level = levelOf(ping, ping.levels[beam * ping.bins + best]);
  return Number.isNaN(level) || (ping.noise !== null && level < ping.noise + 13) ? null : { ping, beam, bin: best };
}

function rangeColour(spot: Spot, look: Look, out: Uint8ClampedArray, at: number): void {
  const c = 3 * Math.round((1 - spot.bin / spot.ping.bins) * 255);
  for (let i = 0; i < 3; i++) out[at + i] = look.palette[c + i];
}

function objectColour(spot: Spot, out: Uint8ClampedArray, at: number): void {
  const object = spot.ping.seen ? spot.ping.seen[spot.beam * spot.ping.bins + spot.bin] : 0;
  if (object === 0) return;
  const hue = object * 2.399963; // golden angle: neighbours differ
  for (let i = 0; i < 3; i++) out[at + i] = 140 + 100 * Math.cos(hue + (i * 2 * Math.PI) / 3);
}

function ringStep(far: number): number {
  const rough = far / 4;
  const ten = 10 ** Math.floor(Math.log10(rough));
  return ten * (rough / ten >= 5 ? 5 : rough / ten >= 2 ? 2 : 1);
}

function plain(value: number): string {
  return String(Math.round(value * 100) / 100);
}

function bold(text: string): HTMLElement {
  const element = document.createElement("b");
  element.textContent = text;
  return element;
}
