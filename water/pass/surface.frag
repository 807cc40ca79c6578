uniform sampler2D painting;  // of the layer's size
uniform sampler2D ground;    // what shows between the strokes
uniform float ground_opacity;
uniform vec4 ground_place;   // of the target's corner, and a pixel's size

in float coverage;

layout(location = 0) out vec4 fragment;

void main() {
  vec4 paint = texelFetch(painting, ivec2(gl_FragCoord.xy), 0);
  if (ground_opacity > 0.0 && paint.a < 1.0) {
    vec3 below = textureLod(ground, ground_place.xy + gl_FragCoord.xy * ground_place.zw, 0.0).rgb;
    paint += vec4(below, 1.0) * (ground_opacity * (1.0 - paint.a));
  }
  fragment = paint * coverage;
}
