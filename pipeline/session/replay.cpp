#include "pipeline/session/replay.h"

#include <algorithm>
#include <utility>

#include "pipeline/frame/error.h"

namespace rinkaku::session {
namespace {

class ReplayedSource final : public source::Source {
 public:
  ReplayedSource(std::unique_ptr<source::Source> plate, const Session& session)
      : plate_(std::move(plate)), session_(session), description_(plate_->description()) {
    const LoggedFrame& first = session_.frames.front();
    description_.time_base = first.time_base;
    description_.first_pts = first.pts;
    description_.variable_frame_rate = true;
    description_.frame_count = static_cast<std::int64_t>(session_.frames.size());
  }
  const source::Description& description() const override { return description_; }
  std::string damage() const override { return plate_->damage(); }

  std::optional<Frame> next() override {
    if (next_ == session_.frames.size()) return std::nullopt;
    std::optional<Frame> frame = plate_->next();
    if (!frame) return std::nullopt;  // killed between the log and the plate
    const LoggedFrame& logged = session_.frames[next_++];
    frame->number = logged.number;
    frame->pts = logged.pts;
    frame->duration = logged.duration;
    frame->time_base = logged.time_base;
    frame->captured_ns = logged.captured_ns;
    return frame;
  }

 private:
  std::unique_ptr<source::Source> plate_;
  const Session& session_;
  source::Description description_;
  std::size_t next_ = 0;
};

class ReplayedTrack final : public track::Tracker {
 public:
  explicit ReplayedTrack(const Session& session) : session_(session) {}

  std::optional<TrackedPose> track(const Frame& frame) override {
    const auto found = std::lower_bound(session_.frames.begin(), session_.frames.end(), frame.number,
                                        [](const LoggedFrame& f, std::int64_t number) { return f.number < number; });
    return found != session_.frames.end() && found->number == frame.number ? found->pose : std::nullopt;
  }

 private:
  const Session& session_;
};

pipeline::Scene scene_from(const Session& session, const std::string& text) {
  pipeline::SceneOptions options;
  options.input = session.plate().string();
  options.text = text;
  return pipeline::read_scene(session.scene, options);
}

}  // namespace

pipeline::Scene scene_of(const Session& session) { return scene_from(session, session.text); }

std::unique_ptr<source::Source> Replay::through(std::unique_ptr<source::Source> source) {
  return std::make_unique<ReplayedSource>(std::move(source), session_);
}

std::unique_ptr<track::Tracker> Replay::tracked_by(std::unique_ptr<track::Tracker> /*tracker*/) {
  return std::make_unique<ReplayedTrack>(session_);
}

std::optional<pipeline::SceneChange> Replay::changed(const Frame& frame) {
  const LoggedChange* newest = nullptr;
  while (changes_taken_ < session_.changes.size() && session_.changes[changes_taken_].from_frame <= frame.number) {
    newest = &session_.changes[changes_taken_++];
  }
  if (!newest) return std::nullopt;
  pipeline::Scene scene = scene_from(session_, newest->text);
  pipeline::PreparedObjects objects = pipeline::prepare_objects(scene);
  return pipeline::SceneChange{std::move(scene), std::move(objects)};
}

void Replay::refused(const std::string& why) { throw runtime_failure(session_.folder.string(), why); }

}  // namespace rinkaku::session
