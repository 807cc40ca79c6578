// How wide a line may be at each of its vertices, for what lies close behind it there.

layout(local_size_x = 64) in;

const uint words_per_vertex = 5u;  // of LineVertex: three floats, four snorm of 16 bits
layout(std430, binding = 0) readonly buffer Vertices { uint words[]; };
layout(std430, binding = 1) writeonly buffer Room { float room_px[]; };

uniform uint vertex_count;
uniform sampler2D depths;  // near_m / Z of what was drawn so far, as large as the viewport at least
uniform mat4 clip_from_object;
uniform vec2 viewport_px;
uniform float near_m;
uniform float focal_px;
uniform float lean;            // pixels of depth that a pixel more of width takes
uniform float largest_factor;  // LineStrips::largest_factor
uniform float most_push;       // LineVertex::most_push

const float any_width_px = 1e9;
const float free_px = 1.0;      // of its width a line always has so much
const float spacing_px = 0.75;  // of the places looked at
const int most_places = 24;
const float before_px = -0.5;  // what lies nearer than this hides the line itself

float room_at(vec4 clip, vec2 way, float whole_px) {
  float depth_m = clip.w;
  vec2 here = (clip.xy / depth_m * 0.5 + 0.5) * viewport_px;
  float beyond_px = whole_px + 0.5 - free_px;
  int places = clamp(int(ceil(beyond_px / spacing_px)), 1, most_places);
  float reached_px = free_px;
  for (int i = 1; i <= places; ++i) {
    float out_px = free_px + beyond_px * float(i) / float(places);
    vec2 at = here + way * out_px;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, viewport_px))) break;
    float seen = texelFetch(depths, ivec2(at), 0).r;
    float step_px = seen > 0.0 ? focal_px * (near_m / (seen * depth_m) - 1.0) : any_width_px;
    if (step_px >= before_px) {
      float limit_px = free_px + max(step_px, 0.0) / lean;
      if (out_px > limit_px) return max(reached_px, limit_px);
    }
    reached_px = out_px;
  }
  return any_width_px;
}

void main() {
  uint v = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (v >= vertex_count) return;
  uint first = v * words_per_vertex;
  vec3 position = uintBitsToFloat(uvec3(words[first], words[first + 1u], words[first + 2u]));
  vec2 way = unpackSnorm2x16(words[first + 3u]) * most_push;
  float factor = unpackSnorm2x16(words[first + 4u]).x * largest_factor;
  vec4 clip = clip_from_object * vec4(position, 1.0);
  float room = any_width_px;
  if (clip.w > near_m) {
    float whole_px = wished_px(clip.w) * factor;
    if (whole_px > free_px) room = room_at(clip, way, whole_px);
  }
  room_px[v] = room;
}
