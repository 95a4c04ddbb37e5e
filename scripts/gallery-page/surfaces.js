// The surfaces and cameras of scenes, as samples/README.md has them, for a vertex shader.

const add = (a, b) => a.map((x, i) => x + b[i]);
const times = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(a, 1 / Math.hypot(...a));

// A patch of columns × rows quads; `at(s, t)` gives { position, normal, tangent, uv } for s and t from 0 to 1.
function patch(columns, rows, at) {
  const out = { positions: [], normals: [], tangents: [], uvs: [] };
  const corner = (i, j) => {
    const p = at(i / columns, j / rows);
    out.positions.push(...p.position);
    out.normals.push(...p.normal);
    out.tangents.push(...p.tangent, 1);
    out.uvs.push(...p.uv);
  };
  for (let j = 0; j < rows; j++)
    for (let i = 0; i < columns; i++) for (const [a, b] of [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]) corner(i + a, j + b);
  return out;
}

const surfaces = {
  quad({ size = [1, 1], repeat = [1, 1] }) {
    return patch(1, 1, (s, t) => ({
      position: [(s - 0.5) * size[0], (t - 0.5) * size[1], 0], normal: [0, 0, 1], tangent: [1, 0, 0], uv: [s * repeat[0], t * repeat[1]],
    }));
  },
  sphere({ radius = 0.5 }) {
    return patch(192, 96, (s, t) => {
      const l = (s - 0.5) * 2 * Math.PI, f = (t - 0.5) * Math.PI;
      const n = [Math.sin(l) * Math.cos(f), Math.sin(f), Math.cos(l) * Math.cos(f)];
      return { position: times(n, radius), normal: n, tangent: [Math.cos(l), 0, -Math.sin(l)], uv: [s, t] };
    });
  },
  torus({ radius = 0.35, tube_radius = 0.15 }) {
    return patch(256, 128, (s, t) => {
      const l = s * 2 * Math.PI, f = t * 2 * Math.PI, out = [Math.cos(l), Math.sin(l), 0];
      const n = add(times(out, Math.cos(f)), [0, 0, Math.sin(f)]);
      return { position: add(times(out, radius), times(n, tube_radius)), normal: n, tangent: [-out[1], out[0], 0], uv: [s, t] };
    });
  },
  mesh: ({ file }) => readObj(file.bytes),
};

// Columns of a turn about x, then y, then z.
function rotation(degrees = [0, 0, 0]) {
  const [x, y, z] = degrees.map((d) => (d * Math.PI) / 180);
  const turn = ([a, b, c]) => {
    [b, c] = [b * Math.cos(x) - c * Math.sin(x), b * Math.sin(x) + c * Math.cos(x)];
    [c, a] = [c * Math.cos(y) - a * Math.sin(y), c * Math.sin(y) + a * Math.cos(y)];
    return [a * Math.cos(z) - b * Math.sin(z), a * Math.sin(z) + b * Math.cos(z), c];
  };
  return [turn([1, 0, 0]), turn([0, 1, 0]), turn([0, 0, 1])];
}

// A model matrix by columns, from `rotate_deg`, `scale` (a number) and `translate`.
function modelMatrix({ rotate_deg, scale = 1, translate = [0, 0, 0] }) {
  return [...rotation(rotate_deg).flatMap((column) => [...times(column, scale), 0]), ...translate, 1];
}

// { matrix: view and projection by columns, viewer: what shaders take }.
function camera({ type = 'orthographic', position = [0, 0, 2], look_at = [0, 0, 0], up = [0, 1, 0], height = 1, fov_deg = 40 }, aspect) {
  const forward = unit(add(look_at, times(position, -1))), right = unit(cross(forward, up)), upward = cross(right, forward);
  const near = 0.05, far = 50;
  const row = (axis, s) => [...times(axis, s), -dot(axis, position) * s];
  const perspective = type === 'perspective';
  const y = perspective ? 1 / Math.tan((fov_deg * Math.PI) / 360) : 2 / height;
  const depth = row(forward, 1);
  const rows = perspective
    ? [row(right, y / aspect), row(upward, y),
       add(times(depth, (far + near) / (far - near)), [0, 0, 0, (-2 * far * near) / (far - near)]), depth]
    : [row(right, y / aspect), row(upward, y), add(times(depth, 2 / (far - near)), [0, 0, 0, -(far + near) / (far - near)]), [0, 0, 0, 1]];
  return {
    matrix: [0, 1, 2, 3].flatMap((column) => rows.map((r) => r[column])),
    viewer: perspective ? [...position, 1] : [...times(forward, -1), 0],
  };
}
