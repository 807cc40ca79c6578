layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 outline_normal;
#ifdef TEXTURED
layout(location = 3) in vec2 uv;
#endif
#ifdef VERTEX_COLOURS
layout(location = 4) in vec4 colour;
#endif

#ifdef BORDER
layout(location = 5) in vec4 across;  // and how far, in pixels
#endif

uniform mat3 world_from_normal;
uniform vec2 offset_px;  // of the edge and of the rim

invariant gl_Position;
#ifdef LIT
uniform vec3 light;  // unit, towards the light, in the world
uniform float bands;
#ifdef EVEN
uniform float last_band;
flat out float level;
#elif defined(FINE)
out float brightness;
#else
out vec3 world_normal;
#endif
#endif
#ifdef TEXTURED
out vec2 texture_position;
#endif
#ifdef VERTEX_COLOURS
out vec4 vertex_colour;
#endif
#ifdef FEATHER
uniform float edge_coverage;  // at the edge: 1, and more where the feather reaches further in; 0 at the rim
out float coverage;
#endif

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
#ifdef BORDER
  bool rim = outline_normal.w > 0.5;
  // From where the surface is drawn. At the edge, where the other surface's quad begins with its share, coverage falls by
  // 1 a pixel.
  clip = moved(pushed(clip, outline_normal.xyz, offset_px.x, 1.0), across.xyz, rim ? across.w : 0.0);
  coverage = rim ? 0.0 : across.w;
  clip.z *= 1.0003;  // before the triangle that it lies on. Depth is near / Z
#elif defined(FEATHER)
  bool rim = outline_normal.w > 0.5;
  // As far to either side of the true edge, however the normal lies. The surface, which is pulled in by less where its
  // normal is not at right angles to the line of sight, only reaches over the feather's strong part.
  clip = pushed(clip, outline_normal.xyz, rim ? offset_px.y : offset_px.x, 0.0);
  coverage = rim ? 0.0 : edge_coverage;
#else
  clip = pushed(clip, outline_normal.xyz, offset_px.x, 1.0);
#endif
  gl_Position = clip;
#ifdef LIT
#if defined(EVEN) || defined(FINE)
  // Half Lambert: bands share the whole sphere, also the side away from the light.
  float lit = (dot(normalize(world_from_normal * normal), light) * 0.5 + 0.5) * bands;
#ifdef EVEN
  level = clamp(floor(lit), 0.0, last_band);
#else
  brightness = lit;
#endif
#else
  world_normal = world_from_normal * normal;
#endif
#endif
#ifdef TEXTURED
  texture_position = uv;
#endif
#ifdef VERTEX_COLOURS
  vertex_colour = colour;
#endif
}
