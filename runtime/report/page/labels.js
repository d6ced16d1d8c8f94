// Labels that do not lie on each other.

class Labels {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.taken = [];
  }

  keepFree(x, y, radius) {
    this.taken.push([x - radius, y - radius, x + radius, y + radius]);
  }

  isFree(box) {
    if (box[0] < 2 || box[1] < 2 || box[2] > this.width - 2 || box[3] > this.height - 2) return false;
    return !this.taken.some((o) => box[0] < o[2] && o[0] < box[2] && box[1] < o[3] && o[1] < box[3]);
  }

  /** Draws a label near a place, with a line to it; nothing when there is no room. */
  draw(context, x, y, text, colour) {
    const width = context.measureText(text).width + 2;
    for (const distance of [9, 20, 36, 56]) {
      for (const [dx, dy] of [[0.7, -0.7], [0.7, 0.7], [1, 0], [-0.7, -0.7], [-0.7, 0.7], [-1, 0], [0, -1], [0, 1]]) {
        const anchorX = x + dx * distance, anchorY = y + dy * distance;
        const left = dx > 0.1 ? anchorX : dx < -0.1 ? anchorX - width : anchorX - width / 2;
        const box = [left, anchorY - 7, left + width, anchorY + 7];
        if (!this.isFree(box)) continue;
        this.taken.push(box);
        context.strokeStyle = colours.quiet;
        context.lineWidth = 0.6;
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(Math.min(Math.max(x, left), left + width), anchorY);
        context.stroke();
        context.lineWidth = 3;
        context.strokeStyle = colours.panel;
        context.strokeText(text, left, anchorY + 4);
        context.fillStyle = colour;
        context.fillText(text, left, anchorY + 4);
        return;
      }
    }
  }
}

/** Texts of places that fall together in the picture, as one: [{x, y, text}]. */
function groupLabels(entries) {
  const groups = [];
  for (const { x, y, text } of entries) {
    const group = groups.find((g) => Math.hypot(g.x - x, g.y - y) <= 4);
    if (!group) groups.push({ x, y, texts: [text] });
    else if (!group.texts.includes(text)) group.texts.push(text);
  }
  return groups.map(({ x, y, texts }) => ({ x, y,
    text: texts.slice(0, 3).join(", ") + (texts.length > 3 ? " +" + (texts.length - 3) : "") }));
}
