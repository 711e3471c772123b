#include <charconv>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <gdal_priv.h>

#include "dem2buildings/error.hpp"
#include "make_scene.hpp"

namespace {

constexpr const char* usage =
    "Usage: d2b_make_scenes [-seed <n>] <folder> [<place>_<survey>...]\n"
    "Makes scenes with exact truth in a folder that exists, a folder a scene: dsm.tif, dtm.tif and\n"
    "reference_buildings.gpkg. Without names those that accuracy is measured on.\n";

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    std::uint64_t seed = 1;
    if (words.size() > 2 && words[0] == "-seed") {
        const auto [end, error] = std::from_chars(words[1].data(), words[1].data() + words[1].size(), seed);
        if (error != std::errc() || *end != '\0') {
            std::cerr << "d2b_make_scenes: -seed needs a whole number, not " << words[1] << ".\n";
            return 2;
        }
        words.erase(words.begin(), words.begin() + 2);
    }
    if (words.empty() || words[0].starts_with("-")) {
        std::cerr << usage;
        return 2;
    }
    try {
        GDALAllRegister();
        std::vector<d2b::sample::SceneChoice> chosen;
        for (std::size_t i = 1; i < words.size(); ++i)
            chosen.push_back(d2b::sample::choose_scene(words[i]));
        if (chosen.empty())
            chosen = d2b::sample::measured_scenes();
        for (const d2b::sample::SceneChoice& choice : chosen) {
            d2b::sample::make_scene(words[0], choice, seed);
            std::cout << choice.name() << std::endl;
        }
    } catch (const std::exception& error) {
        std::cerr << "d2b_make_scenes: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
