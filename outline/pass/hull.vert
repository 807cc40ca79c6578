layout(location = 0) in vec3 position;
layout(location = 1) in vec4 line;  // LineVertex::line

uniform mat4 clip_from_object;
uniform vec2 viewport_px;
uniform float most_push;       // LineVertex::most_push
uniform vec2 width_px;         // the same at any distance, and what is divided by the depth in metres
uniform vec2 width_limits_px;
uniform float largest_factor;
uniform bool soft;             // only the line's last pixel, which fades; else only what is opaque
uniform bool beyond;           // only what factors above 1 add to the base line; else the line without that
uniform float back;            // how much farther away what is added lies, per pixel across: of its depth

invariant gl_Position;
out float inside_px;  // how far inside the rim
out float strength;   // below 1 for lines thinner than a pixel
out float added_px;   // what a factor above 1 adds; large in the line without that

// From under the body's own feather ...
const float under_px = -0.5;

// ... to where the line begins to fade. A line thinner than a pixel keeps a pixel's width and is as faint as it is thin.
float opaque_part_px(float wished_px) { return wished_px < 1.0 ? under_px : wished_px - 0.5; }

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
  float depth = abs(clip.w);
  float factor = line.z * largest_factor;
  float base_px = clamp(width_px.x + width_px.y / depth, width_limits_px.x, width_limits_px.y);
  float plain_px = base_px * min(factor, 1.0);
  float wished_px = beyond ? base_px * max(factor, 1.0) : plain_px;
  strength = min(wished_px, 1.0);
  added_px = beyond ? wished_px - plain_px : 1e3;
  float inner_px = beyond ? opaque_part_px(plain_px) : under_px;
  float rim_px = max(wished_px, 1.0) + 0.5;  // half a pixel past the line's edge
  float opaque_px = opaque_part_px(wished_px);
  bool rim = line.w > 0.5;
  float offset_px = soft ? (rim ? rim_px : opaque_px) : (rim ? opaque_px : inner_px);
  clip.xy += line.xy * (most_push * offset_px * 2.0 * depth) / viewport_px;
  // A little farther than the body, whose feather lies over the line's inner edge. Depth is near / Z.
  clip.z *= 0.9998;
  if (beyond) {
    // What is added leans back: over a surface that lies behind the contour by less, it is hidden.
    clip.z /= 1.0 + back * max(offset_px - plain_px, 0.0);
  }
  gl_Position = clip;
  inside_px = rim_px - offset_px;
}
