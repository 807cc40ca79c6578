// A square around each pixel in which find_edges.frag found an edge; the others' vertices fall outside.
uniform sampler2D edges;
uniform ivec2 size_px;
uniform float reach_px;

flat out vec2 place;
flat out float strength;
flat out float depth;

void main() {
  ivec2 pixel = ivec2(gl_VertexID % size_px.x, gl_VertexID / size_px.x);
  vec4 edge = texelFetch(edges, pixel, 0);
  place = vec2(pixel) + edge.xy;
  strength = edge.z;
  depth = edge.w;
  gl_PointSize = 2.0 * reach_px + 1.0;
  gl_Position = edge.z > 0.0 ? vec4(2.0 * (vec2(pixel) + 0.5) / vec2(size_px) - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
