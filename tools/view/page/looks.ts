// What is on the screen, told to the program: of the rest it sends a large picture once a second only.
import type { Card } from "./card";

export interface Looks {
  heard: string[];
  said: string[];
  true: string[];
}

export class Screen {
  private told = "";

  /** `scene`: shows the pings of all sonars. */
  constructor(private readonly scene: HTMLElement) {}

  /** What is to be told now; null: nothing has changed. */
  changed(cards: Map<string, Card>): Looks | null {
    const looks: Looks = { heard: [], said: [], true: [] };
    const all = isOnScreen(this.scene);
    for (const [device, card] of cards) {
      const shown = isOnScreen(card.element);
      const layers = card.layers();
      if (all || (shown && layers.heard)) looks.heard.push(device);
      if (shown && layers.said) looks.said.push(device);
      if (shown && layers.truth) looks.true.push(device);
    }
    const text = JSON.stringify(looks);
    if (text === this.told) return null;
    this.told = text;
    return looks;
  }

  /** The program knows nothing of what was told. */
  forget(): void {
    this.told = "";
  }
}

function isOnScreen(element: HTMLElement): boolean {
  if (element.hidden || document.visibilityState === "hidden") return false;
  const { top, bottom } = element.getBoundingClientRect();
  return bottom > 0 && top < window.innerHeight;
}
