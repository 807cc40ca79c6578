// Interpolated corrected curvature measures of each face: area, twice the mean curvature, Gaussian curvature, flat area.

layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) readonly buffer Faces { uint faces[]; };
layout(std430, binding = 4) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 5) writeonly buffer Measures { vec4 measures[]; };

uniform uint face_count;
uniform float scale;

void main() {
  uint f = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (f >= face_count) return;
  uint i = faces[3u * f], j = faces[3u * f + 1u], k = faces[3u * f + 2u];
  vec3 origin = scale * points[i].xyz;
  vec3 a = scale * points[j].xyz - origin, b = scale * points[k].xyz - origin;
  vec3 u = normals[i].xyz, v = normals[j].xyz, w = normals[k].xyz;
  vec3 face_cross = cross(a, b), mean_normal = (u + v + w) / 3.0, d = u - w, e = v - u;
  measures[f] = 0.5 * vec4(dot(mean_normal, face_cross), dot(mean_normal, cross(d, a) + cross(e, b)),
                           dot(u, cross(d, e)), length(face_cross));
}
