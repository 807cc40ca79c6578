layout(location = 0) in vec3 position;
layout(location = 1) in vec2 push_px;
layout(location = 2) in vec2 along_px;
layout(location = 3) in vec3 line;  // half the width and the way to the line's end in pixels, strength

uniform mat4 clip_from_object;
uniform vec2 viewport_px;
uniform sampler2D own_depth;  // of the object alone: near / Z, one texel a pixel
uniform ivec2 origin;         // of own_depth within the viewport
uniform ivec2 last_pixel;

out vec2 along;
out float half_px;
out float to_end_px;
out float strength_here;
out float shown;              // 1 where nothing of the object hides the line
out float middle_depth;

// Whether the object itself is nowhere around as far away as the place.
bool is_hidden(vec2 pixel, float depth) {
  ivec2 at = ivec2(floor(pixel)) - origin;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      ivec2 t = at + ivec2(x, y);
      if (any(lessThan(t, ivec2(0))) || any(greaterThan(t, last_pixel))) return false;
      if (texelFetch(own_depth, t, 0).x <= depth * 1.0005) return false;
    }
  }
  return true;
}

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
  float w = abs(clip.w);
  middle_depth = clip.z / w;
  shown = is_hidden((clip.xy / w * 0.5 + 0.5) * viewport_px, middle_depth) ? 0.0 : 1.0;
  clip.xy += push_px * 2.0 * w / viewport_px;
  gl_Position = clip;
  along = along_px;
  half_px = line.x;
  to_end_px = line.y;
  strength_here = line.z;
}
