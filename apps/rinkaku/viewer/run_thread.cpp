#include "apps/rinkaku/viewer/run_thread.h"

#include <utility>

namespace rinkaku::app {

RunThread::RunThread(Viewer& viewer, pipeline::RenderOptions options) : viewer_(viewer), options_(std::move(options)) {}

RunThread::~RunThread() { stop(); }

void RunThread::start(pipeline::Scene scene) {
  stop();
  stop_ = false;
  done_ = false;
  failure_ = nullptr;
  thread_ = std::thread([this, taken = std::move(scene)]() mutable {
    try {
      const pipeline::Prepared prepared = pipeline::prepare(std::move(taken), options_);
      report_ = pipeline::render(prepared, options_, stop_, {}, &viewer_);
    } catch (...) {
      failure_ = std::current_exception();
    }
    done_ = true;
  });
}

void RunThread::stop() {
  if (!thread_.joinable()) return;
  stop_ = true;
  viewer_.let_go();
  thread_.join();
}

std::exception_ptr RunThread::take_failure() {
  if (running()) return nullptr;
  if (thread_.joinable()) thread_.join();
  return std::exchange(failure_, nullptr);
}

}  // namespace rinkaku::app
