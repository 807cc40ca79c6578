layout(location = 0) in vec3 position;
layout(location = 2) in vec4 outline_normal;

uniform vec2 offset_px;  // of the surface or the edge, and of the rim

invariant gl_Position;
#ifdef FEATHER
uniform float edge_coverage;  // at the edge; 0 at the rim
out float coverage;
#endif

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
#ifdef FEATHER
  bool rim = outline_normal.w > 0.5;
  gl_Position = pushed(clip, outline_normal.xyz, rim ? offset_px.y : offset_px.x, 0.0);
  coverage = rim ? 0.0 : edge_coverage;
#else
  gl_Position = pushed(clip, outline_normal.xyz, offset_px.x, 1.0);
#endif
}
