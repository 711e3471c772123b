// tools/points/highest_points.js on files that are made here: node highest_points_test.js
// A folder that has node_modules/laz-perf may be named in D2B_LAZ_PERF; then the LAZ of D2B_LAZ is read, too, whose LAS is
// D2B_LAS: both must give the same grid.
"use strict";

const assert = require("assert");
const { spawnSync } = require("child_process");
const fs = require("fs");
const os = require("os");
const path = require("path");

const SCRIPT = path.join(__dirname, "../../tools/points/highest_points.js");
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "d2b_points_"));

/** Coordinates in hundredths; wide: format 6 of LAS 1.4, else format 0 of LAS 1.2. */
function las(points, wide) {
  const start = wide ? 375 : 227;
  const length = wide ? 30 : 20;
  const data = Buffer.alloc(start + points.length * length);
  data.write("LASF", 0, "latin1");
  data[24] = 1;
  data[25] = wide ? 4 : 2;
  data.writeUInt16LE(start, 94);
  data.writeUInt32LE(start, 96);
  data[104] = wide ? 6 : 0;
  data.writeUInt16LE(length, 105);
  if (wide) data.writeBigUInt64LE(BigInt(points.length), 247);
  else data.writeUInt32LE(points.length, 107);
  const offset = [391000, 5820000, 0];
  for (let i = 0; i < 3; ++i) {
    data.writeDoubleLE(0.01, 131 + 8 * i);
    data.writeDoubleLE(offset[i], 155 + 8 * i);
    const values = points.map((point) => point.at[i] / 100 + offset[i]);
    data.writeDoubleLE(Math.max(...values), 179 + 16 * i);
    data.writeDoubleLE(Math.min(...values), 187 + 16 * i);
  }
  points.forEach((point, k) => {
    const at = start + k * length;
    for (let i = 0; i < 3; ++i) data.writeInt32LE(point.at[i], at + 4 * i);
    const kind = point.kind || 1;
    if (wide) {
      data[at + 15] = point.withheld ? 4 : 0;
      data[at + 16] = kind;
    } else {
      data[at + 15] = kind | (point.withheld ? 128 : 0);
    }
  });
  return data;
}

function run(...given) {
  const done = spawnSync(process.execPath, [SCRIPT, ...given], { cwd: folder, encoding: "utf8" });
  return [done.status, done.stdout, done.stderr];
}

function grid(name) {
  const bytes = fs.readFileSync(path.join(folder, name + ".flt"));
  const header = Object.fromEntries(fs.readFileSync(path.join(folder, name + ".hdr"), "utf8").trim().split("\n")
    .map((line) => line.split(" ")));
  return { values: Array.from(new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4)), header };
}

// Two rows and three columns of 2 m. Noise and withheld points lie above all; a corner of a cell belongs to the cell above it
// and to the right.
const POINTS = [
  { at: [50, 50, 500] }, { at: [150, 199, 720] }, { at: [199, 0, 610] },
  { at: [200, 200, 300] }, { at: [250, 250, 100] }, { at: [399, 399, 299] },
  { at: [550, 60, 850] }, { at: [510, 70, 9000], kind: 7 }, { at: [590, 20, 9900], kind: 18 },
  { at: [560, 30, 9950], withheld: true }, { at: [30, 310, -120] },
];
for (const wide of [false, true]) {
  fs.writeFileSync(path.join(folder, "scan.las"), las(POINTS, wide));
  assert.deepStrictEqual(run("scan.las", "2", "dsm.flt"),
    [0, "8 of 11 points in 2 rows and 3 columns, 66.7 % of the cells have one\n", ""]);
  const { values, header } = grid("dsm");
  assert.deepStrictEqual(values.map((z) => Math.round(z * 100)), [-120, 300, -999900, 720, -999900, 850]);
  assert.deepStrictEqual(header, { ncols: "3", nrows: "2", xllcorner: "391000", yllcorner: "5820000", cellsize: "2",
    NODATA_value: "-9999", byteorder: "LSBFIRST" });
}

function refused(words, ...given) {
  const [status, , err] = run(...given);
  assert.strictEqual(status, 1);
  assert.ok(err.startsWith("highest_points: ") && err.includes(words), err);
}

const compressed = las(POINTS, false);
compressed[104] |= 128;
fs.writeFileSync(path.join(folder, "scan.laz"), compressed);
refused("npm install laz-perf", "scan.laz", "2", "dsm.flt");
fs.writeFileSync(path.join(folder, "short.las"), las(POINTS, false).subarray(0, 300));
refused("shorter than its header says", "short.las", "2", "dsm.flt");
fs.writeFileSync(path.join(folder, "no.las"), "II*");
refused("neither LAS nor LAZ", "no.las", "2", "dsm.flt");
refused("no such file", "none.las", "2", "dsm.flt");
refused("<side of a cell>", "scan.las", "-1", "dsm.flt");
refused("<side of a cell>", "scan.las", "2");
refused("ends in .flt", "scan.las", "2", "dsm.tif");
refused("another side of a cell", "scan.las", "0.00001", "dsm.flt");

if (process.env.D2B_LAZ_PERF) {
  fs.symlinkSync(path.join(process.env.D2B_LAZ_PERF, "node_modules"), path.join(folder, "node_modules"));
  const grids = [process.env.D2B_LAZ, process.env.D2B_LAS].map((file) => {
    assert.strictEqual(run(file, "1", "same.flt")[0], 0);
    return fs.readFileSync(path.join(folder, "same.flt"));
  });
  assert.ok(grids[0].equals(grids[1]));
}
fs.rmSync(folder, { recursive: true });
