#ifdef FEATHER
in float coverage;
#endif
layout(location = 0) out vec4 fragment;

void main() {
#ifdef FEATHER
  fragment = vec4(0.0, 0.0, 0.0, min(coverage, 1.0));  // blended so that it takes away
#else
  fragment = vec4(0.0);
#endif
}
