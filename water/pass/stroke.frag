uniform sampler2D brushes;  // an atlas: how much paint, how light

#ifdef OWN_BRUSHES
flat in vec4 shares;  // of the first brushes
flat in float next_brush;
#endif
flat in vec4 paint;
noperspective in vec2 on_brush;

layout(location = 0) out vec4 fragment;

void main() {
#ifdef OWN_BRUSHES
  vec2 brush = vec2(0.0, 128.0 / 255.0);
  for (int i = 0; i < OWN_BRUSHES; ++i) {
    brush.r += shares[i] * texture(brushes, on_brush + vec2(float(i) * next_brush, 0.0)).r;
  }
#else
  vec2 brush = texture(brushes, on_brush).rg;
#endif
  float alpha = brush.r * paint.a;
  // Below 0 the target cuts it off.
  fragment = vec4(min(paint.rgb + (brush.g - 0.5) * 0.16, 1.0) * alpha, alpha);
}
