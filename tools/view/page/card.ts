// One sonar: what it has heard and what it has said, in layers, with what lies under the pointer.
import { Kinds } from "./kinds";
import { levelOf, type Ping, type Said } from "./news";
import { rulerText, type Look } from "./overlay";
import { rangeOf, type Picture, type Spot } from "./picture";
import { saveCard } from "./snapshot";
import { farthest, height, plain, width } from "./sketch";

export interface CardOf {
  device: string;
  title: string;
  places: string[];
  waterfall: boolean; // a side-scan of one beam
  captured: boolean; // nothing is heard
  sonar: boolean; // else it sends no pings
  objects: () => string[];
}

function firstWords(of: CardOf): string {
  if (of.captured) return "no picture yet";
  return of.sonar ? "no ping yet: a driver has to ask for one, or to be connected" : "no sonar: what it says is on the wire";
}

export class Card {
  readonly element = document.createElement("article");
  private readonly heard: Kinds;
  private readonly said: Kinds;
  private readonly facts = document.createElement("p");
  private readonly read = document.createElement("p");
  private readonly layer = document.createElement("select");
  private readonly numbers = new Map<string, Said>(); // rows of numbers, by name

  constructor(private readonly of: CardOf) {
    this.heard = new Kinds(of.waterfall, true, (picture) => this.listen(picture));
    this.said = new Kinds(of.waterfall, false, (picture) => this.listen(picture));
    this.element.className = "card";
    this.element.dataset.device = of.device;
    const head = document.createElement("h2");
    const hint = document.createElement("span");
    hint.className = "hint";
    hint.textContent = of.title;
    const save = document.createElement("button");
    save.type = "button";
    save.textContent = "PNG";
    save.title = "save this picture";
    save.onclick = () => saveCard(of.device, this.facts.textContent ?? "", this.pictures().map((one) => one.canvas));
    this.layer.setAttribute("aria-label", "layer of " + of.device);
    this.layer.onchange = () => {
      const [layer, name] = this.chosen();
      (layer === "said" ? this.said : this.heard).choose(name);
      this.showLayer();
    };
    this.offerLayers();
    head.append(of.device, hint, this.layer, save);
    this.facts.className = "facts";
    const canvases = document.createElement("div");
    canvases.className = "canvases";
    canvases.append(this.heard.element, this.said.element);
    this.read.className = "read";
    this.read.append(firstWords(of), ...of.places.flatMap((place) => [document.createElement("br"), place]));
    this.element.append(head, this.facts, canvases, this.read);
    this.showLayer();
  }

  reset(): void {
    this.heard.reset();
    this.said.reset();
    this.numbers.clear();
  }

  /** True: it belongs to the picture that is shown of what was heard, or said. */
  take(ping: Ping): boolean {
    const kinds = ping.type === "ping" ? this.heard : this.said;
    if (ping.type === "said" && this.heard.current.last !== null) ping.down = this.heard.current.last.down; // as the other picture lies
    if (kinds.take(ping)) this.offerLayers();
    return kinds.current.last === ping;
  }

  hear(said: Said): void {
    this.numbers.set(said.name, said);
    if (this.saysNumbers()) this.said.current.stale = true;
  }

  /** Draws what has come since the last call. */
  draw(look: Look, force: boolean): void {
    let drawn = false;
    for (const picture of this.pictures()) {
      if (!picture.stale && !force) continue;
      drawn = true;
      if (picture === this.said.current && this.saysNumbers()) this.drawNumbers(look);
      else picture.draw(look, this.chosen()[0] === "true");
    }
    if (!drawn) return;
    this.tellFacts(look);
    this.tell();
  }

  /** What it shows: pictures, and which object each bin hears. */
  layers(): { heard: boolean; said: boolean; truth: boolean } {
    const shown = this.pictures();
    const heard = shown.includes(this.heard.current);
    return { heard, said: shown.includes(this.said.current), truth: this.chosen()[0] === "true" || (heard && this.heard.current.pointer !== null) };
  }

  /** No picture of what it says is known. */
  private saysNumbers(): boolean {
    return this.said.names().length === 0;
  }

  /** The layer, and which of its pictures. */
  private chosen(): [string, string] {
    const [layer, ...name] = this.layer.value.split(" ");
    return [layer, name.join(" ")];
  }

  private pictures(): Picture[] {
    const layer = this.chosen()[0];
    if (layer === "both") return [this.heard.current, this.said.current];
    return [layer === "said" ? this.said.current : this.heard.current];
  }

  /** A layer for each picture that there is, and "heard", "said", "true" where there is one at most. */
  private offerLayers(): void {
    const of = (layer: string, kinds: Kinds, text: string): [string, string][] => {
      const names = kinds.names();
      return names.length > 1 ? names.map((name) => [`${layer} ${name}`, `${layer}: ${name}`]) : [[layer, `${layer}: ${text}`]];
    };
    const said = of("said", this.said, "on the wire");
    const heard = [...of("heard", this.heard, "levels in the water"), ...said, ...of("true", this.heard, "objects"), ["both", "heard beside said"]];
    const layer = this.chosen()[0];
    this.layer.replaceChildren(...(this.of.captured ? said : heard).map(([value, text]) => new Option(text, value)));
    if (layer === "both") this.layer.value = layer;
    else if (layer !== "") {
      const kinds = layer === "said" ? this.said : this.heard;
      this.layer.value = kinds.names().length > 1 ? `${layer} ${kinds.shown}` : layer;
    }
    this.showLayer();
  }

  private showLayer(): void {
    const shown = this.pictures();
    for (const kinds of [this.heard, this.said]) {
      kinds.element.hidden = !shown.includes(kinds.current);
      kinds.current.stale = true;
    }
    this.element.classList.toggle("double", shown.length > 1);
  }

  private listen(picture: Picture): void {
    const place = (event: PointerEvent): [number, number] => {
      const box = picture.canvas.getBoundingClientRect();
      return [((event.clientX - box.left) / box.width) * width, ((event.clientY - box.top) / box.height) * height];
    };
    picture.canvas.title = "drag to measure";
    picture.canvas.onpointerdown = (event) => {
      picture.canvas.setPointerCapture(event.pointerId);
      picture.ruler = place(event);
    };
    picture.canvas.onpointermove = (event) => {
      picture.pointer = place(event);
      if (event.buttons === 0) picture.ruler = null;
      else picture.stale = true;
      this.tell();
    };
    picture.canvas.onpointerleave = () => {
      picture.pointer = picture.ruler = null;
      picture.stale = true;
    };
  }

  /** The longest row of numbers that it has said last, as bars, where no picture of it is known. */
  private drawNumbers(look: Look): void {
    const context = this.said.current.canvas.getContext("2d")!;
    this.said.current.stale = false;
    const said = this.longest();
    context.fillStyle = "#000";
    context.fillRect(0, 0, width, height);
    if (said === null) return;
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
  }

  private longest(): Said | null {
    let best: Said | null = null;
    for (const said of this.numbers.values()) if (best === null || said.numbers.length > best.numbers.length) best = said;
    return best;
  }

  private tellFacts(look: Look): void {
    const picture = this.pictures()[0];
    const ping = picture.last;
    if (ping === null) return;
    const beams = ping.rows > 1 ? `${ping.rows} x ${ping.beams} beams` : ping.beams > 1 ? `${ping.beams} beams` : "1 beam";
    const range = `${plain(ping.first_range)} to ${plain(farthest(ping))} m`;
    if (ping.type === "said") {
      const levels = ping.bins === 0 ? "ranges" : ping.unit === "counts" ? "counts of 8 bits" : `${ping.unit}, ${look.span} dB shown`;
      const time = new Date(ping.t * 1000).toISOString().slice(11, 23);
      this.facts.textContent = `${picture.kind} · ${ping.name} ${ping.number} at ${time} · ${beams}, ${range}${ping.assumed ? " at 1500 m/s" : ""} · ${levels}`;
      return;
    }
    const late = ping.late > 0.001 ? `, ${(ping.late * 1000).toFixed(0)} ms late` : "";
    const objects = this.chosen()[0] !== "true" || ping.seenOf === ping.number ? "" : ping.seen === null ? " · its objects were not drawn" : ` · objects of ping ${ping.seenOf}`;
    this.facts.textContent =
      `${picture.kind} · ping ${ping.number} at ${ping.t.toFixed(2)} s${late} · ${beams}, ${range} · ` +
      `${(ping.frequency / 1000).toFixed(0)} kHz, ${(ping.pulse_length * 1e6).toFixed(0)} us · ${look.span} dB shown${objects}`;
  }

  /** What is under the pointer, or the loudest. */
  private tell(): void {
    const shown = this.pictures();
    const pointed = shown.find((picture) => picture.pointer !== null);
    const picture = pointed ?? shown[0];
    if (picture === this.said.current && this.saysNumbers()) return this.tellNumber(picture);
    if (picture.last === null) return;
    if (!pointed && picture.last.numbered && picture.last.ranges !== null) return this.tellBeams(picture.last);
    const spot = pointed ? picture.spotAt(...pointed.pointer!) : picture.loudest();
    if (spot !== null) this.tellSpot(pointed ? "" : spot.bin < 0 ? "in the middle: " : "loudest echo: ", spot, rulerText(picture));
    else if (pointed) this.read.replaceChildren("nothing there", rulerText(picture) ? " · ruler " + rulerText(picture) : "");
  }

  private tellNumber(picture: Picture): void {
    const said = this.longest();
    if (said === null) return this.read.replaceChildren("it has said no row of numbers yet");
    const most = said.numbers.indexOf(Math.max(...said.numbers));
    const at = picture.pointer === null ? most : Math.min(said.numbers.length - 1, Math.floor((picture.pointer[0] / width) * said.numbers.length));
    this.read.replaceChildren(picture.pointer === null ? "largest: " : "", `${said.name}[${at}] = `, bold(plain(said.numbers[at]) + (said.unit ? " " + said.unit : "")));
  }

  /** The ranges of a Doppler log's beams. */
  private tellBeams(ping: Ping): void {
    const ranges = [...(ping.ranges ?? [])].map((range) => (range > 0 ? range.toFixed(2) + " m" : "none"));
    this.read.replaceChildren("beams: ", bold(ranges.join(", ")));
  }

  private tellSpot(before: string, spot: Spot, ruler: string): void {
    const { ping, beam, bin } = spot;
    const at = beam * ping.bins + bin;
    const bearing = ((ping.pan + ping.bearings[beam % ping.beams]) * 180) / Math.PI;
    const elevation = ping.rows > 1 ? `, ${((ping.elevations[Math.floor(beam / ping.beams)] * 180) / Math.PI).toFixed(1)} deg up` : "";
    const range = rangeOf(spot);
    const parts: (string | HTMLElement)[] = [before, bold(range > 0 ? range.toFixed(2) + " m" : "no range")];
    if (ping.numbered) parts.push(`, beam ${beam + 1}`);
    else if (!ping.sides && !ping.waterfall) parts.push(` at ${bearing.toFixed(1)} deg${elevation}`);
    else if (ping.beams > 1) parts.push(ping.beams === 2 ? (beam === 0 ? ", port" : ", starboard") : `, beam ${beam + 1}`);
    if (bin >= 0) {
      const level = levelOf(ping, ping.levels[at]);
      parts.push(", ", bold(Number.isNaN(level) ? (ping.unit === "counts" ? "0 counts" : "silence") : level.toFixed(ping.unit === "counts" ? 0 : 1) + " " + ping.unit));
      const object = ping.seen && ping.seen[at] > 0 ? this.of.objects()[ping.seen[at] - 1] ?? "" : "";
      if (object) parts.push(", ", bold(object));
    }
    if (ruler) parts.push(" · ruler ", bold(ruler));
    this.read.replaceChildren(...parts);
  }
}

function bold(text: string): HTMLElement {
  const element = document.createElement("b");
  element.textContent = text;
  return element;
}
