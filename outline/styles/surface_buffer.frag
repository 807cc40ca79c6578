in vec3 seen_normal;
layout(location = 0) out vec4 fragment;

void main() {
  vec3 n = normalize(seen_normal);
  if (!gl_FrontFacing) n = -n;
  fragment = vec4(0.5 * n + 0.5, 1.0);
}
