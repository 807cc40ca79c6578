// How wide a line may be at each of its vertices, for what lies close behind it there. Draws nothing.

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 line;  // LineVertex::line
layout(xfb_buffer = 0, xfb_stride = 4, xfb_offset = 0) out float room_px;

uniform sampler2D depths;  // near_m / Z of what was drawn so far, as large as the viewport at least
uniform mat4 clip_from_object;
uniform vec2 viewport_px;
uniform float near_m;
uniform float empty_depth;     // where nothing was drawn
uniform float focal_px;        // the camera's
uniform float lean;            // pixels of depth that a pixel more of width takes
uniform float largest_factor;  // LineStrips::largest_factor
uniform float most_push;       // LineVertex::most_push

const float any_width_px = 1e9;
const float free_px = 1.5;      // of its width a line always has so much: some pixel across it is mostly ink
const float spacing_px = 0.75;  // of the places looked at
const int most_places = 64;     // 48 px; wider lines are looked at more sparsely
const float hides_px = -0.5;    // of depth: what lies nearer than the contour by more hides the line itself

float room_at(vec4 clip, vec2 way, float whole_px) {
  float depth_m = clip.w;
  vec2 here = (clip.xy / depth_m * 0.5 + 0.5) * viewport_px;
  float past_free_px = whole_px + 0.5 - free_px;
  int places = clamp(int(ceil(past_free_px / spacing_px)), 1, most_places);
  float reached_px = free_px;
  for (int i = 1; i <= places; ++i) {
    float out_px = free_px + past_free_px * float(i) / float(places);
    vec2 at = here + way * out_px;
    // Of what lies outside nothing is known: as at the border.
    float seen = texelFetch(depths, ivec2(clamp(at, vec2(0.0), viewport_px - 1.0)), 0).r;
    float step_px = seen > empty_depth ? focal_px * (near_m / (seen * depth_m) - 1.0) : any_width_px;
    if (step_px >= hides_px) {
      float limit_px = free_px + max(step_px, 0.0) / lean;
      if (out_px > limit_px) return max(reached_px, limit_px);
    }
    reached_px = out_px;
  }
  return any_width_px;
}

void main() {
  vec4 clip = clip_from_object * vec4(position, 1.0);
  room_px = any_width_px;
  if (clip.w <= 0.0) return;
  float whole_px = wished_px(clip.w) * line.z * largest_factor;
  if (whole_px > free_px) room_px = room_at(clip, line.xy * most_push, whole_px);
}
