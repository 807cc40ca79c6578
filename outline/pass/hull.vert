layout(location = 0) in vec3 position;
layout(location = 1) in vec4 line;      // LineVertex::line
layout(location = 2) in float room_px;  // the widest it may be here

uniform mat4 clip_from_object;
uniform vec2 viewport_px;
uniform float most_push;  // LineVertex::most_push
uniform float largest_factor;
uniform bool soft;  // only the line's last pixel, which fades; else only what is opaque

invariant gl_Position;
out float inside_px;  // how far inside the rim
out float strength;   // below 1 for lines thinner than a pixel

// From under the body's own feather ...
const float under_px = -0.5;

// ... to where the line begins to fade. A line thinner than a pixel keeps a pixel's width and is as faint as it is thin.
float opaque_part_px(float width_px) { return width_px < 1.0 ? under_px : width_px - 0.5; }

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
  float depth = abs(clip.w);
  float drawn_px = min(wished_px(depth) * line.z * largest_factor, room_px);
  strength = min(drawn_px, 1.0);
  float rim_px = max(drawn_px, 1.0) + 0.5;  // half a pixel past the line's edge
  float opaque_px = opaque_part_px(drawn_px);
  bool rim = line.w > 0.5;
  float offset_px = soft ? (rim ? rim_px : opaque_px) : (rim ? opaque_px : under_px);
  clip.xy += line.xy * (most_push * offset_px * 2.0 * depth) / viewport_px;
  // A little farther than the body, whose feather lies over the line's inner edge. Depth is near / Z.
  clip.z *= 0.9998;
  gl_Position = clip;
  inside_px = rim_px - offset_px;
}
