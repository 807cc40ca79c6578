#pragma once

#include <string>

#include <gtest/gtest.h>

namespace rinkaku::pipeline {

/// A scene that is refused, and the line that says why; DIR stands for its folder.
struct BadScene {
  std::string name;
  std::string text;
  std::string message;
};

class BadSceneTest : public testing::TestWithParam<BadScene> {};

inline std::string test_name(const testing::TestParamInfo<BadScene>& info) { return info.param.name; }

}  // namespace rinkaku::pipeline
