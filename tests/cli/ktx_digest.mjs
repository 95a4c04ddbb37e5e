// node ktx_digest.mjs FILE.ktx2 FORMAT: what the npm package ktx-parse finds in an indexed map, in the words of
// `burnish-fixture digest`. Fails where the container is not one of that VkFormat, as parsers that know nothing of ours see it.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { load } from './node_package.mjs';

const { read } = await load('ktx-parse');
const [file, format] = process.argv.slice(2);
const ktx = read(readFileSync(file));
const bytes = { 13: 1, 74: 2 }[format];
const { vkFormat, typeSize, pixelDepth, layerCount, faceCount, supercompressionScheme, globalData } = ktx;
assert.deepEqual({ vkFormat, typeSize, pixelDepth, layerCount, faceCount, supercompressionScheme, globalData },
  { vkFormat: Number(format), typeSize: bytes, pixelDepth: 0, layerCount: 0, faceCount: 1, supercompressionScheme: 0, globalData: null });
assert.deepEqual(ktx.dataFormatDescriptor, [{
  vendorId: 0, descriptorType: 0, versionNumber: 2, colorModel: 1, colorPrimaries: 0, transferFunction: 1, flags: 0,
  texelBlockDimension: [0, 0, 0, 0], bytesPlane: [bytes, 0, 0, 0, 0, 0, 0, 0],
  samples: [{ bitOffset: 0, bitLength: 8 * bytes - 1, channelType: 0, samplePosition: [0, 0, 0, 0], sampleLower: 0, sampleUpper: 1 }],
}]);
const text = key => {
  const value = Buffer.from(ktx.keyValue[key]).toString();
  assert(value.endsWith('\0'), key);
  return value.slice(0, -1);
};
assert.equal(ktx.keyValue.KTXorientation, 'rd');
assert.match(ktx.keyValue.KTXwriter, /^burnish \d+\.\d+\.\d+$/);
assert.deepEqual(['burnish:format', 'burnish:y'].map(text), ['1', 'up']);
assert.equal(ktx.levels.length, ktx.levelCount);

for (const { id, first, count } of JSON.parse(text('burnish:materials'))) console.log(`material ${id}: ${count} entries from ${first}`);
ktx.levels.forEach(({ levelData, uncompressedByteLength }, l) => {
  const width = Math.max(1, ktx.pixelWidth >> l), height = Math.max(1, ktx.pixelHeight >> l);
  assert.equal(levelData.length, width * height * bytes);
  assert.equal(uncompressedByteLength, levelData.length);
  let hash = 0xcbf29ce484222325n;  // FNV-1a over the indices as 16 bits
  for (let i = 0; i < levelData.length; i += bytes)
    for (const byte of [levelData[i], bytes === 2 ? levelData[i + 1] : 0])
      hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
  console.log(`level ${width}x${height}: ${hash.toString(16).padStart(16, '0')}`);
});
const palette = ktx.keyValue['burnish:palette'];
const view = new DataView(palette.buffer, palette.byteOffset, palette.byteLength);
const rounded = v => (Math.sign(v) * Math.round(Math.abs(v) * 1e4) / 1e4 + 0).toFixed(4);
for (let i = 0; i < palette.byteLength; i += 12)
  console.log([0, 4, 8].map(at => rounded(view.getFloat32(i + at, true))).join(' '));
