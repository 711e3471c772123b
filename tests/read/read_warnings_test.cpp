#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "read/rasters.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;

/// A mosaic opens its files when they are read, and GDAL warns of an option that such a file does not have.
TEST_F(ReadTest, WhatReadingShowsWaitsForWhoAsks) {
    write(path("part.tif"), {.cols = 2, .rows = 2, .values = {1, 2, 3, 4}});
    write_text(path("dem.vrt"), R"(<VRTDataset rasterXSize="2" rasterYSize="2"><SRS>EPSG:25832</SRS>
<GeoTransform>0, 1, 0, 0, 0, -1</GeoTransform>
<VRTRasterBand dataType="Float64" band="1"><SimpleSource>
<SourceFilename relativeToVRT="1">part.tif</SourceFilename><OpenOptions><OOI key="NO_SUCH">1</OOI></OpenOptions>
<SourceBand>1</SourceBand><SourceProperties RasterXSize="2" RasterYSize="2" DataType="Float64" BlockXSize="2" BlockYSize="2"/>
<SrcRect xOff="0" yOff="0" xSize="2" ySize="2"/><DstRect xOff="0" yOff="0" xSize="2" ySize="2"/>
</SimpleSource></VRTRasterBand></VRTDataset>)");
    const auto source = open("dem.vrt");
    EXPECT_EQ(warnings_, Texts{});
    std::vector<double> elevations;
    std::thread([&] { elevations = read_all(*source); }).join();
    expect_values(elevations, {1, 2, 3, 4});
    EXPECT_EQ(warnings_, Texts{});
    EXPECT_EQ(source->take_warnings(), Texts{"GDAL: driver GTiff does not support open option NO_SUCH."});
    (void)read_all(*source);
    EXPECT_EQ(source->take_warnings(), Texts{});
}

}  // namespace
}  // namespace d2b::test
