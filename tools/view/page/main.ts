// The page of a run: takes the news and hands them to its parts.
import { Card, type Look } from "./card";
import { Devices } from "./devices";
import { Faults } from "./faults";
import { headOf, pingOf, type Hello, type News, type SceneNews } from "./news";
import { paletteOf } from "./palette";
import { SceneView } from "./scene";
import { Wire } from "./wire";

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const token = location.hash.slice(1);
const cards = new Map<string, Card>();
const known = new Map<string, Hello["devices"][number]>();
const scene = new SceneView(element<HTMLCanvasElement>("scene"), element<HTMLSelectElement>("camera"));
const wire = new Wire(element("wire"), element<HTMLInputElement>("filter"), element<HTMLButtonElement>("pause-wire"));
const devices = new Devices(element<HTMLTableElement>("devices"));
const faults = new Faults((line) => ask(line));
const look: Look = { palette: paletteOf("copper"), span: 60 };
let objects: string[] = [];
let socket: WebSocket | null = null;
let paused = false;
let redraw = false;

function state(text: string, live: boolean): void {
  element("state").textContent = text;
  element("state").classList.toggle("live", live);
}

function cardOf(device: string): Card {
  let card = cards.get(device);
  if (card === undefined) {
    card = new Card(device, known.get(device)?.title ?? "", known.get(device)?.places ?? [], () => objects);
    cards.set(device, card);
    element("cards").append(card.element);
  }
  return card;
}

function ask(line: object): void {
  socket?.send(JSON.stringify({ ask: line, id: Date.now() }));
}

function hello(news: Hello): void {
  element("what").textContent = `${news.scenario} · ${news.version}`;
  document.title = `echoloop · ${news.scenario}`;
  for (const device of news.devices) {
    known.set(device.name, device);
    cardOf(device.name);
  }
  faults.offer(news);
  void loadScene();
}

async function loadScene(): Promise<void> {
  const answer = await fetch("scene", { headers: { Authorization: "Bearer " + token } });
  if (!answer.ok) return;
  const buffer = await answer.arrayBuffer();
  const { head, rest } = headOf<SceneNews>(buffer);
  objects = head.objects;
  scene.load(head, new Float32Array(buffer.slice(rest)));
}

function take(news: News): void {
  switch (news.type) {
    case "hello":
      return hello(news);
    case "ping":
      scene.take(news);
      if (!paused) cardOf(news.device).take(news);
      return;
    case "messages":
      if (!paused) for (const said of news.said) cardOf(said.device).hear(said);
      return wire.take(news.messages);
    case "status":
      return devices.take(news.status);
    case "answer":
      return faults.answer(news.answer);
  }
}

function connect(): void {
  if (token === "") return state("open the link that the run printed: its end is a token", false);
  const here = new WebSocket(`ws://${location.host}/news`, ["echoloop.view", token]);
  here.binaryType = "arraybuffer";
  socket = here;
  here.onopen = () => state("live", true);
  here.onmessage = ({ data }) => take(typeof data === "string" ? (JSON.parse(data) as News) : pingOf(data as ArrayBuffer));
  here.onclose = () => {
    state("the run has ended, or was begun anew: open the link that it prints", false);
    window.setTimeout(connect, 1000);
  };
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
element<HTMLButtonElement>("pause").onclick = ({ target }) => {
  paused = !paused;
  (target as HTMLButtonElement).textContent = paused ? "Go on" : "Pause";
};
connect();
frame();
