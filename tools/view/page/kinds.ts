// Pictures of one sonar that come in turn: of two frequencies, or of several messages. Each keeps its own lines.
import type { Ping } from "./news";
import { Picture } from "./picture";

interface Kind {
  picture: Picture;
  last: number | null; // s, when its last came; null: none since it was reset
  period: number; // s, between its last two
}

const most = 8;

export class Kinds {
  readonly element = document.createElement("div");
  shown = ""; // which of them
  private readonly kinds = new Map<string, Kind>();
  private first: Picture | null; // before anything has come
  private began: number | null = null; // s, when the first of all came since they were reset
  private wanted = false; // somebody has chosen what is shown

  /** `added`: a picture that is new. `follows`: shows what comes for the first time, as after a driver's change of frequency. */
  constructor(private readonly waterfall: boolean, private readonly follows: boolean, private readonly added: (picture: Picture) => void) {
    this.element.className = "kinds";
    this.first = this.make();
  }

  get current(): Picture {
    return this.kinds.get(this.shown)?.picture ?? this.first!;
  }

  names(): string[] {
    return [...this.kinds.keys()];
  }

  reset(): void {
    this.began = null;
    for (const one of this.kinds.values()) {
      one.picture.reset();
      one.last = null;
      one.period = 0;
    }
  }

  /** True: there is another to choose, or another is shown. */
  take(ping: Ping): boolean {
    const before = this.shown;
    const known = this.kinds.get(ping.series);
    const one = known ?? { picture: this.first ?? this.make(), last: null, period: 0 };
    this.first = null;
    this.began ??= ping.t;
    const goesOn = one.last !== null && this.isFresh(one, ping.t);
    const returns = one.last !== null && !goesOn;
    const begins = one.last === null && !this.wanted && (this.follows || (this.kinds.get(this.shown)?.last ?? null) === null);
    if (goesOn) one.period = Math.max(0, ping.t - one.last!);
    one.last = ping.t;
    one.picture.take(ping);
    if (known === undefined) this.add(ping.series, one);
    const shown = this.kinds.get(this.shown);
    if (begins || (returns && this.follows && !this.wanted) || shown === undefined || !this.isFresh(shown, ping.t)) {
      this.wanted = false;
      this.show(ping.series);
    }
    return known === undefined || this.shown !== before;
  }

  /** Until it comes no more. */
  choose(name: string): void {
    if (!this.kinds.has(name)) return;
    this.wanted = true;
    this.show(name);
  }

  private show(name: string): void {
    this.shown = name;
    for (const [other, { picture }] of this.kinds) picture.canvas.hidden = other !== name;
    this.current.stale = true;
  }

  /** It has come at its pace until now. */
  private isFresh({ last, period }: Kind, now: number): boolean {
    return now - (last ?? this.began ?? now) <= Math.max(3, 3 * period); // s
  }

  private add(name: string, one: Kind): void {
    this.kinds.set(name, one);
    one.picture.canvas.hidden = name !== this.shown;
    if (this.kinds.size <= most) return;
    const others = [...this.kinds].filter(([other]) => other !== name && other !== this.shown);
    const [oldest, { picture }] = others.reduce((a, b) => ((b[1].last ?? 0) < (a[1].last ?? 0) ? b : a));
    picture.canvas.remove();
    this.kinds.delete(oldest);
  }

  private make(): Picture {
    const picture = new Picture(this.waterfall);
    this.element.append(picture.canvas);
    this.added(picture);
    return picture;
  }
}
