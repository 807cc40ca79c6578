uniform vec3 colour;
uniform bool feather;
uniform float threshold;  // of the cosine to the line of sight, under which there is line

in vec3 seen_normal;
in vec3 seen_from;
in float coverage;
layout(location = 0) out vec4 fragment;

void main() {
  float cosine = abs(dot(normalize(seen_normal), normalize(seen_from)));
  // The surface is drawn up to half a pixel too far inwards, by how much it stands on edge.
  vec2 slope = vec2(dFdx(cosine), dFdy(cosine));
  if (!feather) cosine += 0.5 * sqrt(max(1.0 - cosine * cosine, 0.0)) * length(slope);
  float line = clamp((threshold - cosine) / max(length(slope), 1e-6) + 0.5, 0.0, 1.0);
  // The body's own feather, which comes later, stays away from where this one is.
  if (feather && line < 0.5) discard;
  fragment = vec4(colour, 1.0) * (line * min(coverage, 1.0));
}
