// Unpacks the data of a page: a description, the stacks and the relief. PageStack and PageRelief in lib/write define
// the encoding.

async function inflated(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i)
    bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Each section begins with its length in four bytes.
function sections(bytes) {
  const found = [];
  const view = new DataView(bytes.buffer);
  for (let at = 0; at < bytes.length;) {
    const size = view.getUint32(at, true);
    found.push(bytes.subarray(at + 4, at + 4 + size));
    at += 4 + size;
  }
  return found;
}

class Numbers {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  // Reads an integer of up to 53 bits.
  take() {
    let byte = this.bytes[this.at++];
    let number = byte & 0x7f;
    for (let factor = 0x80; byte >= 0x80; factor *= 0x80) {
      byte = this.bytes[this.at++];
      number += (byte & 0x7f) * factor;
    }
    return number;
  }

  takeSigned() { return signed(this.take()); }
}

function signed(number) { return number % 2 === 0 ? number / 2 : -(number + 1) / 2; }

// Growing arrays, trimmed at the end.
class List {
  constructor(Type) {
    this.values = new Type(1024);
    this.size = 0;
  }

  push(value) {
    if (this.size === this.values.length) {
      const larger = new this.values.constructor(2 * this.size);
      larger.set(this.values);
      this.values = larger;
    }
    this.values[this.size++] = value;
  }

  done() { return this.values.slice(0, this.size); }
}

// Lists of buildings, tiers, rings and vertices, and of faces of roofs with their rings and vertices; lists of begins
// have one more entry, the end. Lengths are in steps of the frame, heights in millimetres.
export function unpackStack(bytes, buildings) {
  const numbers = new Numbers(bytes);
  const lists = {
    id: new List(Float64Array),
    base: new List(Float64Array),
    roof: new List(Float64Array),
    tiersFrom: new List(Uint32Array),
    level: new List(Uint16Array),
    parent: new List(Int32Array),
    top: new List(Float64Array),
    ringsFrom: new List(Uint32Array),
    cornersFrom: new List(Uint32Array),
    x: new List(Float64Array),
    y: new List(Float64Array),
    facesFrom: new List(Uint32Array),
    faceRingsFrom: new List(Uint32Array),
    faceCornersFrom: new List(Uint32Array),
    faceX: new List(Float64Array),
    faceY: new List(Float64Array),
    faceZ: new List(Float64Array),
  };
  let [id, base, x, y] = [0, 0, 0, 0];
  const takeRing = () => {
    lists.cornersFrom.push(lists.x.size);
    for (let left = numbers.take(); left > 0; --left) {
      lists.x.push(x += numbers.takeSigned());
      lists.y.push(y += numbers.takeSigned());
    }
  };
  const takeTier = () => {
    const tier = lists.level.size;
    lists.level.push(numbers.take());
    const back = numbers.take();
    lists.parent.push(back === 0 ? -1 : tier - back);
    const below = back === 0 ? base : lists.top.values[tier - back];
    lists.top.push(below + numbers.takeSigned());
    lists.ringsFrom.push(lists.cornersFrom.size);
    for (let left = numbers.take(); left > 0; --left)
      takeRing();
  };
  let z = 0;
  const takeFaceRing = () => {
    lists.faceCornersFrom.push(lists.faceX.size);
    for (let left = numbers.take(); left > 0; --left) {
      lists.faceX.push(x += numbers.takeSigned());
      lists.faceY.push(y += numbers.takeSigned());
      lists.faceZ.push(z += numbers.takeSigned());
    }
  };
  const takeFace = () => {
    lists.faceRingsFrom.push(lists.faceCornersFrom.size);
    for (let left = numbers.take(); left > 0; --left)
      takeFaceRing();
  };
  for (let i = 0; i < buildings; ++i) {
    lists.id.push(id += numbers.takeSigned());
    lists.base.push(base += numbers.takeSigned());
    lists.roof.push(base + numbers.takeSigned());
    lists.tiersFrom.push(lists.level.size);
    for (let left = numbers.take(); left > 0; --left)
      takeTier();
    lists.facesFrom.push(lists.faceRingsFrom.size);
    z = base;
    for (let left = numbers.take(); left > 0; --left)
      takeFace();
  }
  lists.tiersFrom.push(lists.level.size);
  lists.ringsFrom.push(lists.cornersFrom.size);
  lists.cornersFrom.push(lists.x.size);
  lists.facesFrom.push(lists.faceRingsFrom.size);
  lists.faceRingsFrom.push(lists.faceCornersFrom.size);
  lists.faceCornersFrom.push(lists.faceX.size);
  return Object.fromEntries(Object.entries(lists).map(([name, list]) => [name, list.done()]));
}

// Heights in metres, row by row; NaN if missing.
export function unpackRelief(bytes, rows, cols) {
  const numbers = new Numbers(bytes);
  const heights = new Float32Array(rows * cols).fill(NaN);
  let above = 0;
  for (let row = 0; row < rows; ++row) {
    let before = above;
    for (let col = 0; col < cols; ++col) {
      const packed = numbers.take();
      if (packed === 0)
        continue;
      before += signed(packed - 1);
      heights[row * cols + col] = before / 100;
      if (col === 0)
        above = before;
    }
  }
  return heights;
}

export async function unpack(text) {
  const [about, stack, relief] = sections(await inflated(text));
  const description = JSON.parse(new TextDecoder().decode(about));
  const {rows, cols} = description.frame.relief;
  return {
    about: description,
    stack: unpackStack(stack, description.buildings),
    relief: unpackRelief(relief, rows, cols),
  };
}
