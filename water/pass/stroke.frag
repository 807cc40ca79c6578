uniform sampler2DArray brushes;  // how much paint, how light

#ifdef OWN_BRUSHES
flat in vec4 shares;  // of the first layers
#endif
flat in vec4 paint;
noperspective in vec3 on_brush;

layout(location = 0) out vec4 fragment;

void main() {
#ifdef OWN_BRUSHES
  vec2 brush = vec2(0.0, 128.0 / 255.0);
  for (int i = 0; i < OWN_BRUSHES; ++i) brush.r += shares[i] * texture(brushes, vec3(on_brush.xy, i)).r;
#else
  vec2 brush = texture(brushes, on_brush).rg;
#endif
  float alpha = brush.r * paint.a;
  fragment = vec4(clamp(paint.rgb + (brush.g - 0.5) * 0.16, 0.0, 1.0) * alpha, alpha);
}
