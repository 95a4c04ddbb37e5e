// Reads the files that the tools write, as far as shaders need them. Rows are in the file's order, row 0 at the top.

const text = (bytes) => new TextDecoder().decode(bytes);
const viewOf = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// An indexed normal map: { bytes an index, levels [{ width, height, data }], palette (x y z a normal), materials, space }.
function readKtx2(bytes) {
  const view = viewOf(bytes), u32 = (at) => view.getUint32(at, true), u64 = (at) => Number(view.getBigUint64(at, true));
  const perIndex = { 13: 1, 74: 2 }[u32(12)];  // VK_FORMAT_R8_UINT, VK_FORMAT_R16_UINT
  if (text(bytes.subarray(1, 7)) !== 'KTX 20' || !perIndex || u32(44) !== 0)
    throw Error('expected KTX2 of R8_UINT or R16_UINT without supercompression');
  const levels = [];
  for (let l = 0; l < Math.max(1, u32(40)); l++) {
    const at = u64(80 + 24 * l), size = u64(88 + 24 * l);
    const copy = bytes.slice(at, at + size);
    levels.push({
      width: Math.max(1, u32(20) >> l), height: Math.max(1, u32(24) >> l),
      data: perIndex === 1 ? copy : new Uint16Array(copy.buffer),
    });
  }
  const values = {};
  for (let at = u32(56), end = at + u32(60); at < end;) {
    const size = u32(at), entry = bytes.subarray(at + 4, at + 4 + size), nul = entry.indexOf(0);
    values[text(entry.subarray(0, nul))] = entry.subarray(nul + 1);
    at += 4 + Math.ceil(size / 4) * 4;
  }
  const string = (key) => text(values[key]).replace(/\0$/, '');
  return {
    bytes: perIndex, levels,
    palette: new Float32Array(values['burnish:palette'].slice().buffer),
    materials: JSON.parse(string('burnish:materials')),
    space: string('burnish:space'),
  };
}

// An image of half or float samples: { width, height, channels, half, data (interleaved), attributes }. Scanlines, as they
// are or deflated.
async function readExr(bytes) {
  const view = viewOf(bytes), i32 = (at) => view.getInt32(at, true);
  if (i32(0) !== 20000630 || i32(4) & 0x1a00) throw Error('expected an EXR of one part with scanlines');
  let at = 8;
  const word = () => {
    const end = bytes.indexOf(0, at), out = text(bytes.subarray(at, end));
    at = end + 1;
    return out;
  };
  const attributes = {}, channels = [];
  let compression, width, height;
  for (let name = word(); name; name = word()) {
    const type = word(), size = i32(at), start = at + 4;
    if (type === 'string') attributes[name] = text(bytes.subarray(start, start + size));
    if (type === 'floatvector' || type === 'v2f') {
      attributes[name] = Array.from({ length: size / 4 }, (_, i) => view.getFloat32(start + 4 * i, true));
    }
    if (name === 'compression') compression = bytes[start];
    if (name === 'dataWindow') [width, height] = [i32(start + 8) - i32(start) + 1, i32(start + 12) - i32(start + 4) + 1];
    at = start;
    if (name === 'channels')
      for (let channel = word(); channel; channel = word()) {
        channels.push({ name: channel, half: i32(at) === 1 });
        at += 16;
      }
    at = start + size;
  }
  const lines = { 0: 1, 2: 1, 3: 16 }[compression], half = channels[0].half, sample = half ? 2 : 4;
  if (!lines || channels.some((c) => c.half !== half)) throw Error('expected an EXR of one type of samples, zipped or not');
  const order = channels.map((c) => Math.max('RGBA'.indexOf(c.name), 0));  // Y stands alone
  const data = half ? new Uint16Array(width * height * channels.length) : new Float32Array(width * height * channels.length);
  for (let block = 0, table = at; block * lines < height; block++) {
    const from = Number(view.getBigUint64(table + 8 * block, true)), size = i32(from + 4);
    const first = block * lines, count = Math.min(lines, height - first), whole = count * width * channels.length * sample;
    let raw = bytes.subarray(from + 8, from + 8 + size);
    if (size < whole) raw = unshuffled(await inflated(raw));
    const block_view = viewOf(raw);
    for (let y = 0, place = 0; y < count; y++)
      for (const c of order)
        for (let x = 0; x < width; x++, place += sample)
          data[((first + y) * width + x) * channels.length + c] =
            half ? block_view.getUint16(place, true) : block_view.getFloat32(place, true);
  }
  return { width, height, channels: channels.length, half, data, attributes };
}

// What EXR's ZIP does before it deflates, undone: differences of bytes, and halves of the block interleaved.
function unshuffled(bytes) {
  for (let i = 1; i < bytes.length; i++) bytes[i] += bytes[i - 1] - 128;
  const out = new Uint8Array(bytes.length), half = Math.ceil(bytes.length / 2);
  for (let i = 0; i < bytes.length; i++) out[i] = bytes[(i >> 1) + (i & 1 ? half : 0)];
  return out;
}

// A bitmap as the file has it, no colour management, no multiplied alpha, and what its description says: { bitmap, attributes }.
async function readPng(bytes) {
  let attributes = {};
  const view = viewOf(bytes);
  for (let at = 8; at < bytes.length; at += 12 + view.getUint32(at)) {
    const body = text(bytes.subarray(at + 4, at + 8 + view.getUint32(at)));
    if (body.startsWith('tEXtDescription\0{')) attributes = JSON.parse(body.slice(16));
  }
  const options = { premultiplyAlpha: 'none', colorSpaceConversion: 'none' };
  return { bitmap: await createImageBitmap(new Blob([bytes], { type: 'image/png' }), options), attributes };
}

// An LRGB polynomial texture map as textures: { width, height, abc, def, rgb (three bytes a texel), scale, bias }.
function readPtm(bytes) {
  const words = [];
  let at = 0;
  while (words.length < 16) {  // two names, two sides, twelve numbers, then one byte of white space
    const start = at;
    while (bytes[at] > 32) at++;
    if (at > start) words.push(text(bytes.subarray(start, at)));
    if (words.length < 16) at++;
  }
  at++;
  if (words[0] !== 'PTM_1.2' || words[1] !== 'PTM_FORMAT_LRGB') throw Error('expected PTM_1.2 of PTM_FORMAT_LRGB');
  const [width, height] = words.slice(2, 4).map(Number), texels = width * height;
  const out = { width, height, scale: words.slice(4, 10).map(Number), bias: words.slice(10).map((b) => b / 255) };
  const planes = { abc: [at, 6], def: [at + 3, 6], rgb: [at + 6 * texels, 3] };
  for (const [name, [first, step]] of Object.entries(planes)) {
    out[name] = new Uint8Array(3 * texels);
    for (let t = 0; t < texels; t++) {
      const row = height - 1 - Math.floor(t / width);  // the file has the lowest row first
      for (let c = 0; c < 3; c++) out[name][3 * t + c] = bytes[first + step * (row * width + (t % width)) + c];
    }
  }
  return out;
}

// A mesh with texture coordinates: { positions, normals, tangents, uvs } of its triangles' corners. Maps are in object space, so
// that frames do not matter.
function readObj(bytes) {
  const v = [], vt = [], corners = [];
  for (const line of text(bytes).split('\n')) {
    const [kind, ...rest] = line.trim().split(/\s+/);
    if (kind === 'v') v.push(rest.map(Number));
    if (kind === 'vt') vt.push(rest.map(Number));
    if (kind === 'f') for (let i = 2; i < rest.length; i++) corners.push(rest[0], rest[i - 1], rest[i]);
  }
  const at = (corner, which, list) => list[Number(corner.split('/')[which]) - 1];
  return {
    positions: corners.flatMap((c) => at(c, 0, v)),
    uvs: corners.flatMap((c) => at(c, 1, vt).slice(0, 2)),
    normals: corners.flatMap(() => [0, 0, 1]),
    tangents: corners.flatMap(() => [1, 0, 0, 1]),
  };
}
