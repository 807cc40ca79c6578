// Pushes a vertex across the screen, away from the surface, along its outline normal.

uniform mat4 clip_from_object;
uniform vec2 viewport_px;
uniform float focal_px;  // pixels that an outline normal of length 1 takes at a distance of 1 m

// The clip position moved by `distance_px` in the direction in which the outline normal points on the screen.
// With `by_slope` 1 the distance shrinks with the normal's length on the screen, so that only what lies near the contour
// moves; with 0 all vertices move by as much.
vec4 pushed(vec4 clip, vec3 outline_normal, float distance_px, float by_slope) {
  vec4 n = clip_from_object * vec4(outline_normal, 0.0);
  // How the pixel moves when the vertex moves along its normal, times w squared.
  vec2 d = (n.xy * clip.w - clip.xy * n.w) * viewport_px;
  float len = length(d);
  // A normal at right angles to the line of sight moves the pixel by focal / w; d is twice that, times w squared.
  float slope = min(len / (2.0 * focal_px * abs(clip.w)), 1.0);
  vec2 direction = len > 0.0 ? d / len : vec2(0.0);
  clip.xy += direction * (distance_px * mix(1.0, slope, by_slope) * 2.0 * abs(clip.w)) / viewport_px;
  return clip;
}

// The clip position of a point that lies `distance_px` away on the screen in a direction within the object, not more
// than four times as far as where the direction is seen at right angles.
vec4 moved(vec4 clip, vec3 direction, float distance_px) {
  vec4 n = clip_from_object * vec4(direction, 0.0);
  float w = abs(clip.w);
  float px_per_unit = length((n.xy * clip.w - clip.xy * n.w) * viewport_px) / (2.0 * w * w);
  float most_px_per_unit = length(n.xyz) > 0.0 ? focal_px / w : 0.0;
  float reach = max(px_per_unit, 0.25 * most_px_per_unit);
  return reach > 0.0 ? clip + n * (distance_px / reach) : clip;
}
