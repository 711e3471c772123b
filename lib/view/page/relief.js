// Ground: heights, and hillshade from the north-west like the pictures of -preview.

const tones = {
  light: {dark: 130, flat: 222, bright: 250, tint: [1, 1, 0.985]},
  dark: {dark: 22, flat: 58, bright: 92, tint: [0.94, 1, 1.08]},
};

export class Relief {
  constructor(town) {
    const {rows, cols, down, across} = town.about.frame.relief;
    Object.assign(this, {rows, cols, down, across, town, heights: town.heights});
    const [x0, y0] = town.place.inWindow(0, 0);
    const [x1, y1] = town.place.inWindow(0, 1);
    const [x2, y2] = town.place.inWindow(1, 0);
    this.width = Math.hypot(x1 - x0, y1 - y0) * across;  // width of a sample, metres
    this.height = Math.hypot(x2 - x0, y2 - y0) * down;
    // Window as a parallelogram: its begin and its sides.
    this.axes = {x0, y0, right: [x1 - x0, y1 - y0], down: [x2 - x0, y2 - y0]};
    this.det = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
    this.southUp = y2 > y0;
    this.eastFirst = x1 < x0;
    this.images = new Map();  // by theme
    this.origin = town.about.frame.origin[2];
  }

  // Height in metres from the origin of the page; NaN if missing.
  at(row, col) { return this.heights[row * this.cols + col] - this.origin; }

  // Lowest sample, relative to the origin of the page; 0 if there are none.
  lowest() {
    let lowest = Infinity;
    for (const height of this.heights)
      if (height < lowest)
        lowest = height;
    return lowest === Infinity ? 0 : lowest - this.origin;
  }

  // Centre of a sample; samples at the border lie on it, because the window has no data beyond.
  position(row, col) {
    const share = (i, count, step) => i === 0 ? 0 : i === count - 1 ? 1 : Math.min(1, (i + 0.5) * step);
    return this.town.place.inWindow(share(row, this.rows, this.down), share(col, this.cols, this.across));
  }

  // Shades from 0 to 255, row by row.
  shades(theme) {
    const {dark, flat, bright} = tones[theme];
    const shades = new Uint8Array(this.rows * this.cols);
    const rise = (from, to, here) => (Number.isNaN(to) ? here : to) - (Number.isNaN(from) ? here : from);
    for (let row = 0; row < this.rows; ++row)
      for (let col = 0; col < this.cols; ++col) {
        const here = this.at(row, col);
        let right = rise(this.at(row, Math.max(0, col - 1)), this.at(row, Math.min(this.cols - 1, col + 1)), here);
        let below = rise(this.at(Math.max(0, row - 1), col), this.at(Math.min(this.rows - 1, row + 1), col), here);
        right *= (this.eastFirst ? -0.5 : 0.5) / this.width;
        below *= (this.southUp ? -0.5 : 0.5) / this.height;
        const less = 0.8 / (0.8 + Math.hypot(right, below));
        right *= less;
        below *= less;
        const light = (1 + right + below) / Math.sqrt(1 + right * right + below * below);
        const shade = light < 1 ? dark + (flat - dark) * Math.max(light, 0) :
                                  flat + (bright - flat) * (light - 1) / (Math.sqrt(3) - 1);
        shades[row * this.cols + col] = Number.isNaN(here) ? flat : Math.round(shade);
      }
    return shades;
  }

  // Draws one pixel per sample.
  image(theme) {
    if (this.images.has(theme))
      return this.images.get(theme);
    const image = new ImageData(this.cols, this.rows);
    const {tint} = tones[theme];
    this.shades(theme).forEach((shade, i) => {
      for (let part = 0; part < 3; ++part)
        image.data[4 * i + part] = tint[part] * shade;
      image.data[4 * i + 3] = Number.isNaN(this.heights[i]) ? 0 : 255;
    });
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [this.cols, this.rows];
    canvas.getContext('2d').putImageData(image, 0, 0);
    this.images.set(theme, canvas);
    return canvas;
  }

  // Returns the ground height near a position, in metres from the origin; NaN if missing.
  near(x, y) {
    const {x0, y0, right, down} = this.axes;
    const across = ((x - x0) * down[1] - down[0] * (y - y0)) / this.det;
    const below = (right[0] * (y - y0) - (x - x0) * right[1]) / this.det;
    const row = Math.min(this.rows - 1, Math.max(0, Math.floor(below / this.down)));
    const col = Math.min(this.cols - 1, Math.max(0, Math.floor(across / this.across)));
    return this.at(row, col);
  }
}
