#pragma once

namespace rinkaku::test {

/// How often operator new was called in this program so far. Apart from the tests, so that the compiler does not look
/// through it.
long allocations();

}  // namespace rinkaku::test
