// Max's vertex normals, gathered by point: the sum of cross products over the squared lengths of the edges at the point.

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) readonly buffer Faces { uint faces[]; };
layout(std430, binding = 2) readonly buffer First { uint first[]; };
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 4) writeonly buffer Normals { vec4 normals[]; };

uniform uint point_count;
uniform float scale;  // a power of two: nothing is rounded

const float shortest_sq = 1e-6, least_product = 1e-36, least_sq = 1e-36;

// The order of edges and of sums is the CPU's, so that both differ by rounding alone.
vec3 weighted_cross(uint face, uint corner) {
  vec3 i = scale * points[faces[3u * face]].xyz;
  vec3 a = scale * points[faces[3u * face + 1u]].xyz - i;
  vec3 b = scale * points[faces[3u * face + 2u]].xyz - i;
  vec3 c = b - a;
  vec3 squares = vec3(dot(c, c), dot(b, b), dot(a, a));  // opposite corners i, j and k
  squares = max(squares, shortest_sq * max(squares.x, max(squares.y, squares.z)));
  float share = 1.0 / max(squares.z * squares.y * squares.x, least_product);
  float own = corner == 0u ? squares.x : corner == 1u ? squares.y : squares.z;
  return cross(a, b) * (share * own);
}

void main() {
  uint p = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (p >= point_count) return;
  vec3 sum = vec3(0.0);
  for (uint i = first[p]; i < first[p + 1u]; ++i) {
    uint face = corners[i] / 3u;
    sum += weighted_cross(face, corners[i] - 3u * face);
  }
  float length_sq = dot(sum, sum);
  normals[p] = vec4(length_sq > least_sq ? sum / sqrt(length_sq) : vec3(0.0), 0.0);
}
