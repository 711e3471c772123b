#include "cli/option_effect.hpp"

namespace d2b::test {

TEST_F(GdalSwitchEffect, config) {
    const std::string last_change = "SELECT last_change FROM gpkg_contents WHERE table_name = 'buildings'";
    trace({"--config", "OGR_CURRENT_DATE", "2001-02-03T04:05:06.000Z"});
    EXPECT_EQ(sql_value(path("out.gpkg"), last_change), "2001/02/03 04:05:06+00");
    trace({"--config", "OGR_CURRENT_DATE=2011-02-03T04:05:06.000Z", "-overwrite"});
    EXPECT_EQ(sql_value(path("out.gpkg"), last_change), "2011/02/03 04:05:06+00");
}

TEST_F(GdalSwitchEffect, debug) {
    const ToolResult result = run({"--debug", "on", "-q", "blocks.tif", "out.gpkg"});
    EXPECT_EQ(result.status, 0);
    expect_has(result.err, "blocks.tif");
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(run({"--debug", "off", "-q", "-overwrite", "blocks.tif", "out.gpkg"}).err, "");
}

TEST_F(GdalSwitchEffect, formats) {
    const std::string text = run_well({"--formats"});
    expect_has(text, "GTiff -raster");
    expect_has(text, "GPKG -raster,vector");
}

TEST_F(GdalSwitchEffect, format) {
    const std::string text = run_well({"--format", "GPKG"});
    expect_has(text, "Short Name: GPKG");
    expect_error(2, "NoSuch", {"--format", "NoSuch"});
}

TEST_F(GdalSwitchEffect, optfile) {
    write_text(path("my.opt"), "# every point counts\n-nf 0\n-layers buildings\n");
    trace({"--optfile", "my.opt"});
    EXPECT_EQ(layer_names(path("out.gpkg")), std::vector<std::string>{"buildings"});
    EXPECT_EQ(buildings().records.size(), 3U);
    expect_error(2, "none.opt", {"--optfile", "none.opt", "blocks.tif", "other.gpkg"});
}

TEST_F(GdalSwitchEffect, help_general) {
    expect_has(run_well({"--help-general"}), "--optfile");
}

}  // namespace d2b::test
