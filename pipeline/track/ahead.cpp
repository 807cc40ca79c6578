#include "pipeline/track/ahead.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include <glm/gtc/quaternion.hpp>

namespace rinkaku::track {
namespace {

// From frames that lie closer, a stalled camera's, noise would be taken for speed.
constexpr double least_step_s = 0.005;

class AheadTracker final : public Tracker {
 public:
  explicit AheadTracker(std::unique_ptr<Tracker> tracker) : tracker_(std::move(tracker)), thread_([this] { work(); }) {}
  ~AheadTracker() override {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    come_.notify_one();
    thread_.join();
  }

  std::optional<TrackedPose> track(const Frame& frame) override {
    std::optional<TrackedPose> pose;
    {
      const std::lock_guard lock(mutex_);
      if (failure_) std::rethrow_exception(failure_);
      newest_ = frame;
      if (!lost_) pose = predictor_.at(frame.time_s());
    }
    come_.notify_one();
    if (pose) pose->frame_number = frame.number;
    return pose;
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      come_.wait(lock, [this] { return ended_ || newest_; });
      if (ended_) return;
      const Frame frame = std::move(*newest_);
      newest_.reset();
      lock.unlock();
      std::optional<TrackedPose> pose;
      std::exception_ptr failure;
      try {
        pose = tracker_->track(frame);
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      if (failure) {
        failure_ = failure;
        return;
      }
      lost_ = !pose;
      if (pose) predictor_.add(frame.time_s(), *pose);
    }
  }

  std::unique_ptr<Tracker> tracker_;  // the thread's alone
  std::mutex mutex_;
  std::condition_variable come_;
  std::optional<Frame> newest_;
  PosePredictor predictor_;
  bool lost_ = false, ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses all of these
};

}  // namespace

void PosePredictor::add(double time_s, const TrackedPose& pose) {
  // A held pose stands still, and what comes after it starts from there.
  const bool goes_on = last_ && time_s - last_->time_s > least_step_s && !pose.held && !last_->pose.held;
  before_ = goes_on ? last_ : std::nullopt;
  last_ = {time_s, pose};
}

std::optional<TrackedPose> PosePredictor::at(double time_s) const {
  if (!last_) return std::nullopt;
  TrackedPose pose = last_->pose;
  if (!(time_s > last_->time_s)) return pose;
  pose.held = true;
  pose.reprojection_rms_px = 0;
  if (!before_) return pose;
  const double ahead_s = std::min(time_s - last_->time_s, longest_s), step_s = last_->time_s - before_->time_s;
  const RigidTransform& a = before_->pose.camera_from_world;
  const RigidTransform& b = last_->pose.camera_from_world;
  const double part = ahead_s / step_s;
  pose.camera_from_world.translation_m = b.translation_m + part * (b.translation_m - a.translation_m);
  glm::dquat turn = b.rotation * glm::conjugate(a.rotation);
  if (turn.w < 0) turn = -turn;
  pose.camera_from_world.rotation = glm::normalize(glm::slerp(glm::dquat(1, 0, 0, 0), turn, part) * b.rotation);
  return pose;
}

std::unique_ptr<Tracker> make_ahead(std::unique_ptr<Tracker> tracker) {
  return std::make_unique<AheadTracker>(std::move(tracker));
}

}  // namespace rinkaku::track
