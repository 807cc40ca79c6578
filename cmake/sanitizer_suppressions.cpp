// What the sanitizers report of other people's libraries, which are not built with them.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// Libraries stay loaded: what a driver keeps to the end would else count as leaked, and by nobody; and no library that
// a suppression was matched against may be unloaded, as Mesa's is with its last display.
extern "C" int dlclose(void* library);
extern "C" int dlclose(void*) { return 0; }
#endif

#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig.so\n";  // under the printed boards' letters; keeps what it allocates to the end
}
#endif

#ifdef __SANITIZE_THREAD__
// LLVM, under Mesa, holds more locks at once than the detector of deadlocks can count, which then ends the program.
extern "C" const char* __tsan_default_options();
extern "C" const char* __tsan_default_options() { return "detect_deadlocks=0"; }

extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  // How they synchronise their threads isn't seen.
  return "called_from_lib:libavcodec.so\n"
         "called_from_lib:libavformat.so\n"
         "called_from_lib:libavutil.so\n"
         "called_from_lib:libopencv_core.so\n"
         "called_from_lib:libopencv_imgproc.so\n"
         "called_from_lib:libswscale.so\n"
         "called_from_lib:libtbb.so\n"
         "called_from_lib:libx264.so\n"
         "called_from_lib:swrast_dri.so\n"
         "mutex:libxcb.so\n"
         "mutex:nptl_deallocate_tsd\n"  // OpenCV's memory of a thread, at that one's end
         "race:libopencv_aruco.so\n"
         "race:libopencv_calib3d.so\n"
         "race:libopencv_core.so\n"
         "race:libopencv_imgproc.so\n"
         "race:swrast_dri.so\n"
         "race:av_buffer_unref\n";  // the last holder of a frame lets it go, maybe an encoder's thread
}
#endif
