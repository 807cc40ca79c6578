// Lines of a given width along the edges that find_edges.frag found.
uniform sampler2D edges;
uniform sampler2D surface_depth;  // twice as fine
uniform ivec2 origin;             // of the edges' rectangle within the viewport
uniform ivec2 last_pixel;
uniform float line_px;            // the line's width
uniform int reach_px;             // how far to look
uniform vec3 colour;

layout(location = 0) out vec4 fragment;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy) - origin;
  vec2 centre = vec2(here) + 0.5;
  float drawn_px = max(line_px, 1.0);
#ifdef OUTSIDE
  float radius_px = drawn_px;
#elif defined(BOTH_SIDES)
  float radius_px = max(0.5 * drawn_px - 0.3, 0.3);  // an edge was found on both its sides
#else
  float radius_px = 0.5 * drawn_px;
#endif
  float coverage = 0.0, depth = 0.0, least_px = 1e6;
  ivec2 low = max(here - reach_px, ivec2(0)), high = min(here + reach_px, last_pixel);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      vec4 edge = texelFetch(edges, ivec2(x, y), 0);
      if (edge.z == 0.0) continue;
      float px = distance(centre, vec2(x, y) + edge.xy);
      least_px = min(least_px, px);
      float part = clamp(radius_px - px + 0.5, 0.0, 1.0) * edge.z;
      if (part > 0.0) depth = max(depth, edge.w);
      coverage = max(coverage, part);
    }
  }
  if (coverage == 0.0) discard;
#ifdef OUTSIDE
  // Under the body and its soft edge, and nowhere before it.
  float inside = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 t = clamp(2 * here + ivec2(i & 1, i >> 1), ivec2(0), 2 * last_pixel + 1);
    inside += texelFetch(surface_depth, t, 0).x > 0.0 ? 0.25 : 0.0;
  }
  if (inside > 0.9 && least_px > 1.0) discard;
  depth *= inside > 0.4 ? 0.5 : 0.9998;
#else
  // Before the surface on which half of it lies.
  for (int i = 0; i < 4; ++i) {
    ivec2 t = clamp(2 * here + ivec2(i & 1, i >> 1), ivec2(0), 2 * last_pixel + 1);
    depth = max(depth, texelFetch(surface_depth, t, 0).x);
  }
  depth = min(depth * 1.002, 1.0);
#endif
  gl_FragDepth = depth;
  fragment = vec4(colour, 1.0) * (coverage * min(line_px, 1.0));
}
