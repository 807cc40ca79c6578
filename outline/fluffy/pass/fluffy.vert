// A vertex of one layer of fluff. Indices are vertex * layers + layer.

struct FluffVertex {
  vec3 position;  // of the skin
  float u;
  vec3 growth;    // from the skin to the top layer
  float v;
  vec3 normal;
  uint colour;
};
layout(std430, binding = 0) readonly buffer Vertices { FluffVertex vertices[]; };

uniform mat4 clip_from_frame;
uniform vec3 eye;
uniform uint layers;
uniform vec3 hang;       // how far the tips hang down, in lengths of the fluff
uniform vec4 own_colour; // instead of the body's where its alpha is 1
#ifdef LIT
uniform vec3 light;      // unit, towards it
uniform float bands;
out float brightness;    // 0 to bands
#endif

out vec3 texture_position;
out float facing;        // the cosine between normal and line of sight
out float height;        // of the layer, 1 at the top
out vec3 tint;

void main() {
  uint id = uint(gl_VertexID);
  uint layer = id % layers;
  FluffVertex vertex = vertices[id / layers];
  height = float(layer + 1u) / float(layers);
  // Tips hang along the skin, as far as they may, and the more the farther out they are.
  float long_m = length(vertex.growth);
  vec3 along_skin = hang - vertex.normal * dot(hang, vertex.normal);
  vec3 position = vertex.position + vertex.growth * height + along_skin * (long_m * height * height);
  gl_Position = clip_from_frame * vec4(position, 1.0);
  gl_Position.z *= 1.0002;  // the lowest layer lies on the body. Depth is near / Z
  texture_position = vec3(vertex.u, vertex.v, float(layer));
  facing = dot(vertex.normal, normalize(eye - vertex.position));
  tint = mix(unpackUnorm4x8(vertex.colour).rgb, own_colour.rgb, own_colour.a);
#ifdef LIT
  brightness = (dot(vertex.normal, light) * 0.5 + 0.5) * bands;
#endif
}
