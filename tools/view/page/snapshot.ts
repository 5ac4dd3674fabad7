// Pictures of the page as files: the browser offers them as downloads.

/** The pictures of a card side by side, with its words above. */
export function saveCard(name: string, facts: string, canvases: HTMLCanvasElement[]): void {
  const head = 44;
  const all = document.createElement("canvas");
  all.width = canvases.reduce((sum, { width }) => sum + width, 0);
  all.height = head + Math.max(...canvases.map(({ height }) => height));
  const context = all.getContext("2d")!;
  context.fillStyle = "#101518";
  context.fillRect(0, 0, all.width, all.height);
  context.fillStyle = "#dfe6e9";
  context.font = "bold 14px sans-serif";
  context.fillText(name, 8, 17);
  context.font = "11px sans-serif";
  context.fillText(facts, 8, 35, all.width - 16);
  let x = 0;
  for (const canvas of canvases) {
    context.drawImage(canvas, x, head);
    x += canvas.width;
  }
  saveCanvas(name, all);
}

export function saveCanvas(name: string, canvas: HTMLCanvasElement): void {
  canvas.toBlob((blob) => {
    if (blob === null) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `echoloop-${name.replace(/[^A-Za-z0-9_-]+/g, "_")}-${new Date().toISOString().replace(/[:.]/g, "")}.png`;
    link.click();
    window.setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }, "image/png");
}
