#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"

namespace rinkaku::test {

/// A test suite that draws: one headless context for all its tests. Skipped, saying why, where there is no OpenGL 4.5.
class GlTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    try {
      context_ = gl::Context::headless();
    } catch (const Error& error) {
      reason_ = error.what();
    }
  }
  static void TearDownTestSuite() { context_.reset(); }
  void SetUp() override {
    if (!context_) GTEST_SKIP() << reason_;
  }
  static const gl::Context& context() { return *context_; }

 private:
  inline static std::unique_ptr<gl::Context> context_;
  inline static std::string reason_;
};

}  // namespace rinkaku::test
