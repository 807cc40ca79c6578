// Lists the triangles in the band in two runs, those that face away and then the others, each in the frame's order. One
// workgroup goes over all triangles in turns, so that the order never depends on timing.

struct FluffVertex {
  vec3 position;
  float u;
  vec3 growth;
  float v;
  vec3 normal;
  uint colour;
};
layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer Vertices { FluffVertex vertices[]; };
layout(std430, binding = 1) readonly buffer Triangles { uint triangles[]; };  // three vertices each
layout(std430, binding = 2) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = 3) writeonly buffer Command {
  uint count;
  uint instance_count;
  uint first_index;
  int base_vertex;
  uint base_instance;
};

uniform vec3 eye;
uniform float sine;
uniform uint triangle_count;
uniform uint layers;
uniform uint step_between;  // every which layer is listed, counted from the top

shared uint sums[256];

// How many invocations before this one, and this one, have `one` set.
uint summed(uint one) {
  uint id = gl_LocalInvocationID.x;
  sums[id] = one;
  barrier();
  for (uint reach = 1u; reach < 256u; reach *= 2u) {
    uint before = id >= reach ? sums[id - reach] : 0u;
    barrier();
    sums[id] += before;
    barrier();
  }
  return sums[id];
}

float facing(FluffVertex vertex) { return dot(vertex.normal, normalize(eye - vertex.position)); }

void main() {
  uint id = gl_LocalInvocationID.x;
  uint listed_layers = (layers + step_between - 1u) / step_between;
  uint lowest = (layers - 1u) % step_between;
  uint found = 0u;
  for (uint run = 0u; run < 2u; ++run) {
    for (uint first = 0u; first < triangle_count; first += 256u) {
      uint t = first + id;
      uvec3 corners = uvec3(0u);
      bool listed = false;
      if (t < triangle_count) {
        corners = uvec3(triangles[3u * t], triangles[3u * t + 1u], triangles[3u * t + 2u]);
        vec3 f = vec3(facing(vertices[corners.x]), facing(vertices[corners.y]), facing(vertices[corners.z]));
        bool in_band = min(f.x, min(f.y, f.z)) <= sine && max(f.x, max(f.y, f.z)) >= -sine;
        bool outwards = f.x + f.y + f.z >= 0.0;
        listed = in_band && outwards == (run == 1u);
      }
      uint place = found + summed(listed ? 1u : 0u) - 1u;
      found += sums[255];
      barrier();
      if (!listed) continue;
      uint out_at = place * listed_layers * 3u;
      for (uint k = 0u; k < listed_layers; ++k) {
        uint layer = run == 1u ? lowest + k * step_between : layers - 1u - k * step_between;
        for (int c = 0; c < 3; ++c) indices[out_at++] = corners[c] * layers + layer;
      }
    }
  }
  if (id == 0u) {
    count = found * listed_layers * 3u;
    instance_count = 1u;
    first_index = 0u;
    base_vertex = 0;
    base_instance = 0u;
  }
}
