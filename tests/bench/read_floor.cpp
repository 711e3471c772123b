// The floor of reading: asks GDAL for every row of a raster once, on one thread, and does nothing with it.
#include <cstdlib>
#include <vector>

#include <gdal_priv.h>

int main(int argc, char** argv) {
    GDALAllRegister();
    GDALDataset* const dataset = argc == 2 ? GDALDataset::Open(argv[1]) : nullptr;
    if (dataset == nullptr)
        return EXIT_FAILURE;
    const int cols = dataset->GetRasterXSize();
    std::vector<float> row(static_cast<std::size_t>(cols));
    CPLErr done = CE_None;
    for (int r = 0; r < dataset->GetRasterYSize() && done == CE_None; ++r)
        done = dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, r, cols, 1, row.data(), cols, 1, GDT_Float32,
                                                   0, 0, nullptr);
    GDALClose(dataset);
    return done == CE_None ? EXIT_SUCCESS : EXIT_FAILURE;
}
