// Lays the lines that spread_edges.frag made over the object, or behind it.
uniform sampler2D lines;
uniform sampler2D surface_depth;  // twice as fine, with a margin of two texels
uniform ivec2 origin;             // of the lines' rectangle within the viewport
uniform float strength;           // below 1 for lines thinner than a pixel
uniform vec3 colour;

layout(location = 0) out vec4 fragment;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy) - origin;
  vec4 line = texelFetch(lines, here, 0);
  if (line.x == 0.0) discard;
  float depth = line.y, nearest = 0.0, inside = 0.0;
  for (int i = 0; i < 4; ++i) {
    float d = texelFetch(surface_depth, 2 * here + ivec2(i & 1, i >> 1) + 2, 0).x;
    nearest = max(nearest, d);
    inside += d > 0.0 ? 0.25 : 0.0;
  }
#ifdef OUTSIDE
  // Under the body and its soft edge, and nowhere before it.
  if (inside > 0.9 && line.z < 7.0) discard;
  depth *= inside > 0.4 ? 0.5 : 0.9998;
#else
  // Before the surface on which half of it lies.
  depth = min(max(depth, nearest) * 1.002, 1.0);
#endif
  gl_FragDepth = depth;
  fragment = vec4(colour, 1.0) * (line.x * strength);
}
