// How much of a pixel the line along an edge covers (x), the edge's depth (y), and how near it is (z, 8 less its distance
// in pixels). Of all edges around, blending leaves the most.
uniform float radius_px;

flat in vec2 place;
flat in float strength;
flat in float depth;
layout(location = 0) out vec4 line;

void main() {
  float px = distance(gl_FragCoord.xy, place);
  float part = clamp(radius_px - px + 0.5, 0.0, 1.0) * strength;
  if (part <= 0.0) discard;
  line = vec4(part, depth, max(8.0 - px, 0.0), 1.0);
}
