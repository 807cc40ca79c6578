#include "apps/rinkaku/viewer/view.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <utility>

#include "apps/rinkaku/interrupt.h"
#include "apps/rinkaku/viewer/panel.h"
#include "apps/rinkaku/viewer/run_thread.h"
#include "apps/rinkaku/viewer/screenshot.h"
#include "pipeline/frame/error.h"
#include "pipeline/window/presenter.h"
#include "pipeline/window/window.h"

namespace rinkaku::app {
namespace {

using Clock = std::chrono::steady_clock;
using Effect = SceneFile::Effect;

std::int64_t monotonic_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

// Lets the main thread sleep until a frame is there, also while there is no window to wait for.
class Bell {
 public:
  void ring() {
    {
      std::lock_guard lock(mutex_);
      rung_ = true;
    }
    rang_.notify_one();
    if (windowed_) window::Window::wake();
  }
  void wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    rang_.wait_for(lock, most, [this] { return rung_; });
    rung_ = false;
  }
  void window_is_open(bool open) { windowed_ = open; }

 private:
  std::mutex mutex_;
  std::condition_variable rang_;
  bool rung_ = false;
  std::atomic<bool> windowed_{false};
};

class View {
 public:
  View(SceneFile& file, const ViewOptions& options)
      : file_(file), options_(options), viewer_([this] { bell_.ring(); }), run_(viewer_, options.run) {}
  ~View() { run_.stop(); }

  ViewReport run();

 private:
  void wait_for_first_frame();
  void open_window();
  bool goes_on();
  void take_frame();
  void draw();
  void obey(const PanelWish& wish);
  void obey_keys();
  void apply(Effect effect);
  void look_at_files();
  void take_screenshot();
  ArrowEditor* look_at_arrows(double frames_per_s);
  template <typename Attempt>
  void attempt(Attempt change);

  SceneFile& file_;
  const ViewOptions& options_;
  Bell bell_;
  Viewer viewer_;
  RunThread run_;
  std::unique_ptr<window::Window> window_;
  std::optional<window::Presenter> presenter_;
  std::optional<Panel> panel_;
  std::optional<Viewer::Shown> shown_;
  ArrowEditor arrows_;
  bool fresh_ = false, quit_ = false, editing_ = false;
  std::string trouble_, notice_;
  ViewReport report_;
  Clock::time_point started_ = Clock::now(), looked_ = started_, last_shown_ = started_;
  double fps_ = 0, latency_ms_ = 0;
};

ViewReport View::run() {
  if (!options_.session.empty()) viewer_.keep_session(options_.session, file_.scene().file, file_.text());
  run_.start(file_.scene());
  wait_for_first_frame();
  if (!options_.headless) open_window();
  if (options_.headless && shown_) ++report_.shown;
  started_ = last_shown_ = Clock::now();
  while (goes_on()) {
    if (window_) {
      // A panel that is touched is drawn at once, one that is only looked at when a frame comes.
      window_->wait(0.1);
    } else {
      bell_.wait(std::chrono::milliseconds(100));
    }
    take_frame();
    if (window_) draw();
    look_at_files();
  }
  report_.seconds = std::chrono::duration<double>(Clock::now() - started_).count();
  run_.stop();
  viewer_.finish_session();
  bell_.window_is_open(false);
  const Viewer::Status status = viewer_.status();
  report_.health = status.health;
  report_.dropped = status.dropped;
  report_.unshown = status.unshown;
  if (const std::exception_ptr failure = run_.take_failure(); failure && !window_) std::rethrow_exception(failure);
  report_.run = run_.report();
  return std::move(report_);
}

void View::wait_for_first_frame() {
  while (!(shown_ = viewer_.take_newest())) {
    bell_.wait(std::chrono::milliseconds(50));
    if (interrupted()) return;
    if (run_.running()) continue;
    if ((shown_ = viewer_.take_newest())) return;
    if (const std::exception_ptr failure = run_.take_failure()) std::rethrow_exception(failure);
    return;
  }
}

void View::open_window() {
  if (!shown_) return;
  const PictureFormat& format = shown_->frame.format;
  const window::Presenter::Place natural = window::Presenter::place(format, 1 << 20, format.height_px);
  window_ =
      window::Window::open("rinkaku: " + file_.scene().file.filename().string(), natural.width_px, natural.height_px);
  bell_.window_is_open(true);
  presenter_.emplace(window_->software() ? window::Presenter::Way::Cpu : window::Presenter::Way::Shader);
  panel_.emplace(*window_);
  if (!options_.panel) panel_->toggle();
  presenter_->take(shown_->frame);
  fresh_ = true;
}

bool View::goes_on() {
  if (quit_ || interrupted() || (window_ && window_->closed())) return false;
  if (!options_.headless && !window_) return false;
  if (options_.seconds > 0 && Clock::now() - started_ > std::chrono::duration<double>(options_.seconds)) return false;
  if (run_.running()) return true;
  if (const std::exception_ptr failure = run_.take_failure()) {
    if (!window_) std::rethrow_exception(failure);
    try {
      std::rethrow_exception(failure);
    } catch (const std::exception& error) {
      trouble_ = error.what();
    }
  }
  // With a window the last picture stays, and a mended scene starts anew.
  return window_ != nullptr;
}

void View::take_frame() {
  std::optional<Viewer::Shown> newest = viewer_.take_newest();
  if (!newest) return;
  shown_ = std::move(newest);
  fresh_ = true;
  if (window_) presenter_->take(shown_->frame);
  if (!window_) ++report_.shown;
}

void View::draw() {
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  if (width <= 0 || height <= 0) return;
  presenter_->draw(width, height);
  PanelFacts facts;
  facts.status = viewer_.status();
  facts.shown = shown_ ? &*shown_ : nullptr;
  facts.fps = fps_;
  facts.latency_ms = latency_ms_;
  facts.paused = viewer_.playback().paused();
  facts.ended = viewer_.playback().ended();
  facts.trouble = trouble_.empty() ? facts.status.trouble : trouble_;
  facts.notice = notice_;
  facts.look = viewer_.look();
  if (editing_ && shown_) facts.arrows = look_at_arrows(facts.status.frames_per_s);
  const PanelWish wish = panel_->draw(file_, facts);
  window_->swap();
  if (fresh_) {
    fresh_ = false;
    ++report_.shown;
    const Clock::time_point now = Clock::now();
    report_.interval.add(now - last_shown_);
    const double interval_s = std::chrono::duration<double>(now - last_shown_).count();
    last_shown_ = now;
    if (interval_s > 0) fps_ += 0.1 * (1 / interval_s - fps_);
    if (shown_->frame.captured_ns > 0 && !shown_->frame.repeated) {
      const std::chrono::nanoseconds latency(monotonic_ns() - shown_->frame.captured_ns);
      report_.latency.add(latency);
      latency_ms_ += 0.1 * (std::chrono::duration<double, std::milli>(latency).count() - latency_ms_);
    }
  }
  obey(wish);
  obey_keys();
}

// What the user got wrong, or the disk, is shown and changes nothing.
template <typename Attempt>
void View::attempt(Attempt change) {
  try {
    change();
    trouble_.clear();
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

// Of the picture that is shown; null, and said why, if they can't be edited.
ArrowEditor* View::look_at_arrows(double frames_per_s) {
  try {
    arrows_.look(file_, frames_per_s, shown_->frame.number, shown_->camera_from_world);
    return &arrows_;
  } catch (const std::exception& error) {
    trouble_ = error.what();
    editing_ = false;
    return nullptr;
  }
}

void View::obey(const PanelWish& wish) {
  for (const PanelWish::Value& value : wish.values) {
    attempt([&] { apply(file_.set(value.path, value.text)); });
  }
  if (wish.arrows) {
    editing_ = !editing_ && file_.scene().water.has_value();
    if (!file_.scene().water) notice_ = "the scene has no water for flow arrows";
  }
  const auto take_text = [this](const std::optional<std::string>& text) {
    if (text) attempt([&] { apply(file_.set_text(*text)); });
  };
  take_text(wish.text);
  if (editing_ && wish.delete_arrow) take_text(arrows_.without_selected());
  if (editing_ && wish.key_arrows) take_text(arrows_.with_key_here());
  if (wish.pause) {
    if (viewer_.playback().ended()) {
      apply(Effect::Restart);
    } else {
      viewer_.playback().toggle_pause();
    }
  }
  if (wish.step) viewer_.playback().step();
  if (wish.look) viewer_.look_at(*wish.look, file_.scene(), file_.text());
  if (wish.restart) apply(Effect::Restart);
  if (wish.full_screen) window_->toggle_full_screen();
  if (wish.screenshot) take_screenshot();
  if (wish.save) {
    attempt([&] {
      file_.save();
      notice_ = "saved " + file_.scene().file.string();
    });
  }
}

void View::obey_keys() {
  PanelWish wish;
  for (const window::Key key : window_->take_keys()) {
    if (panel_->wants_keys()) continue;
    using window::Key;
    switch (key) {
      case Key::Quit:
        quit_ = true;
        break;
      case Key::Panel:
        panel_->toggle();
        break;
      case Key::Step:
        viewer_.playback().step();
        break;
      case Key::Look:
        wish.look = static_cast<Viewer::Look>((static_cast<int>(viewer_.look()) + 1) % 3);
        break;
      default:
        wish.pause |= key == Key::Pause;
        wish.full_screen |= key == Key::FullScreen;
        wish.restart |= key == Key::Restart;
        wish.screenshot |= key == Key::Screenshot;
        wish.save |= key == Key::Save;
        wish.arrows |= key == Key::Arrows;
        wish.delete_arrow |= key == Key::Delete;
    }
  }
  obey(wish);
}

void View::apply(Effect effect) {
  if (effect == Effect::Redraw && run_.running()) viewer_.change(file_.scene(), file_.text());
  if (effect == Effect::Restart || (effect == Effect::Redraw && !run_.running())) {
    run_.start(file_.scene());
    // A run begins with the scene's own colours.
    if (viewer_.look() == Viewer::Look::Curvature) viewer_.change(file_.scene(), file_.text());
  }
}

void View::look_at_files() {
  if (Clock::now() - looked_ < std::chrono::milliseconds(300)) return;
  looked_ = Clock::now();
  try {
    if (const Effect effect = file_.look(); effect != Effect::None) {
      trouble_.clear();
      notice_ = "read anew what changed on disk";
      apply(effect);
    }
  } catch (const std::exception& error) {
    trouble_ = error.what();
  }
}

void View::take_screenshot() {
  if (!shown_) return;
  attempt([&] { notice_ = "saved " + save_screenshot(shown_->frame, options_.screenshots); });
}

}  // namespace

ViewReport view(SceneFile& file, const ViewOptions& options) { return View(file, options).run(); }

}  // namespace rinkaku::app
