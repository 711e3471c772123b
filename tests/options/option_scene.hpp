#pragma once

#include <string>

#include <gtest/gtest.h>

#include "options/option_cases.hpp"

namespace d2b::test {

/// A small town in /vsimem/scene/: dem.tif of two bands and with a NoData value, dtm.tif, ndvi.tif,
/// areas.gpkg with the layers west and north, and masks.gpkg with east and middle. In it stand houses of
/// several sizes, a gabled one, two that share a wall, a round tower, a tower on a podium, rubble and a wood.
class OptionScene : public ::testing::Test {
  protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();
};

/// Result of a run.
struct Outcome {
    std::string written;  ///< layers with all features, and rasters; "" where it was refused
    std::string error;    ///< the message; "" where there was none
    bool finite = true;   ///< all numbers
    std::string options;  ///< that the provenance names

    /// Whatever the options were called.
    friend bool operator==(const Outcome& one, const Outcome& other) {
        return one.written == other.written && one.error == other.error && one.finite == other.finite;
    }
};

/// Runs a command line on the scene, in this process and into memory.
[[nodiscard]] Outcome outcome_of(const Texts& words);

}  // namespace d2b::test
