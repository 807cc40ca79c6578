#pragma once

#include <atomic>
#include <exception>
#include <optional>
#include <thread>

#include "apps/rinkaku/viewer/viewer.h"
#include "pipeline/pipeline.h"

namespace rinkaku::app {

/// Renders scenes on a thread of its own, one after the other, before a viewer's eyes. All functions are for the thread
/// that made it.
class RunThread {
 public:
  RunThread(Viewer& viewer, pipeline::RenderOptions options);
  /// Ends the run that there is.
  ~RunThread();

  /// Ends the run that there is and begins one of this scene.
  void start(pipeline::Scene scene);
  /// Ends the run as the end of the video would, and waits for that.
  void stop();

  bool running() const { return thread_.joinable() && !done_; }
  /// What the last run ended with, once, after it isn't running any more.
  std::exception_ptr take_failure();
  /// Of the last run that ended well.
  const std::optional<pipeline::RenderReport>& report() const { return report_; }

 private:
  Viewer& viewer_;
  pipeline::RenderOptions options_;
  std::atomic<bool> stop_{false}, done_{true};
  std::exception_ptr failure_;
  std::optional<pipeline::RenderReport> report_;
  std::thread thread_;
};

}  // namespace rinkaku::app
