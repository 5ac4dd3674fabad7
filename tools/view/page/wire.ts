// The messages on the wires, the latest first: a line each, its fields when it is opened.
import type { Message } from "./news";

const most = 300;

export class Wire {
  private paused = false;
  private filter = "";
  private kept: Message[] = [];

  constructor(private readonly list: HTMLElement, filter: HTMLInputElement, pause: HTMLButtonElement) {
    filter.oninput = () => {
      this.filter = filter.value.toLowerCase();
      this.list.replaceChildren(...this.kept.filter((one) => this.passes(one)).map(row));
    };
    pause.onclick = () => {
      this.paused = !this.paused;
      pause.textContent = this.paused ? "Go on" : "Pause";
    };
  }

  /** `leftOut`: bytes that were not read, since there were too many. */
  take(messages: Message[], leftOut: number): void {
    if (this.paused) return;
    if (leftOut > 0) this.list.prepend(remark(`${(leftOut / 1e6).toFixed(1)} MB more have passed unread`));
    for (const message of messages.slice(-most)) {
      const last = this.kept[0];
      if (last !== undefined && alike(last, message)) {
        message.parts = (last.parts ?? 1) + (message.parts ?? 1);
        this.kept[0] = message;
        if (this.passes(message)) this.list.firstElementChild?.replaceWith(row(message));
        continue;
      }
      this.kept.unshift(message);
      if (this.passes(message)) this.list.prepend(row(message));
    }
    this.kept.length = Math.min(this.kept.length, most);
    while (this.list.childElementCount > most) this.list.lastElementChild!.remove();
  }

  reset(): void {
    this.kept = [];
    this.list.replaceChildren();
  }

  private passes(message: Message): boolean {
    if (this.filter === "") return true;
    const text = [message.device, message.port, message.name, message.reason, message.fault ?? "", ...message.fields.map((field) => field[0])].join(" ");
    return text.toLowerCase().includes(this.filter);
  }
}

/** The parts of one picture come as many messages in a few milliseconds. */
function alike(a: Message, b: Message): boolean {
  if (a.fault !== undefined || b.fault !== undefined) return false;
  return a.device === b.device && a.port === b.port && a.sent === b.sent && a.name === b.name && b.unix - a.unix < 0.01;
}

function remark(text: string): HTMLElement {
  const element = document.createElement("p");
  element.className = "remark";
  element.textContent = `${new Date().toISOString().slice(11, 23)} ${text}`;
  return element;
}

function row(message: Message): HTMLElement {
  const element = document.createElement("details");
  const line = document.createElement("summary");
  const time = new Date(message.unix * 1000).toISOString().slice(11, 23);
  const way = document.createElement("span");
  way.className = message.sent ? "from" : "to";
  way.textContent = message.sent ? "\u2190 " : "\u2192 ";
  line.append(`${time} `, way, `${message.device} ${message.port}  ${message.name || "?"}  ${message.size} B${message.parts ? ` x ${message.parts}` : ""}  `);
  if (message.fault !== undefined) {
    const fault = document.createElement("b");
    fault.className = "fault";
    fault.textContent = `fault: ${message.fault} `;
    line.append(fault);
  }
  if (message.reason !== "") {
    line.classList.add("bad");
    line.append("refused: " + message.reason);
  } else {
    line.append(message.fields.slice(0, 4).map(([name, text, unit]) => `${name} ${text}${unit ? " " + unit : ""}`).join(", "));
  }
  element.append(line);
  element.ontoggle = () => {
    if (element.childElementCount > 1) return;
    const table = document.createElement("table");
    for (const [name, text, unit] of [...message.fields, ["bytes", message.bytes, ""]]) {
      const cells = table.insertRow();
      for (const cell of [name, text, unit]) cells.insertCell().textContent = cell;
    }
    element.append(table);
  };
  return element;
}
