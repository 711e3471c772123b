#pragma once

#include "cli/option_effect.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {

/// Errors of the preset buildings on the made town.
class TownErrors : public OptionEffect {
  protected:
    void SetUp() override {
        OptionEffect::SetUp();
        write(path("town.tif"), town_raster(MadeTown::surface()));
    }
    void refused(int status, const std::string& part, const Arguments& options) const {
        Arguments arguments{"-preset", "buildings", "-q"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        arguments.insert(arguments.end(), {"--", "town.tif", "o.gpkg"});
        expect_error(status, part, arguments);
    }
};

}  // namespace d2b::test
