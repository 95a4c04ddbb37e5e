#version 300 es
// A triangle over the whole target, for passes that shade a texture: draw 3 vertices, without any attribute.
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
