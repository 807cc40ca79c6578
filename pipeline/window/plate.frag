// A picture's own samples, whatever their layout, as sRGB-encoded RGB. Chroma is interpolated between its samples.
layout(binding = 0) uniform sampler2D planes[4];
struct Component {
  int plane, step_bytes, offset_bytes, shift_bits, depth_bits;
};
uniform Component components[4];
uniform int component_count;
uniform bool big_endian;
uniform ivec2 log2_chroma;
uniform ivec2 chroma_size;
uniform bool chroma_is_left;  // its samples lie on luma's column, not between two
uniform mat3 rgb_from_code;   // of code values less the offset, to 0..1
uniform vec3 code_offset;
uniform int colour_model;     // 0 grey, 1 Y'CbCr, 2 RGB
out vec4 colour;

float sample_at(int index, ivec2 at) {
  Component c = components[index];
  ivec2 byte_at = ivec2(at.x * c.step_bytes + c.offset_bytes, at.y);
  int low = int(texelFetch(planes[c.plane], byte_at, 0).r * 255.0 + 0.5);
  if (c.depth_bits + c.shift_bits > 8) {
    int next = int(texelFetch(planes[c.plane], byte_at + ivec2(1, 0), 0).r * 255.0 + 0.5);
    low = big_endian ? low * 256 + next : low + next * 256;
  }
  return float((low >> c.shift_bits) & ((1 << c.depth_bits) - 1));
}

float chroma_at(int index, ivec2 at) {
  vec2 scale = vec2(1 << log2_chroma.x, 1 << log2_chroma.y);
  vec2 centre = (vec2(at) + 0.5) / scale - 0.5;
  if (chroma_is_left && log2_chroma.x > 0) centre.x = float(at.x) / scale.x;
  vec2 low = floor(centre);
  vec2 part = centre - low;
  ivec2 first = clamp(ivec2(low), ivec2(0), chroma_size - 1), second = clamp(ivec2(low) + 1, ivec2(0), chroma_size - 1);
  float above = mix(sample_at(index, first), sample_at(index, ivec2(second.x, first.y)), part.x);
  float below = mix(sample_at(index, ivec2(first.x, second.y)), sample_at(index, second), part.x);
  return mix(above, below, part.y);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 code;
  if (colour_model == 0) {
    code = vec3(sample_at(0, at));
  } else if (colour_model == 1) {
    code = vec3(sample_at(0, at), chroma_at(1, at), chroma_at(2, at));
  } else {
    code = vec3(sample_at(0, at), sample_at(1, at), sample_at(2, at));
  }
  float alpha = 1.0;
  if (component_count == 4 || component_count == 2) {
    Component a = components[component_count - 1];
    alpha = sample_at(component_count - 1, at) / float((1 << a.depth_bits) - 1);
  }
  // CG alone is shown on grey.
  colour = vec4(mix(vec3(0.5), clamp(rgb_from_code * (code - code_offset), 0.0, 1.0), alpha), 1.0);
}
