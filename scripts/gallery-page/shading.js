// Draws a scene with the shaders of samples/glsl. A scene has the keys of samples/README.md, with the contents of files in
// `files`, { name, bytes } each, in place of their names:
//
//   { path, background, ambient, camera, lights, object: { surface, …, filter, mip }, material, files }

const kTableWidth = 256;  // of colour tables and palettes
const kTable = { filter: 'linear', wrap: 'clamp' };  // how lookup tables are sampled

class Scene {
  // `shaders`: the text of each file by its name. `antialias` is for eyes; comparisons do without.
  static async load(canvas, shaders, scene, { antialias = true } = {}) {
    const gl = canvas.getContext('webgl2', { antialias, alpha: false, preserveDrawingBuffer: true });
    if (!gl) throw Error('there is no WebGL 2');
    gl.getExtension('EXT_color_buffer_float');
    gl.getExtension('OES_texture_float_linear');
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    const self = new Scene();
    Object.assign(self, { gl, shaders, scene });
    self.mesh = self.#upload(surfaces[scene.object.surface ?? 'quad']({ ...scene.object, file: scene.files.mesh }));
    await self.#load();
    return self;
  }

  // `changes` go over the scene's own keys.
  draw(changes = {}) {
    const { gl } = this, scene = { ...this.scene, ...changes };
    const view = camera(scene.camera ?? {}, gl.drawingBufferWidth / gl.drawingBufferHeight);
    if (this.table) this.#shadeTable(scene, view);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
    gl.clearColor(...(scene.background ?? [0, 0, 0]).map(srgb), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.program);
    gl.bindVertexArray(this.mesh.array);
    const lights = scene.lights.map((l) => (l.position ? [...l.position, 1] : [...unit(l.direction), 0]));
    this.#set(this.program, {
      model: modelMatrix(scene.object), view_projection: view.matrix, viewer: view.viewer,
      light_count: lights.length, lights: lights.flat(), light_colors: scene.lights.flatMap((l) => l.color ?? [1, 1, 1]),
      ambient: scene.ambient ?? [0, 0, 0], ...constants(scene.material ?? {}), ...this.uniforms,
    });
    this.#bind(this.program, this.textures);
    gl.drawArrays(gl.TRIANGLES, 0, this.mesh.corners);
  }

  // The colour table of a palette, N × RGB, linear.
  colorTable() {
    const { gl, table } = this, pixels = new Float32Array(kTableWidth * table.rows * 4);
    gl.bindFramebuffer(gl.FRAMEBUFFER, table.target);
    gl.readPixels(0, 0, kTableWidth, table.rows, gl.RGBA, gl.FLOAT, pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return Array.from({ length: table.entries }, (_, i) => pixels.slice(4 * i, 4 * i + 3));
  }

  // Program, textures and uniforms of the path.
  async #load() {
    const { path } = this.scene;
    this.textures = {};
    this.uniforms = {};
    const { shader, defines } = await (
      path === 'palette' ? this.#loadPalette(this.scene)
      : path === 'normal-map' ? this.#loadNormalMap(this.scene)
      : path.startsWith('strand') ? this.#loadStrand(this.scene)
      : path.startsWith('ptm') ? this.#loadPtm(this.scene)
      : this.#loadMaterial(this.scene));
    this.program = this.#program('surface.vert', `${shader}.frag`, defines);
  }

  async #loadPalette({ files, object }) {
    const map = readKtx2(files.indexed_map.bytes), blend = object.blend ?? (files.base_color ? 'exact' : 'material');
    const blended = blend !== 'material';
    this.#prepareTable(map, blended ? '#define BLENDED\n' : '');
    Object.assign(this.textures, { index_map: this.#indexTexture(map), color_table: this.table.texture });
    if (blended) await this.#takeBase();
    this.uniforms = { bilinear: object.filter === 'bilinear', levels: object.mip === 'linear' ? map.levels.length : 1 };
    return { shader: 'palette', defines: blended ? `#define ${blend.toUpperCase()}\n` : '' };
  }

  async #loadNormalMap({ files, object }) {
    await this.#take('normal_map', files.normal_map);
    this.uniforms.object_space = object.normal_space === 'object';
    return { shader: 'normal_map' };
  }

  async #loadStrand({ path, files }) {
    const bumpy = path.startsWith('strand-bump');
    await this.#take('direction_map', files.direction_map);
    if (bumpy) await this.#take('normal_map', files.normal_map);
    await this.#takeBase();
    await this.#take('strand', files.strand, { filter: 'linear', wrap: bumpy ? 'clamp' : 'repeat' });
    return { shader: bumpy ? 'strand_bump' : 'strand' };
  }

  async #loadPtm({ path, files }) {
    if (files.light_factor) await this.#take('light_factor', files.light_factor, kTable);
    else this.textures.light_factor = this.#white();
    if (files.map) {
      this.#takePtm(readPtm(files.map.bytes));
      return { shader: 'ptm_lrgb' };
    }
    const { parameters } = await this.#takePtmTextures(files, path === 'ptm-brdf' ? kTable : {});
    return { shader: path === 'ptm-brdf' ? 'ptm_brdf' : 'ptm_rgb', defines: parameters === 'light-view' ? '#define LIGHT_VIEW\n' : '' };
  }

  async #loadMaterial({ path, files }) {
    for (const which of ['t', 'b', 'n']) {
      const { attributes } = await this.#take(`${which}_map`, files[which]);
      const numbers = (key, otherwise) => Object.assign([0, 0, 0, 0].fill(otherwise), attributes[key]);
      this.uniforms[`${which}_scale`] = numbers('burnish:scale', 1);
      this.uniforms[`${which}_bias`] = numbers('burnish:bias', 0);
    }
    await this.#takeBase();
    for (const name of ['banks_r', 'blinn_phong_f', 'ward_s', 'ward_e']) if (files[name]) await this.#take(name, files[name], kTable);
    if (path === 'banks-approximate') return { shader: 'banks', defines: '#define APPROXIMATE\n' };
    if (path === 'blinn-phong-eq1') return { shader: 'blinn_phong', defines: '#define EQUATION_1\n' };
    return { shader: path.replace('-', '_') };
  }

  // A file's texture, filtered as the scene's object says unless `options` do, with what shaders want to know of it.
  async #take(name, file, options = {}) {
    const taken = await this.#texture(file, { filter: this.filter, ...options });
    this.textures[name] = taken.texture;
    this.uniforms[`${name.replace('_map', '')}_coding`] = taken.coding;
    this.uniforms[`${name}_domain`] = taken.domain;
    return taken;
  }

  async #takeBase() {
    if (this.scene.files.base_color) await this.#take('base_color', this.scene.files.base_color, { srgb: true });
    else this.textures.base_color = this.#white();
  }

  get filter() { return this.scene.object.filter === 'bilinear' ? 'linear' : 'nearest'; }

  #program(vertex, fragment, defines = '') {
    const { gl } = this, program = gl.createProgram();
    for (const [type, name] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type), [version, ...rest] = this.shaders[name].split('\n');
      gl.shaderSource(shader, `${version}\n${type === gl.FRAGMENT_SHADER ? defines : ''}${rest.join('\n')}`);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw Error(`${fragment}: ${gl.getProgramInfoLog(program)}`);
    return program;
  }

  #upload({ positions, normals, tangents, uvs }) {
    const { gl } = this, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    for (const [location, data, size] of [[0, positions, 3], [1, normals, 3], [2, tangents, 4], [3, uvs, 2]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.STATIC_DRAW);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, gl.FLOAT, false, 0, 0);
    }
    return { array, corners: positions.length / 3 };
  }

  // Each uniform by its declared type; samplers are those of #bind.
  #set(program, values) {
    const { gl } = this;
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name, type } = gl.getActiveUniform(program, i), value = values[name.replace('[0]', '')];
      if ([gl.SAMPLER_2D, gl.UNSIGNED_INT_SAMPLER_2D].includes(type)) continue;
      if (value === undefined) throw Error(`nothing is known of ${name}`);
      const at = gl.getUniformLocation(program, name);
      if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(at, false, value);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(at, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(at, value);
      else if (type === gl.FLOAT_VEC2) gl.uniform2fv(at, value);
      else if (type === gl.FLOAT) gl.uniform1f(at, value);
      else if (type === gl.INT_VEC2) gl.uniform2iv(at, value);
      else gl.uniform1i(at, value);
    }
  }

  // A texture, or a list of them, for each sampler.
  #bind(program, textures) {
    const { gl } = this;
    let unit = 0;
    for (const [name, texture] of Object.entries(textures)) {
      const at = gl.getUniformLocation(program, name), all = [texture].flat();
      if (at) gl.uniform1iv(at, all.map((_, i) => unit + i));
      for (const one of all) {
        gl.activeTexture(gl.TEXTURE0 + unit++);
        gl.bindTexture(gl.TEXTURE_2D, one);
      }
    }
  }

  #newTexture(filter, wrap = 'repeat') {
    const { gl } = this, texture = gl.createTexture(), set = (key, value) => gl.texParameteri(gl.TEXTURE_2D, key, value);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const key of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) set(key, filter === 'linear' ? gl.LINEAR : gl.NEAREST);
    for (const key of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) set(key, wrap === 'repeat' ? gl.REPEAT : gl.CLAMP_TO_EDGE);
    return texture;
  }

  // { texture, attributes, coding (scale and bias of vectors), domain } of an EXR or PNG.
  async #texture({ name, bytes }, { filter, wrap, srgb = false }) {
    const { gl } = this;
    if (name.endsWith('.exr')) {
      const image = await readExr(bytes), texture = this.#newTexture(filter, wrap);
      const type = image.half ? 'half' : 'float', [internal, format] = {
        half: { 1: [gl.R16F, gl.RED], 3: [gl.RGB16F, gl.RGB], 4: [gl.RGBA16F, gl.RGBA] },
        float: { 1: [gl.R32F, gl.RED], 3: [gl.RGB32F, gl.RGB], 4: [gl.RGBA32F, gl.RGBA] },
      }[type][image.channels];
      gl.texImage2D(gl.TEXTURE_2D, 0, internal, image.width, image.height, 0, format, image.half ? gl.HALF_FLOAT : gl.FLOAT, image.data);
      const domain = image.attributes['burnish:domain'];
      return { texture, attributes: image.attributes, coding: [1, 0], domain: domain && [...domain, 0, 1].slice(0, 4) };
    }
    const { bitmap, attributes } = await readPng(bytes), texture = this.#newTexture(filter, wrap);
    gl.texImage2D(gl.TEXTURE_2D, 0, srgb ? gl.SRGB8_ALPHA8 : gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
    return { texture, attributes, coding: [2, -1] };
  }

  #white() {
    const { gl } = this, texture = this.#newTexture('nearest');
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([255, 255, 255, 255]));
    return texture;
  }

  #indexTexture({ bytes, levels }) {
    const { gl } = this, texture = this.#newTexture('nearest');
    const [internal, type] = bytes === 1 ? [gl.R8UI, gl.UNSIGNED_BYTE] : [gl.R16UI, gl.UNSIGNED_SHORT];
    gl.texStorage2D(gl.TEXTURE_2D, levels.length, internal, levels[0].width, levels[0].height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST_MIPMAP_NEAREST);
    levels.forEach(({ width, height, data }, l) => gl.texSubImage2D(gl.TEXTURE_2D, l, 0, 0, width, height, gl.RED_INTEGER, type, data));
    return texture;
  }

  #prepareTable({ palette, materials }, defines) {
    const { gl } = this, entries = palette.length / 3, rows = Math.ceil(entries / kTableWidth);
    const padded = new Float32Array(3 * kTableWidth * rows);
    padded.set(palette);
    const normals = this.#newTexture('nearest');
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB32F, kTableWidth, rows, 0, gl.RGB, gl.FLOAT, padded);
    const texture = this.#newTexture('nearest'), target = gl.createFramebuffer();
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, kTableWidth, rows, 0, gl.RGBA, gl.HALF_FLOAT, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw Error('half floats cannot be rendered to here');
    this.table = { entries, rows, normals, texture, target, materials, program: this.#program('screen.vert', 'palette_table.frag', defines) };
  }

  // Light and view as they are at the object's origin, in the object's space.
  #shadeTable(scene, { viewer }) {
    const { gl, table } = this, columns = rotation(scene.object.rotate_deg), origin = scene.object.translate ?? [0, 0, 0];
    const local = (d) => { const l = unit(d); return columns.map((c) => dot(c, l)); };
    const seen = ([x, y, z, w]) => local(add([x, y, z], times(origin, -w)));
    gl.bindFramebuffer(gl.FRAMEBUFFER, table.target);
    gl.viewport(0, 0, kTableWidth, table.rows);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.useProgram(table.program);
    gl.bindVertexArray(this.nothing ??= gl.createVertexArray());
    this.#bind(table.program, { palette: table.normals });
    const lights = scene.lights.map((l) => (l.position ? [...l.position, 1] : [...l.direction, 0]));
    for (const { id, first, count } of table.materials) {
      const material = [scene.material ?? {}].flat();
      this.#set(table.program, {
        entries: [first, count], viewer: seen(viewer), light_count: lights.length, lights: lights.flatMap(seen),
        light_colors: scene.lights.flatMap((l) => l.color ?? [1, 1, 1]), ambient: scene.ambient ?? [0, 0, 0],
        ...constants(material.find((m) => m.id === id) ?? material[0]),
      });
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
  }

  #takePtm({ width, height, scale, bias, ...planes }) {
    const { gl } = this;
    for (const name of ['abc', 'def', 'rgb']) {
      this.textures[name] = this.#newTexture(this.filter);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, width, height, 0, gl.RGB, gl.UNSIGNED_BYTE, planes[name]);
    }
    Object.assign(this.uniforms, {
      abc_scale: scale.slice(0, 3), def_scale: scale.slice(3), abc_bias: bias.slice(0, 3), def_bias: bias.slice(3),
    });
  }

  // Six PNG and their ptm.json, which comes back.
  async #takePtmTextures(files, options) {
    for (const which of ['abc', 'def']) {
      this.textures[which] = [];
      for (const colour of ['red', 'green', 'blue']) {
        const { texture } = await this.#texture(files[`${which}_${colour}`], { filter: this.filter, ...options });
        this.textures[which].push(texture);
      }
    }
    const json = JSON.parse(text(files.ptm.bytes));
    for (const key of ['abc_scale', 'abc_bias', 'def_scale', 'def_bias', 'noise_factor']) this.uniforms[key] = json[key];
    return json;
  }
}

function srgb(c) {
  c = Math.min(Math.max(c, 0), 1);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
}

// A material's colours as shaders name them, with the defaults of scenes.
function constants({ model, diffuse = [1, 1, 1], specular, ambient = diffuse, exponent = 20 }) {
  const specular_color = specular ?? (model === 'lambert' ? [0, 0, 0] : [0.5, 0.5, 0.5]);
  return { ambient_color: ambient, diffuse_color: diffuse, specular_color, exponent };
}
