#pragma once

#include "cli/cli_test_case.hpp"

namespace d2b::test {

/// Tests of this suite are named after the option that they test, "__" and more may follow: coverage_test.cpp
/// asks for one of every option in the table. All show the effect of an option on the result.
class OptionEffect : public CliTest {
  protected:
    void SetUp() override;
    /// Runs on the DEM of blocks() with levels of 5 and 15 unless the arguments say others. @return stdout
    std::string trace(Arguments arguments) const;
    /// Looks for buildings on a made town (tests/pipeline/made_town.hpp) in metres of EPSG:25833, town.tif,
    /// and replaces the buildings found before. @return stdout
    std::string find(Arguments arguments) const;
    [[nodiscard]] Layer buildings() const { return layer("out.gpkg", "buildings"); }
    [[nodiscard]] Layer contours() const { return layer("out.gpkg", "contours"); }
};

/// The same for the switches that GDAL's programs share.
class GdalSwitchEffect : public OptionEffect {};

}  // namespace d2b::test
