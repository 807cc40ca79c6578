// A corner of a stroke's quad.
layout(location = 0) in vec3 place;  // pixel of the pinhole picture, depth in metres
layout(location = 1) in vec2 brush;  // in the atlas
layout(location = 2) in vec4 colour;

uniform vec2 rect_px;  // the target's first pixel
uniform vec2 size_px;

uniform float near_m;  // depth is near / Z

#ifdef OWN_BRUSHES
layout(location = 3) in vec4 blend;
layout(location = 4) in float step_to_next;  // brush of the atlas
flat out vec4 shares;
flat out float next_brush;
#endif

flat out vec4 paint;
noperspective out vec2 on_brush;

void main() {
  // A little nearer than the water it lies on.
  gl_Position = vec4((place.xy - rect_px + 0.5) / size_px * 2.0 - 1.0, near_m / place.z * 1.001, 1.0);
#ifdef OWN_BRUSHES
  shares = blend;
  next_brush = step_to_next;
#endif
  paint = colour;
  on_brush = brush;
}
