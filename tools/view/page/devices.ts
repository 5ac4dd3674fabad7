// How each sonar does: pings, lateness, queues; and how busy each line is.
import type { DeviceStatus, Line, Ping, Rendering } from "./news";

const bits_per_byte = 10; // on a serial line

export class Devices {
  private before = new Map<string, { t: number; pings: number }>();
  private drawn = new Map<string, string>();
  private counted: { t: number; lines: Line[] } | null = null;

  constructor(private readonly table: HTMLTableElement, private readonly lines: HTMLTableElement, private readonly rendering: HTMLElement) {}

  /** How long the drawing of a ping took, of the time that there was. */
  ping(ping: Ping): void {
    if (ping.type === "ping" && ping.due > 0) this.drawn.set(ping.device, `${(ping.drawn * 1000).toFixed(0)} of ${(ping.due * 1000).toFixed(0)} ms`);
  }

  take({ t, devices, rendering }: { t: number; devices: DeviceStatus[]; rendering?: Rendering }): void {
    if (rendering) {
      this.rendering.textContent = `${rendering.drawing} of ${rendering.threads} render threads draw, ${rendering.waiting} ${rendering.waiting === 1 ? "ping waits" : "pings wait"} for one`;
      this.rendering.classList.toggle("bad", rendering.waiting > rendering.threads);
    }
    const rows = devices.map((one) => {
      const last = this.before.get(one.name);
      const rate = last && t > last.t ? ((one.pings - last.pings) / (t - last.t)).toFixed(1) : "";
      this.before.set(one.name, { t, pings: one.pings });
      const made = Object.entries(one.faults).map(([kind, count]) => `${kind} ${count}`).join(", ");
      return rowOf([
        [one.name, false],
        [String(one.pings), false],
        [rate, false],
        [String(one.late_pings), one.late_pings > 0],
        [this.drawn.get(one.name) ?? "", false],
        [String(one.messages), false],
        [one.rejected + one.skipped_bytes === 0 ? "0" : `${one.rejected}, ${one.skipped_bytes} B`, one.rejected + one.skipped_bytes > 0],
        [one.waiting === 0 ? "0" : `${one.waiting}, ${bytes(one.waiting_bytes)}`, false],
        [one.connected.join(", "), false],
        [made, made !== ""],
      ]);
    });
    this.table.tBodies[0].replaceChildren(...rows);
  }

  takeLines(now: { t: number; lines: Line[] }): void {
    const last = this.counted;
    this.counted = now;
    const rows = now.lines.map((line) => {
      const before = last?.lines.find(({ device, port }) => device === line.device && port === line.port);
      const seconds = last ? now.t - last.t : 0;
      const rate = (count: number, earlier: number | undefined): number => (earlier === undefined || seconds <= 0 ? 0 : Math.max(0, count - earlier) / seconds);
      const [to, from] = [rate(line.in, before?.in), rate(line.out, before?.out)];
      const load = line.rate > 0 ? (100 * bits_per_byte * Math.max(to, from)) / line.rate : 0;
      return rowOf([
        [line.device, false],
        [line.port, false],
        [bytes(to) + "/s", false],
        [bytes(from) + "/s", false],
        [line.rate > 0 ? `${load.toFixed(0)} % of ${line.rate} bit/s` : "", load > 95],
        [bytes(line.in), false],
        [bytes(line.out), false],
      ]);
    });
    this.lines.tBodies[0].replaceChildren(...rows);
  }
}

function rowOf(cells: [string, boolean][]): HTMLElement {
  const row = document.createElement("tr");
  for (const [text, bad] of cells) {
    const cell = row.insertCell();
    cell.textContent = text;
    cell.classList.toggle("bad", bad);
  }
  return row;
}

function bytes(count: number): string {
  return count < 10_000 ? count.toFixed(0) + " B" : count < 1e7 ? (count / 1e3).toFixed(0) + " kB" : (count / 1e6).toFixed(1) + " MB";
}
