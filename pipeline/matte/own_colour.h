#pragma once

#include <opencv2/core.hpp>

#include "pipeline/frame/matte.h"
#include "pipeline/matte/picture.h"

namespace rinkaku::matte {

/// A thing's own colours along its soft edge, where nothing is known of what is behind it.
///
/// After Forte, "Approximate fast foreground colour estimation", 2021: own colour and background are first taken as
/// means of the surroundings, weighted by alpha and by its rest, and the own colour is then moved so that both together
/// give the picture. The means are found at half the resolution.
class OwnColours {
 public:
  /// Fills in matte.own_rgb where alpha is neither 0 nor 255. About 15 ns a pixel of matte.rect.
  void find(const Picture& picture, Matte& matte);

 private:
  cv::Mat own_, behind_, own_weight_, behind_weight_;
};

}  // namespace rinkaku::matte
