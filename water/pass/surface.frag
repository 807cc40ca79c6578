uniform sampler2D painting;  // of the layer's size

in float coverage;

layout(location = 0) out vec4 fragment;

void main() {
  fragment = texelFetch(painting, ivec2(gl_FragCoord.xy), 0) * coverage;
}
