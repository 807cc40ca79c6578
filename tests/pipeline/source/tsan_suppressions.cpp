// The FFmpeg libraries are not built for ThreadSanitizer, which therefore does not see how they synchronise.
#ifdef __SANITIZE_THREAD__
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libavcodec.so\n"
         "called_from_lib:libavutil.so\n"
         "called_from_lib:libavformat.so\n"
         "called_from_lib:libswscale.so\n"
         "called_from_lib:libx264.so\n"
         "race:av_buffer_unref\n";  // the last holder of a frame lets it go, maybe an encoder's thread
}
#endif
