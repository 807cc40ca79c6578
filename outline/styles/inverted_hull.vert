layout(location = 0) in vec3 position;
layout(location = 2) in vec4 outline_normal;  // w: rim of a contour strip

uniform mat4 clip_from_object;
uniform float focal_px;  // pixels that an outline normal of length 1 takes at a distance of 1 m
uniform bool soft;       // the hull's own edge, which fades over a pixel; else the hull

out float coverage;
out float strength;      // below 1 for lines thinner than a pixel

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
  float depth = abs(clip.w);
  float wished = wished_px(depth);
  // A line thinner than a pixel keeps a pixel's width and is as faint as it is thin.
  float drawn_px = max(wished, 1.0);
  strength = min(wished, 1.0);
  bool rim = soft && outline_normal.w > 0.5;
  float grown_px = drawn_px + (rim ? 0.5 : -0.5);
  gl_Position = clip + clip_from_object * vec4(outline_normal.xyz, 0.0) * (grown_px * depth / focal_px);
  gl_Position.z *= 0.998;  // where the body is drawn coarser, by up to a pixel
  coverage = rim ? 0.0 : 1.0;
}
