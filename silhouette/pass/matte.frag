layout(location = 0) out float coverage;

void main() {
#ifdef CULL_PER_FRAGMENT
  if (!gl_FrontFacing) discard;
#endif
  coverage = 1.0;
}
