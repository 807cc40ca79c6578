// A stroke's quad, one instance a stroke.
layout(location = 0) in vec4 line;     // middle, half the way to the end; pixels of the pinhole picture
layout(location = 1) in vec3 how;      // half the width in pixels, layer of the brush sheet, depth in metres
layout(location = 2) in vec4 colour;

uniform vec2 rect_px;  // the target's first pixel
uniform vec2 size_px;

uniform float near_m;  // depth is near / Z

#ifdef OWN_BRUSHES
layout(location = 3) in vec4 blend;
flat out vec4 shares;
#endif

flat out vec4 paint;
noperspective out vec3 on_brush;

void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  vec2 along = line.zw;
  vec2 across = vec2(-along.y, along.x) * (how.x / max(length(along), 1e-6));
  vec2 pixel = line.xy + along * corner.x + across * corner.y;
  // A little nearer than the water it lies on.
  gl_Position = vec4((pixel - rect_px + 0.5) / size_px * 2.0 - 1.0, near_m / how.z * 1.001, 1.0);
#ifdef OWN_BRUSHES
  shares = blend;
#endif
  paint = colour;
  on_brush = vec3(corner * 0.5 + 0.5, how.y);
}
