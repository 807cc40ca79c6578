// In place of painted water, filmed things and fluff: linked before their libraries, so that nothing of them is in the
// program. No scene of rinkaku-bench-leaving-out asks for them.

#include "pipeline/frame/error.h"
#include "pipeline/objects/fluff.h"
#include "pipeline/stages/filmed_things.h"
#include "pipeline/stages/water_stage.h"

namespace rinkaku::pipeline {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw input_error("this program", std::string("was built without ") + what, "use rinkaku");
}

}  // namespace

struct WaterStage::Parts {};
WaterStage::WaterStage(const Scene&, const CameraModel&, double, Drawing&) { refuse("water"); }
WaterStage::~WaterStage() = default;
WaterStage::WaterStage(WaterStage&&) noexcept = default;
std::int64_t WaterStage::first_remembered(std::int64_t frame) const { return frame; }
void WaterStage::look(const Frame&, const RigidTransform&, double) {}
const std::vector<std::string>& WaterStage::notices() const { refuse("water"); }

struct FilmedThings::Thing {};
FilmedThings::FilmedThings(const Prepared&, const source::Description&) { refuse("foregrounds"); }
FilmedThings::~FilmedThings() = default;
void FilmedThings::find(Work&) {}
double cut_m(const Matte& matte) { return matte.distance_m; }

Fluff prepare_fluff(const ObjectScene&, const mesh::Mesh&, const glm::dmat4&) { refuse("fluff"); }
void thin_line_under_fluff(passes::LineStyle&, std::vector<float>&, const ObjectScene&, const mesh::Mesh&) {}
void add_fluff(passes::StyledObject&, const Fluff&, const ObjectScene&, const LightScene&) {}
mesh::Box with_fluff(const mesh::Box& body, const Fluff&, const glm::dmat4&) { return body; }

}  // namespace rinkaku::pipeline
