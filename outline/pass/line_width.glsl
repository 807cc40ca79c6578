uniform vec2 width_px;         // the same at any distance, and what is divided by the depth in metres
uniform vec2 width_limits_px;

float wished_px(float depth_m) {
  return clamp(width_px.x + width_px.y / depth_m, width_limits_px.x, width_limits_px.y);
}
