uniform vec3 colour;
uniform float strength;  // below 1 for lines thinner than a pixel
in float inside_px;
layout(location = 0) out vec4 fragment;

void main() { fragment = vec4(colour, 1.0) * (min(inside_px, 1.0) * strength); }
