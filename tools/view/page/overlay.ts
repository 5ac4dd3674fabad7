// What is drawn over a picture: range rings, the scale, the ruler.
import type { Palette } from "./palette";
import type { Picture } from "./picture";
import { height, plain, ringStep, width } from "./sketch";

export interface Look {
  palette: Palette;
  span: number; // dB below the loudest that are shown
}

export function drawOverlay(context: CanvasRenderingContext2D, picture: Picture, look: Look): void {
  drawRings(context, picture);
  if (picture.kind !== "profile" && picture.kind !== "depth") drawScale(context, picture, look);
  drawRuler(context, picture);
}

function drawRings(context: CanvasRenderingContext2D, picture: Picture): void {
  const ping = picture.last!;
  const { far, kind } = picture;
  const near = kind === "echogram" ? ping.first_range : 0;
  context.strokeStyle = "rgba(160, 190, 200, 0.35)";
  context.fillStyle = "rgba(200, 220, 230, 0.9)";
  context.lineWidth = 1;
  context.font = "11px sans-serif";
  const step = ringStep(far);
  for (let range = step; range <= far * 1.001; range += step) {
    const text = plain(range) + " m";
    context.beginPath();
    if (kind === "fan" || kind === "profile") {
      const { centre, scale, down } = picture.frame(ping);
      const round = ping.bearings[ping.beams - 1] > Math.PI / 2;
      context.arc(...centre, range * scale, round ? 0 : down ? 0 : -Math.PI, round ? 2 * Math.PI : down ? Math.PI : 0);
      context.fillText(text, centre[0] + 3, centre[1] + (down ? range * scale - 4 : 12 - range * scale));
    } else if (kind === "circle") {
      const radius = (range / far) * (height / 2 - 8);
      context.arc(width / 2, height / 2, radius, 0, 2 * Math.PI);
      context.fillText(text, width / 2 + 3, height / 2 - radius + 12);
    } else if (kind === "echogram" || kind === "depth") {
      const y = ((range - near) / (far - near)) * height;
      context.moveTo(0, y);
      context.lineTo(width, y);
      context.fillText(text, 3, y - 3);
    } else if (kind === "sidescan") {
      for (const x of ping.beams === 1 ? [(width * range) / far] : [-1, 1].map((side) => width / 2 + (side * width * range) / (2 * far))) {
        context.moveTo(x, 0);
        context.lineTo(x, height);
        context.fillText(text, x + 3, height - 5);
      }
    }
    context.stroke();
  }
}

function drawScale(context: CanvasRenderingContext2D, picture: Picture, look: Look): void {
  const counts = picture.last!.unit === "counts";
  const ranges = picture.kind === "range image";
  const high = ranges ? "0 m" : counts ? "255" : picture.top.toFixed(0) + " dB";
  const low = ranges ? plain(picture.far) + " m" : counts ? "0" : picture.low(look).toFixed(0) + " dB";
  for (let i = 0; i < 100; i++) {
    const c = 3 * Math.round((i / 99) * 255);
    context.fillStyle = `rgb(${look.palette[c]},${look.palette[c + 1]},${look.palette[c + 2]})`;
    context.fillRect(width - 16, 110 - i, 8, 1);
  }
  context.fillStyle = "rgba(200, 220, 230, 0.9)";
  context.textAlign = "right";
  context.fillText(high, width - 20, 18);
  context.fillText(low, width - 20, 112);
  context.textAlign = "left";
}

function drawRuler(context: CanvasRenderingContext2D, picture: Picture): void {
  if (picture.ruler === null || picture.pointer === null) return;
  context.strokeStyle = "#fff";
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(...picture.ruler);
  context.lineTo(...picture.pointer);
  context.stroke();
  const text = rulerText(picture);
  context.fillStyle = "#fff";
  context.font = "bold 12px sans-serif";
  context.fillText(text, Math.min(picture.pointer[0] + 8, width - 60), Math.max(picture.pointer[1] - 6, 14));
}

/** "2.31 m"; "" where it measures nothing. */
export function rulerText(picture: Picture): string {
  if (picture.ruler === null || picture.pointer === null) return "";
  const from = picture.placeAt(...picture.ruler);
  const to = picture.placeAt(...picture.pointer);
  return from === null || to === null ? "" : Math.hypot(to[0] - from[0], to[1] - from[1]).toFixed(2) + " m";
}
