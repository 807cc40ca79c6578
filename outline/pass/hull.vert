layout(location = 0) in vec3 position;
layout(location = 2) in vec4 outline_normal;

uniform vec2 offset_px;    // of the edge and of the rim
uniform float breadth_px;  // from the one to the other

invariant gl_Position;
out float inside_px;  // how far inside the rim

void main() {
  bool rim = outline_normal.w > 0.5;
  vec4 clip = clip_from_object * vec4(position, 1.0);
  gl_Position = pushed(clip, outline_normal.xyz, rim ? offset_px.y : offset_px.x, 0.0);
  // A little farther than the body, whose feather lies over the line's inner edge. Depth is near / Z.
  gl_Position.z *= 0.9998;
  inside_px = rim ? 0.0 : breadth_px;
}
