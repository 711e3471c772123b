#!/usr/bin/env node
// Makes a raster of the highest points of a LAS or LAZ file, for dem2buildings:
//     node highest_points.js scan.laz 0.5 dsm.flt
// Cells are squares of the given side, in the unit of the file. Points classified as noise (7, 18) or withheld are left
// out; cells without a point are NoData. The result is a grid of 32-bit floats with a header, dsm.flt and dsm.hdr, which
// GDAL reads. LAZ needs the package laz-perf (npm install laz-perf); LAS needs none.
"use strict";

const fs = require("fs");
const path = require("path");

const NODATA = -9999;
const NOISE = new Set([7, 18]);

function fail(message) {
  process.stderr.write(`highest_points: ${message}\n`);
  process.exit(1);
}

/** Returns the public header's account of the points; its format is described in the LAS specification 1.4, table 3. */
function headerOf(data) {
  if (data.length < 227 || data.toString("latin1", 0, 4) !== "LASF") fail("the file is neither LAS nor LAZ; give one of these");
  const count = data[25] >= 4 && data.length >= 255 ? Number(data.readBigUInt64LE(247)) : 0;
  return {
    start: data.readUInt32LE(96),
    format: data[104] & 0x3f, // the two highest bits say that the points are compressed
    compressed: (data[104] & 0xc0) !== 0,
    length: data.readUInt16LE(105),
    count: count || data.readUInt32LE(107),
    scale: [131, 139, 147].map((at) => data.readDoubleLE(at)),
    offset: [155, 163, 171].map((at) => data.readDoubleLE(at)),
    high: [179, 195].map((at) => data.readDoubleLE(at)),
    low: [187, 203].map((at) => data.readDoubleLE(at)),
  };
}

/** Calls visit(bytes, position) for each record of a point. */
async function eachPoint(data, header, visit) {
  if (!header.compressed) {
    if (data.length < header.start + header.count * header.length) fail("the file is shorter than its header says");
    for (let i = 0; i < header.count; ++i) visit(data, header.start + i * header.length);
    return;
  }
  const folders = [process.cwd(), __dirname];
  let found;
  try {
    found = require(require.resolve("laz-perf", { paths: folders }));
  } catch {
    fail("a LAZ needs the package laz-perf; install it with: npm install laz-perf");
  }
  const laz = await found.create();
  const file = laz._malloc(data.length);
  const point = laz._malloc(header.length);
  laz.HEAPU8.set(data, file);
  const reader = new laz.LASZip();
  reader.open(file, data.length);
  for (let i = 0; i < header.count; ++i) {
    reader.getPoint(point);
    visit(Buffer.from(laz.HEAPU8.buffer, point, header.length), 0); // the memory may have moved
  }
}

async function main(source, side, target) {
  const cell = Number(side);
  if (!target || !(cell > 0)) fail("write: node highest_points.js scan.laz <side of a cell> dsm.flt");
  if (path.extname(target) !== ".flt") fail("give the result a name that ends in .flt");
  const data = fs.readFileSync(source);
  const header = headerOf(data);
  // Borders of cells are multiples of their side, so that grids of neighbouring files fit together.
  const left = Math.floor(header.low[0] / cell);
  const top = Math.floor(header.high[1] / cell) + 1;
  const cols = Math.floor(header.high[0] / cell) + 1 - left;
  const rows = top - Math.floor(header.low[1] / cell);
  if (!(cols > 0 && rows > 0 && cols * rows < 2 ** 31)) fail(`${rows} rows and ${cols} columns cannot be; give another side of a cell`);
  const highest = new Float32Array(cols * rows).fill(NODATA);
  const wide = header.format >= 6; // such records have the class a byte later, and flags of their own
  let used = 0;
  await eachPoint(data, header, (bytes, at) => {
    const kind = wide ? bytes[at + 16] : bytes[at + 15] & 31;
    const withheld = wide ? bytes[at + 15] & 4 : bytes[at + 15] & 128;
    if (NOISE.has(kind) || withheld) return;
    const [x, y, z] = [0, 1, 2].map((i) => bytes.readInt32LE(at + 4 * i) * header.scale[i] + header.offset[i]);
    const col = Math.floor(x / cell) - left;
    const row = top - 1 - Math.floor(y / cell);
    if (col < 0 || row < 0 || col >= cols || row >= rows) return;
    used += 1;
    if (z > highest[row * cols + col]) highest[row * cols + col] = z;
  });
  fs.writeFileSync(target, Buffer.from(highest.buffer));
  const lines = [`ncols ${cols}`, `nrows ${rows}`, `xllcorner ${left * cell}`, `yllcorner ${(top - rows) * cell}`, `cellsize ${cell}`,
    `NODATA_value ${NODATA}`, "byteorder LSBFIRST"];
  fs.writeFileSync(target.replace(/\.flt$/, ".hdr"), lines.join("\n") + "\n");
  const filled = highest.reduce((sum, z) => sum + (z === NODATA ? 0 : 1), 0);
  process.stdout.write(`${used} of ${header.count} points in ${rows} rows and ${cols} columns, ` +
    `${((100 * filled) / (rows * cols)).toFixed(1)} % of the cells have one\n`);
}

main(...process.argv.slice(2)).catch((error) => fail(error.message));
