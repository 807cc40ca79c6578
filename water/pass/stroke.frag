uniform sampler2DArray brushes;  // how much paint, how light

flat in vec4 paint;
in vec3 on_brush;

layout(location = 0) out vec4 fragment;

void main() {
  vec2 brush = texture(brushes, on_brush).rg;
  float alpha = brush.r * paint.a;
  fragment = vec4(clamp(paint.rgb + (brush.g - 0.5) * 0.16, 0.0, 1.0) * alpha, alpha);
}
