// Sums the measures of each point's faces, in the order of the faces, and divides: curvatures at points.

layout(local_size_x = 256) in;

layout(std430, binding = 2) readonly buffer First { uint first[]; };
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 5) readonly buffer Measures { vec4 measures[]; };
layout(std430, binding = 6) writeonly buffer Curvatures { vec4 curvatures[]; };

uniform uint point_count;
uniform float scale;

const float least_seen = 0.05, sharpest = 1e7, most = 3.4e38;

void main() {
  uint p = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (p >= point_count) return;
  vec4 sum = vec4(0.0);
  for (uint i = first[p]; i < first[p + 1u]; ++i) sum += measures[corners[i] / 3u];
  vec4 result = vec4(0.0);
  if (sum.w > 0.0) {
    float area = max(sum.x, least_seen * sum.w);
    float mean = clamp(sum.y / (2.0 * area), -sharpest, sharpest);
    float gauss = clamp(sum.z / area, -sharpest * sharpest, sharpest * sharpest);
    float apart = sqrt(max(mean * mean - gauss, 0.0));
    // Scaled twice, as the square of the scale may lie beyond float where the product does not.
    result = vec4(mean * scale, gauss * scale * scale, (mean + apart) * scale, (mean - apart) * scale);
    result = clamp(result, -most, most);
  }
  curvatures[p] = result;
}
