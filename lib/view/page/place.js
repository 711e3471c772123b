// Converts steps of the frame to metres: x to the east, y to the north, z up, relative to the origin of the page.

export class Place {
  constructor(frame) { this.frame = frame; }

  x(steps) { return this.frame.offset[0] + steps * this.frame.scale[0]; }

  y(steps) { return this.frame.offset[1] + steps * this.frame.scale[1]; }

  z(steps) { return this.frame.offset[2] + steps * this.frame.scale[2]; }

  // Converts fractions of the rows and columns of the window to a position.
  inWindow(down, across) {
    const [first, below, opposite, beside] = this.frame.corners;
    return [0, 1].map(
        (axis) => (1 - down) * ((1 - across) * first[axis] + across * beside[axis]) +
            down * ((1 - across) * below[axis] + across * opposite[axis]));
  }
}
