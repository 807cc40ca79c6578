#include "silhouette/region_lists.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace rinkaku::silhouette {
namespace {

/// A decoded list, or the room for one.
struct Slot {
  enum class Holds { Nothing, Decoding, List };
  Holds holds = Holds::Nothing;
  std::uint32_t region = 0;
  std::uint64_t serial = 0;
  std::uint64_t last_use = 0;
  std::vector<std::uint32_t> indices;
};

/// The next regions on an eye's way, nearest first. Two, as a way may cut a region's corner within a frame.
using Ahead = std::array<std::optional<std::uint32_t>, 2>;

}  // namespace

struct RegionLists::State {
  State(std::shared_ptr<const RegionFile> of, RegionLists::Make how, const RegionListsOptions& with)
      : file(std::move(of)), make(std::move(how)), options(with), finder(file->space()) {}

  const std::shared_ptr<const RegionFile> file;
  const RegionLists::Make make;
  const RegionListsOptions options;
  const RegionFinder finder;

  // The calling thread's own.
  std::optional<glm::dvec3> last_eye;  // in the unit frame
  std::uint64_t uses = 0;

  std::mutex mutex;  // guards what follows, but not the indices of a slot being decoded
  std::condition_variable_any asked;
  std::condition_variable_any answered;
  std::vector<Slot> slots;
  std::size_t current = 0;  // the slot given out last, if any: never written over
  bool gave_out = false;
  std::optional<std::uint32_t> wanted;  // to draw now
  Ahead expected;                       // to draw soon
  std::uint64_t serials = 0;
  std::exception_ptr failure;
  std::jthread decoder;  // the last: it ends first

  void start(std::size_t most_indices);
  void run(const std::stop_token& stop);
  Slot* slot_of(std::uint32_t region);
  Slot& slot_to_write();
  std::optional<std::uint32_t> next_job();
  Ahead regions_ahead(const glm::dvec3& eye, std::uint32_t region) const;
  bool expect(const Ahead& ahead);
};

void RegionLists::State::start(std::size_t most_indices) {
  slots.resize(static_cast<std::size_t>(std::max(options.kept, 4)));
  for (Slot& slot : slots) slot.indices.reserve(most_indices);
  // A missing product shows at the first region, before the thread is there to meet it.
  make(*file, 0, slots[0].indices);
  decoder = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Slot* RegionLists::State::slot_of(std::uint32_t region) {
  for (Slot& slot : slots) {
    if (slot.holds != Slot::Holds::Nothing && slot.region == region) return &slot;
  }
  return nullptr;
}

Slot& RegionLists::State::slot_to_write() {
  Slot* oldest = nullptr;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (gave_out && i == current) continue;
    Slot& slot = slots[i];
    if (slot.holds == Slot::Holds::Nothing) return slot;
    if (oldest == nullptr || slot.last_use < oldest->last_use) oldest = &slot;
  }
  return *oldest;  // there are three at least besides the current one, and nothing is being decoded now
}

/// The region to decode now; forgets requests that are answered already.
std::optional<std::uint32_t> RegionLists::State::next_job() {
  if (failure) return std::nullopt;
  for (auto* request : {&wanted, &expected[0], &expected[1]}) {
    if (!*request) continue;
    const std::uint32_t region = **request;
    request->reset();
    if (slot_of(region) == nullptr) return region;
  }
  return std::nullopt;
}

void RegionLists::State::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex);
  for (;;) {
    const auto region = next_job();
    if (!region) {
      answered.notify_all();
      if (!asked.wait(lock, stop, [&] { return (wanted || expected[0] || expected[1]) && !failure; })) return;
      continue;
    }
    Slot& slot = slot_to_write();
    slot.holds = Slot::Holds::Decoding;
    slot.region = *region;
    lock.unlock();
    std::exception_ptr failed;
    try {
      make(*file, *region, slot.indices);
    } catch (...) {
      failed = std::current_exception();
    }
    lock.lock();
    slot.holds = failed ? Slot::Holds::Nothing : Slot::Holds::List;
    slot.serial = ++serials;
    slot.last_use = uses;
    if (failed) failure = failed;
    answered.notify_all();
  }
}

/// The regions an eye comes to next, if it goes on as from the last frame to this one.
Ahead RegionLists::State::regions_ahead(const glm::dvec3& eye, std::uint32_t region) const {
  Ahead out;
  if (!last_eye || *last_eye == eye) return out;
  const glm::dvec3 step = eye - *last_eye;
  for (const double frames : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0}) {
    const auto there = finder.find(eye + step * frames);
    if (!there || *there == region || there == out[0]) continue;
    if (out[0]) {
      out[1] = there;
      return out;
    }
    out[0] = there;
  }
  return out;
}

/// Asks for the regions ahead that are missing; false if none is.
bool RegionLists::State::expect(const Ahead& ahead) {
  bool missing = false;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    expected[i] = ahead[i] && slot_of(*ahead[i]) == nullptr ? ahead[i] : std::nullopt;
    missing = missing || expected[i];
  }
  return missing;
}

RegionLists::RegionLists(std::shared_ptr<const RegionFile> file, const RegionListsOptions& options,
                         std::span<const glm::uvec3> triangles) {
  const Product product = options.product;
  std::size_t most = 0;
  for (std::uint32_t r = 0; r < file->regions(); ++r) {
    most = std::max<std::size_t>(most, file->triangles(r, product));
  }
  const auto decode = [product, triangles](const RegionFile& of, std::uint32_t region,
                                           std::vector<std::uint32_t>& out) {
    if (product == Product::Colour) {
      of.decode_colour(region, triangles, out);
    } else {
      of.decode(region, product, out);
    }
  };
  state_ = std::make_unique<State>(std::move(file), decode, options);
  state_->start(most * 3);
}

RegionLists::RegionLists(std::shared_ptr<const RegionFile> file, Make make, const RegionListsOptions& options)
    : state_(std::make_unique<State>(std::move(file), std::move(make), options)) {
  state_->start(0);
}

RegionLists::~RegionLists() = default;

RegionList RegionLists::at(const glm::dvec3& eye_in_mesh) {
  State& s = *state_;
  const glm::dvec3 eye = s.file->frame().to_unit(eye_in_mesh);
  const auto region = s.finder.find(eye);
  const Ahead ahead = region && s.options.decode_ahead ? s.regions_ahead(eye, *region) : Ahead{};
  s.last_eye = region ? std::optional(eye) : std::nullopt;

  std::unique_lock lock(s.mutex);
  if (s.failure) std::rethrow_exception(s.failure);
  ++s.uses;
  s.gave_out = false;
  if (!region) return {};
  Slot* slot = s.slot_of(*region);
  if (slot == nullptr || slot->holds != Slot::Holds::List) {
    s.wanted = region;
    s.expect(ahead);
    s.asked.notify_one();
    if (!s.options.decode_at_once) return {};
    s.answered.wait(lock, [&] {
      slot = s.slot_of(*region);
      return s.failure || (slot != nullptr && slot->holds == Slot::Holds::List);
    });
    if (s.failure) std::rethrow_exception(s.failure);
  } else if (s.expect(ahead)) {
    s.asked.notify_one();
  }
  slot->last_use = s.uses;
  s.current = static_cast<std::size_t>(slot - s.slots.data());
  s.gave_out = true;
  return {slot->indices, false, slot->region, slot->serial};
}

void RegionLists::wait() {
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  s.answered.wait(lock, [&] {
    const bool decoding = std::any_of(s.slots.begin(), s.slots.end(),
                                      [](const Slot& slot) { return slot.holds == Slot::Holds::Decoding; });
    return s.failure || (!s.wanted && !s.expected[0] && !s.expected[1] && !decoding);
  });
}

}  // namespace rinkaku::silhouette
