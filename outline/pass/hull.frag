uniform vec3 colour;
uniform bool soft;
in float inside_px;
in float strength;
in float added_px;
layout(location = 0) out vec4 fragment;

void main() {
  float ink = min(inside_px, 1.0) * strength;
  // Where nearly nothing is added, the base line's own last pixel is all there should be.
  if (soft) ink *= smoothstep(0.0, 0.4, added_px);
  fragment = vec4(colour, 1.0) * ink;
}
