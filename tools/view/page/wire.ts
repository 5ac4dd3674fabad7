// The messages on the wires, the latest first: a line each, its fields when it is opened.
import { mostTelling } from "./fields";
import type { Message } from "./news";

const most = 300;

interface Row {
  message: Message | null; // null: a remark
  element: HTMLElement;
}

export class Wire {
  private paused = false;
  private filter = "";
  private rows: Row[] = []; // the latest first; those that do not pass the filter are hidden

  constructor(private readonly list: HTMLElement, filter: HTMLInputElement, pause: HTMLButtonElement) {
    filter.oninput = () => {
      this.filter = filter.value.toLowerCase();
      for (const { message, element } of this.rows) element.hidden = !this.passes(message);
    };
    pause.onclick = () => {
      this.paused = !this.paused;
      pause.textContent = this.paused ? "Go on" : "Pause";
    };
  }

  /** `leftOut`: bytes that were not read, since there were too many. */
  take(messages: Message[], leftOut: number): void {
    if (this.paused) return;
    const before = this.list.scrollHeight;
    const read = this.list.scrollTop > 0 || this.rows.some(isOpen);
    if (leftOut > 0) this.add(null, remark(`${(leftOut / 1e6).toFixed(1)} MB more have passed unread`));
    for (const message of messages.slice(-most)) {
      const last = this.rows[0];
      if (last !== undefined && last.message !== null && !isOpen(last) && alike(last.message, message)) {
        message.parts = (last.message.parts ?? 1) + (message.parts ?? 1);
        this.rows.shift();
        last.element.remove();
      }
      this.add(message, rowOf(message));
    }
    // what somebody reads stays where it is, and stays
    if (read) this.list.scrollTop += this.list.scrollHeight - before;
    for (const one of this.rows.splice(most)) isOpen(one) ? this.rows.push(one) : one.element.remove();
  }

  reset(): void {
    this.rows = [];
    this.list.replaceChildren();
  }

  private add(message: Message | null, element: HTMLElement): void {
    element.hidden = !this.passes(message);
    this.rows.unshift({ message, element });
    this.list.prepend(element);
  }

  private passes(message: Message | null): boolean {
    if (this.filter === "") return true;
    if (message === null) return false;
    const text = [message.device, message.port, message.name, message.reason && "refused: " + message.reason, message.fault && "fault: " + message.fault, ...message.fields.map((field) => field[0])].join(" ");
    return text.toLowerCase().includes(this.filter);
  }
}

function isOpen({ element }: Row): boolean {
  return element instanceof HTMLDetailsElement && element.open;
}

/** The parts of one picture come as many messages in a few milliseconds. */
function alike(a: Message, b: Message): boolean {
  if (a.fault !== undefined || b.fault !== undefined) return false;
  return a.device === b.device && a.port === b.port && a.sent === b.sent && a.name === b.name && a.reason === b.reason && b.unix - a.unix < 0.01;
}

function remark(text: string): HTMLElement {
  const element = document.createElement("p");
  element.className = "remark";
  element.textContent = `${new Date().toISOString().slice(11, 23)} ${text}`;
  return element;
}

function rowOf(message: Message): HTMLDetailsElement {
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
    line.append(mostTelling(message.fields, message.name).slice(0, 4).map(([name, text, unit]) => `${name} ${text}${unit ? " " + unit : ""}`).join(", "));
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
