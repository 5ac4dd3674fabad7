// The page of a run: takes the news and hands them to its parts.
import { Card } from "./card";
import { Devices } from "./devices";
import { Faults } from "./faults";
import { History } from "./history";
import { Screen } from "./looks";
import { headOf, pingOf, type Answer, type Hello, type News, type Ping, type SceneNews } from "./news";
import type { Look } from "./overlay";
import { paletteOf } from "./palette";
import { SceneView } from "./scene";
import { Settings } from "./settings";
import { saveCanvas } from "./snapshot";
import { Wire } from "./wire";

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const token = location.hash.slice(1);
const cards = new Map<string, Card>();
const scene = new SceneView(element<HTMLCanvasElement>("scene"), element<HTMLSelectElement>("camera"));
const wire = new Wire(element("wire"), element<HTMLInputElement>("filter"), element<HTMLButtonElement>("pause-wire"));
const devices = new Devices(element<HTMLTableElement>("devices"), element<HTMLTableElement>("lines"), element("rendering"));
const settings = new Settings(element<HTMLTableElement>("settings"));
const history = new History();
const faults = new Faults((line) => ask(line));
const screen = new Screen(element("scene-panel"));
const look: Look = { palette: paletteOf("copper"), span: 60 };
const time = element<HTMLInputElement>("time");
let about: Hello | null = null;
let objects: string[] = [];
let socket: WebSocket | null = null;
let paused = false;
let recording = "";
let redraw = false;

function state(text: string, live: boolean): void {
  element("state").textContent = text;
  element("state").classList.toggle("live", live);
}

function cardOf(device: string): Card {
  let card = cards.get(device);
  if (card === undefined) {
    const known = about?.devices.find(({ name }) => name === device);
    card = new Card({
      device,
      title: known?.title ?? "",
      places: known?.places ?? [],
      waterfall: known?.model === "omniscan450",
      captured: about?.captured ?? false,
      sonar: known?.sonar ?? true,
      objects: () => objects,
    });
    cards.set(device, card);
    element("cards").append(card.element);
  }
  return card;
}

function ask(line: object): void {
  socket?.send(JSON.stringify({ ask: line, id: Date.now() }));
}

/** A run begins for this page, perhaps another than before. */
function hello(news: Hello): void {
  about = news;
  element("what").textContent = `${news.scenario} · ${news.version}`;
  document.title = `echoloop · ${news.scenario}`;
  for (const card of cards.values()) card.element.remove();
  cards.clear();
  history.clear();
  wire.reset();
  settings.reset();
  scene.reset();
  setRecording("");
  if (!news.captured) for (const device of news.devices) cardOf(device.name);
  element("scene-panel").hidden = element("device-table").hidden = news.captured;
  element("record").hidden = !news.record;
  faults.offer(news);
  if (!news.captured) void loadScene();
}

async function loadScene(): Promise<void> {
  const answer = await fetch("scene", { headers: { Authorization: "Bearer " + token } });
  if (!answer.ok) return;
  const buffer = await answer.arrayBuffer();
  const { head, rest } = headOf<SceneNews>(buffer);
  objects = head.objects;
  scene.load(head, new Float32Array(buffer.slice(rest)));
}

/** What can be seen again, now or later. */
function show(news: News | Ping): void {
  if (news.type === "ping" || news.type === "said") {
    const shown = cardOf(news.device).take(news);
    if (news.type === "ping" && shown) scene.take(news); // with the objects that the card knows
  } else if (news.type === "messages") {
    for (const said of news.said) if (about !== null && !about.captured) cardOf(said.device).hear(said);
    wire.take(news.messages, news.left_out);
  }
}

function take(news: News | Ping, size: number): void {
  switch (news.type) {
    case "hello":
      return hello(news);
    case "status":
      if (about?.control) ask({ list: true });
      if (news.status.recording !== undefined && news.status.recording !== recording) setRecording(news.status.recording);
      return devices.take(news.status);
    case "lines":
      return devices.takeLines(news);
    case "answer":
      return answered(news.answer);
    case "messages":
      settings.take(news.set);
      break;
    default:
      devices.ping(news);
  }
  if (paused) return;
  history.add(performance.now(), size, news);
  show(news);
}

function answered(answer: Answer): void {
  if (answer.recording !== undefined) return setRecording(answer.recording);
  if (answer.recorded !== undefined) {
    setRecording("");
    element("recorded").textContent = `${answer.packets} packets in ${answer.recorded}`;
    return;
  }
  faults.answer(answer);
}

function setRecording(file: string): void {
  recording = file;
  element("record").textContent = file === "" ? "Record" : "End recording";
  element("recorded").textContent = file === "" ? "" : "recording " + file;
}

/** All that was there at a time of the last minute. */
function showAt(at: number): void {
  for (const card of cards.values()) card.reset();
  wire.reset();
  scene.reset();
  for (const news of history.until(at)) show(news);
  const [, newest] = history.ends();
  element("time-value").textContent = at >= newest ? "now" : `${((at - newest) / 1000).toFixed(1)} s`;
  redraw = true;
}

function pause(on: boolean): void {
  paused = on;
  element("pause").textContent = on ? "Go on" : "Pause";
  element("scrub").hidden = !on;
  const [oldest, newest] = history.ends();
  [time.min, time.max] = [String(oldest), String(newest)];
  time.value = String(newest);
  showAt(newest);
}

function connect(): void {
  if (token === "") return state("open the link that the run printed: its end is a token", false);
  const here = new WebSocket(`ws://${location.host}/news`, ["echoloop.view", token]);
  let opened = false;
  here.binaryType = "arraybuffer";
  socket = here;
  here.onopen = () => {
    opened = true;
    screen.forget();
    state("live", true);
  };
  here.onmessage = ({ data }) =>
    typeof data === "string" ? take(JSON.parse(data) as News, data.length) : take(pingOf(data as ArrayBuffer), (data as ArrayBuffer).byteLength);
  here.onclose = () => {
    void tellWhy(opened);
    window.setTimeout(connect, 1000);
  };
}

/** Whether nobody is there, or a run that this page's token is not of. */
async function tellWhy(opened: boolean): Promise<void> {
  const gone = "the run has ended; the page goes on with the next one at this address, if it was begun with the same --view-at";
  if (opened) return state(gone, false);
  try {
    const answer = await fetch("scene", { headers: { Authorization: "Bearer " + token } });
    if (answer.status === 401) state("another run is here, and this link is not for it: open the link that it has printed", false);
  } catch {
    state(gone, false);
  }
}

function frame(): void {
  for (const card of cards.values()) card.draw(look, redraw);
  redraw = false;
  scene.draw();
  window.requestAnimationFrame(frame);
}

element<HTMLSelectElement>("palette").onchange = ({ target }) => {
  look.palette = paletteOf((target as HTMLSelectElement).value);
  redraw = true;
};
element<HTMLInputElement>("span").oninput = ({ target }) => {
  look.span = Number((target as HTMLInputElement).value);
  element("span-value").textContent = look.span + " dB";
  redraw = true;
};
element("pause").onclick = () => pause(!paused);
time.oninput = () => showAt(Number(time.value));
element("record").onclick = () => ask({ record: recording === "" });
element("save-scene").onclick = () => {
  scene.draw(true);
  saveCanvas("scene", element<HTMLCanvasElement>("scene"));
};
function tellLooks(): void {
  if (socket === null || socket.readyState !== WebSocket.OPEN) return;
  const looks = screen.changed(cards);
  if (looks !== null) socket.send(JSON.stringify({ looks }));
}

window.setInterval(tellLooks, 250);
connect();
frame();
