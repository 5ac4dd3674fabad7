// Colours of levels: 256 steps from faint to loud.

export type Palette = Uint8ClampedArray; // r g b of each step

const stops: Record<string, number[][]> = {
  copper: [[0, 0, 0], [60, 25, 5], [150, 75, 15], [230, 150, 50], [255, 225, 150], [255, 255, 245]],
  viridis: [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]],
  grey: [[0, 0, 0], [255, 255, 255]],
};

export function paletteOf(name: string): Palette {
  const of = stops[name] ?? stops.copper;
  const out = new Uint8ClampedArray(256 * 3);
  for (let i = 0; i < 256; i++) {
    const at = (i / 255) * (of.length - 1);
    const low = Math.min(Math.floor(at), of.length - 2);
    for (let c = 0; c < 3; c++) out[3 * i + c] = of[low][c] + (of[low + 1][c] - of[low][c]) * (at - low);
  }
  return out;
}
