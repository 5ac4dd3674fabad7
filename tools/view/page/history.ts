// The last minute of what has come, for whoever wants to see it again.
import type { News, Ping } from "./news";

const longest = 60_000; // ms
const most = 200e6; // bytes; with large pictures it is less than a minute

interface Kept {
  at: number; // ms, when it came
  size: number;
  news: News | Ping;
}

export class History {
  private kept: Kept[] = [];
  private size = 0;

  add(at: number, size: number, news: News | Ping): void {
    this.kept.push({ at, size, news });
    this.size += size;
    let gone = 0;
    while (gone < this.kept.length - 1 && (at - this.kept[gone].at > longest || this.size > most)) this.size -= this.kept[gone++].size;
    if (gone > 0) this.kept.splice(0, gone);
  }

  clear(): void {
    this.kept = [];
    this.size = 0;
  }

  /** ms, of the oldest and of the newest. */
  ends(): [number, number] {
    return this.kept.length === 0 ? [0, 0] : [this.kept[0].at, this.kept[this.kept.length - 1].at];
  }

  until(at: number): (News | Ping)[] {
    return this.kept.filter((one) => one.at <= at).map(({ news }) => news);
  }
}
