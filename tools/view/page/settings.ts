// What drivers have set: the last message of each kind that each has said, and what was new in it.
import { telling } from "./fields";
import type { Setting } from "./news";

export class Settings {
  private readonly known = new Map<string, Setting>();

  constructor(private readonly table: HTMLTableElement) {}

  take(settings: Setting[]): void {
    if (settings.length === 0) return;
    for (const one of settings) {
      const key = one.device + "\n" + one.name;
      const before = this.known.get(key);
      // what was new stays marked until something else is
      if (one.changed.length === 0 && before !== undefined) one.changed = before.changed;
      this.known.set(key, one);
    }
    const rows = [...this.known.values()].sort((a, b) => a.device.localeCompare(b.device) || b.unix - a.unix);
    this.table.tBodies[0].replaceChildren(...rows.map(row));
  }

  reset(): void {
    this.known.clear();
    this.table.tBodies[0].replaceChildren();
  }
}

function row(setting: Setting): HTMLElement {
  const element = document.createElement("tr");
  const values = document.createElement("td");
  values.className = "values";
  telling(setting.fields).forEach(([name, text, unit], i) => {
    const one = document.createElement(setting.changed.includes(name) ? "b" : "span");
    one.textContent = `${name} ${text}${unit ? " " + unit : ""}`;
    values.append(i > 0 ? ", " : "", one);
  });
  const cells = [setting.device, new Date(setting.unix * 1000).toISOString().slice(11, 23), setting.name, String(setting.times)];
  for (const text of cells) element.insertCell().textContent = text;
  element.append(values);
  return element;
}
