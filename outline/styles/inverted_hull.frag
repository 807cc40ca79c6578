uniform vec3 colour;
in float coverage;
in float strength;
layout(location = 0) out vec4 fragment;

void main() { fragment = vec4(colour, 1.0) * (coverage * strength); }
