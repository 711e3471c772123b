// Height colours, same as in the QGIS styles.

export const edge = [70, 45, 35];
export const chosen = [31, 120, 200];

export class Colours {
  constructor(about) {
    this.classes = about.classes;
    this.veil = about.veil;
  }

  // Paler if uncertain. The first class includes heights below 0 and missing ones.
  of(height, certainty, certain) {
    let found = 0;
    while (found + 1 < this.classes.length && height >= this.classes[found + 1].from)
      ++found;
    const colour = this.classes[found].colour;
    if (certainty === null || certainty === undefined || !(certainty < certain))
      return colour;
    const share = Math.min(1, Math.max(0, (certainty - this.veil.low) / (certain - this.veil.low)));
    const opacity = this.veil.most + (this.veil.least - this.veil.most) * share;
    return colour.map((part) => Math.round(part * (1 - opacity) + 255 * opacity));
  }
}
