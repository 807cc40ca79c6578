#pragma once

#include <optional>
#include <string>

#include "apps/rinkaku/viewer/arrow_editor.h"
#include "pipeline/frame/picture_format.h"

namespace rinkaku::app {

/// Draws the editor's arrows over the picture that fills the window, and hands it what the mouse does there. Returns
/// the scene's new text when an arrow was drawn or moved. Needs ImGui's frame.
std::optional<std::string> arrow_overlay(ArrowEditor& editor, const PictureFormat& picture, float scale);

}  // namespace rinkaku::app
