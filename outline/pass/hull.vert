layout(location = 0) in vec3 position;
layout(location = 1) in vec4 line;  // LineVertex::line

uniform mat4 clip_from_object;
uniform vec2 viewport_px;
uniform float most_push;       // LineVertex::most_push
uniform vec2 width_px;         // the same at any distance, and what is divided by the depth in metres
uniform vec2 width_limits_px;
uniform float largest_factor;
uniform bool soft;             // only the line's last pixel, which fades; else only what is opaque

invariant gl_Position;
out float inside_px;  // how far inside the rim
out float strength;   // below 1 for lines thinner than a pixel

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
  float depth = abs(clip.w);
  float wished_px = clamp(width_px.x + width_px.y / depth, width_limits_px.x, width_limits_px.y) *
                    line.z * largest_factor;
  // A line thinner than a pixel keeps a pixel's width and is as faint as it is thin.
  float drawn_px = max(wished_px, 1.0);
  strength = min(wished_px, 1.0);
  // From under the body's own feather to half a pixel past the line's edge.
  const float under_px = -0.5;
  float rim_px = drawn_px + 0.5;
  float opaque_px = wished_px < 1.0 ? under_px : drawn_px - 0.5;
  bool rim = line.w > 0.5;
  float offset_px = soft ? (rim ? rim_px : opaque_px) : (rim ? opaque_px : under_px);
  clip.xy += line.xy * (most_push * offset_px * 2.0 * depth) / viewport_px;
  // A little farther than the body, whose feather lies over the line's inner edge. Depth is near / Z.
  clip.z *= 0.9998;
  gl_Position = clip;
  inside_px = rim_px - offset_px;
}
