uniform vec3 colour;
in float inside_px;
in float strength;
layout(location = 0) out vec4 fragment;

void main() { fragment = vec4(colour, 1.0) * (min(inside_px, 1.0) * strength); }
