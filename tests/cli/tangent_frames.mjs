// Holds tangents against MikkTSpace: reads what `burnish-fixture tangents` prints.
//
//   tangent_frames.mjs NAME <corners     a line; exit 1 where fewer than 99.9 % of corners agree to 0.1° and in sign
import { readFileSync } from 'node:fs';
import { load } from './node_package.mjs';

const { generateTangents } = await load('mikktspace');
const corners = readFileSync(0, 'utf8').trim().split('\n').map((line) => line.split(' ').map(Number));
const columns = (first, count) => Float32Array.from(corners.flatMap((c) => c.slice(first, first + count)));
const theirs = generateTangents(columns(0, 3), columns(3, 3), columns(6, 2)); // x, y, z, sign a corner

const angle = ([ax, ay, az], [bx, by, bz]) =>
  (Math.atan2(Math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), ax * bx + ay * by + az * bz) * 180) /
  Math.PI;

let agree = 0, mirrored = 0, worst = 0;
corners.forEach((c, i) => {
  const degrees = angle(c.slice(8, 11), theirs.subarray(4 * i, 4 * i + 3));
  worst = Math.max(worst, degrees);
  if (degrees <= 0.1 && c[11] === theirs[4 * i + 3]) agree++;
  if (theirs[4 * i + 3] < 0) mirrored++;
});
console.log(`${process.argv[2]}: ${agree} of ${corners.length} corners agree, ${mirrored} mirrored, worst ${worst.toFixed(4)} degrees`);
process.exit(agree >= 0.999 * corners.length ? 0 : 1);
