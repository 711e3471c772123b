// Compares the pictures that the documents show with those that their commands make:
//   compare_pictures <pictures of the documents> <folder where the commands ran>
// Letters and noise may differ by a little; a picture of something else may not. Pictures that QGIS and a
// browser have made (qgis_*, page_*) are compared by the tests in tests/desk, those of the page on Python
// (python_*) in tests/python. pairs_of_pictures.py compares those of two previews (walls_*, worst_*,
// crowns_*, houses_* and raster_to_map), tests/bench/thesis those of the thesis (thesis_*), .ci/flow that of
// wind (wind_*), and .ci/long those of accuracy (accuracy_*).
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <gdal.h>

namespace {

namespace fs = std::filesystem;

/// Red, green and blue of every pixel, behind width and height; empty where it is no picture.
std::vector<int> read(const fs::path& path) {
    GDALDatasetH picture = GDALOpen(path.c_str(), GA_ReadOnly);
    if (picture == nullptr)
        return {};
    const int width = GDALGetRasterXSize(picture);
    const int height = GDALGetRasterYSize(picture);
    std::vector<int> values(2 + static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    values[0] = width;
    values[1] = height;
    if (GDALDatasetRasterIO(picture, GF_Read, 0, 0, width, height, &values[2], width, height, GDT_Int32, 3,
                            nullptr, 0, 0, 0) != CE_None)
        values.clear();
    GDALClose(picture);
    return values;
}

double share_of_difference(const std::vector<int>& one, const std::vector<int>& other) {
    constexpr int a_shade = 40;
    if (one.size() != other.size() || one.size() < 3 || one[0] != other[0])
        return 1;
    std::size_t different = 0;
    for (std::size_t i = 2; i < one.size(); ++i)
        different += std::abs(one[i] - other[i]) > a_shade ? 1U : 0U;
    return static_cast<double>(different) / static_cast<double>(one.size() - 2);
}

}  // namespace

int main(int argc, char** argv) {
    constexpr double most = 0.02;
    if (argc != 3) {
        std::cerr << "usage: compare_pictures <pictures> <folder of the commands>\n";
        return 2;
    }
    GDALAllRegister();
    int seen = 0;
    int wrong = 0;
    for (const auto& entry : fs::directory_iterator(argv[1])) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("qgis_") || name.starts_with("page_") || name.starts_with("python_") ||
            name.starts_with("walls_") || name.starts_with("worst_") || name.starts_with("thesis_") ||
            name.starts_with("accuracy_") || name.starts_with("crowns_") || name.starts_with("houses_") ||
            name.starts_with("wind_") || name.starts_with("raster_"))
            continue;
        ++seen;
        const double share = share_of_difference(read(entry.path()), read(fs::path(argv[2]) / name));
        std::cout << name << ": " << share << '\n';
        if (share > most) {
            std::cerr << name << " is not what the command makes now; look at the new one and copy it.\n";
            ++wrong;
        }
    }
    return seen > 0 && wrong == 0 ? 0 : 1;
}
