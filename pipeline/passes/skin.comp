// Poses a mesh's vertices: linear blend skinning, as mesh/skin.h and passes::MovingShape::write() do it, operation for
// operation, so that what the CPU puts along the contour meets the surface.

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Joints { vec4 joints[]; };  // four columns each
layout(std430, binding = 1) readonly buffer First { uint first[]; };    // influence of each point, and the end
layout(std430, binding = 2) readonly buffer Influences { uvec2 influences[]; };  // joint, and the weight's bits
layout(std430, binding = 3) readonly buffer Welded { uint welded[]; };
layout(std430, binding = 4) readonly buffer Points { float points[]; };
layout(std430, binding = 5) readonly buffer Normals { float normals[]; };         // of vertices
layout(std430, binding = 6) readonly buffer OutlineNormals { float outlines[]; };  // of points
layout(std430, binding = 7) writeonly buffer Moved { uint moved[]; };              // MovedVertex, as words

uniform uint vertex_count;
uniform bool evenly_scaled;
uniform mat3 world_from_normal;
uniform mat3 object_from_world;

const uint words = 7u;

vec3 unit_of_any(vec3 v) {
  float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
  return largest > 0.0 && largest < 3.4e38 ? normalize(v / largest) : vec3(0.0);
}

// Along the cofactors' image; where nothing is left of it, along the map's own, else as it is.
vec3 turned(mat3 cofactors, mat3 linear, vec3 n) {
  precise vec3 along = cofactors[0] * n.x + cofactors[1] * n.y + cofactors[2] * n.z;
  float squared = dot(along, along);
  if (squared > 1e-30 && squared < 1e30) return along * (1.0 / sqrt(squared));
  vec3 unit = unit_of_any(along);
  if (unit == vec3(0.0)) unit = unit_of_any(linear * n);
  return unit == vec3(0.0) ? n : unit;
}

vec3 pushed(vec3 outline_normal) {
  if (evenly_scaled) return outline_normal;
  vec3 outwards = world_from_normal * outline_normal;
  float squared = dot(outwards, outwards);
  return object_from_world * outwards * (squared > 0.0 ? 1.0 / sqrt(squared) : 0.0);
}

uvec2 snorm(vec3 v) {
  ivec3 code = ivec3(clamp(v, -1.0, 1.0) * 32767.0 + 32768.5) - 32768;
  uvec3 bits = uvec3(code) & 0xffffu;
  return uvec2(bits.x | bits.y << 16, bits.z);
}

void main() {
  uint v = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (v >= vertex_count) return;
  uint p = welded[v];
  uint at = first[p], end = first[p + 1u];
  uint joint = 4u * influences[at].x;
  precise vec3 x = joints[joint].xyz, y = joints[joint + 1u].xyz, z = joints[joint + 2u].xyz;
  precise vec3 origin = joints[joint + 3u].xyz;
  if (end - at > 1u) {
    float weight = uintBitsToFloat(influences[at].y);
    x = x * weight;
    y = y * weight;
    z = z * weight;
    origin = origin * weight;
    for (++at; at < end; ++at) {
      joint = 4u * influences[at].x;
      weight = uintBitsToFloat(influences[at].y);
      x = x + joints[joint].xyz * weight;
      y = y + joints[joint + 1u].xyz * weight;
      z = z + joints[joint + 2u].xyz * weight;
      origin = origin + joints[joint + 3u].xyz * weight;
    }
  }
  vec3 bind = vec3(points[3u * p], points[3u * p + 1u], points[3u * p + 2u]);
  precise vec3 position = (x * bind.x + y * bind.y) + (z * bind.z + origin);

  mat3 linear = mat3(x, y, z);
  mat3 cofactors = mat3(cross(y, z), cross(z, x), cross(x, y));
  vec3 normal = vec3(normals[3u * v], normals[3u * v + 1u], normals[3u * v + 2u]);
  vec3 outline = vec3(outlines[3u * p], outlines[3u * p + 1u], outlines[3u * p + 2u]);
  uvec2 normal_code = snorm(turned(cofactors, linear, normal));
  uvec2 outline_code = snorm(pushed(turned(cofactors, linear, outline)));

  uint to = words * v;
  moved[to] = floatBitsToUint(position.x);
  moved[to + 1u] = floatBitsToUint(position.y);
  moved[to + 2u] = floatBitsToUint(position.z);
  moved[to + 3u] = normal_code.x;
  moved[to + 4u] = normal_code.y;
  moved[to + 5u] = outline_code.x;
  moved[to + 6u] = outline_code.y;
}
