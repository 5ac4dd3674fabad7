// How each sonar does: pings, lateness, traffic.
import type { DeviceStatus } from "./news";

export class Devices {
  private before = new Map<string, { t: number; pings: number }>();

  constructor(private readonly table: HTMLTableElement) {}

  take({ t, devices }: { t: number; devices: DeviceStatus[] }): void {
    const rows = devices.map((one) => {
      const last = this.before.get(one.name);
      const rate = last && t > last.t ? ((one.pings - last.pings) / (t - last.t)).toFixed(1) : "";
      this.before.set(one.name, { t, pings: one.pings });
      const made = Object.entries(one.faults).map(([kind, count]) => `${kind} ${count}`).join(", ");
      const row = document.createElement("tr");
      const cells: [string, boolean][] = [
        [one.name, false],
        [String(one.pings), false],
        [rate, false],
        [String(one.late_pings), one.late_pings > 0],
        [String(one.messages), false],
        [one.rejected + one.skipped_bytes === 0 ? "0" : `${one.rejected}, ${one.skipped_bytes} B`, one.rejected + one.skipped_bytes > 0],
        [bytes(one.bytes_in), false],
        [bytes(one.bytes_out), false],
        [one.connected.join(", "), false],
        [made, made !== ""],
      ];
      for (const [text, bad] of cells) {
        const cell = row.insertCell();
        cell.textContent = text;
        cell.classList.toggle("bad", bad);
      }
      return row;
    });
    this.table.tBodies[0].replaceChildren(...rows);
  }
}

function bytes(count: number): string {
  return count < 10_000 ? count + " B" : count < 1e7 ? (count / 1e3).toFixed(0) + " kB" : (count / 1e6).toFixed(1) + " MB";
}
