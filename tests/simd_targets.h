// Runs a check on every instruction set this machine has, and without any.
#pragma once

#include <gtest/gtest.h>

#include <hwy/targets.h>

namespace tetsoup::test {

/// Calls body() with each of the targets forced; the name of the target is in the trace.
template <class Body>
void for_each_simd_target(const Body& body) {
  const std::int64_t supported = hwy::SupportedTargets();
  int targets = 0;
  for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    body();
    ++targets;
  }
  hwy::SetSupportedTargetsForTest(0);
  EXPECT_EQ(hwy::SupportedTargets(), supported);
  EXPECT_GE(targets, 2) << "only one target is built: nothing was compared";
}

}  // namespace tetsoup::test
