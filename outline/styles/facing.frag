uniform vec3 colour;
uniform float threshold;  // of the cosine to the line of sight, under which there is line

in vec3 seen_normal;
in vec3 seen_from;
in float coverage;
layout(location = 0) out vec4 fragment;

void main() {
  float cosine = abs(dot(normalize(seen_normal), normalize(seen_from)));
  float line = clamp((threshold - cosine) / max(fwidth(cosine), 1e-6) + 0.5, 0.0, 1.0);
  fragment = vec4(colour, 1.0) * (line * min(coverage, 1.0));
}
