#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <cpl_conv.h>
#include <gdal_priv.h>

#include "dem2buildings/error.hpp"
#include "make_scene.hpp"

namespace {

constexpr const char* usage =
    "Usage: d2b_make_scenes [-seed <n>] [-cell <m>] [-pulses <n>] [-later <survey>] [-east <m>] [-north "
    "<m>]\n"
    "                       <folder> [<place>_<survey>...]\n"
    "Makes scenes with exact truth in a folder that exists, a folder a scene: dsm.tif, dtm.tif and\n"
    "reference_buildings.gpkg. Without names those that accuracy is measured on.\n"
    "-cell and -pulses replace the cell size and the pulses a square metre of the surveys; with 0 pulses\n"
    "the surface itself is measured at the middles of cells.\n"
    "-later surveys each place twice, before and after changes: old.tif, new.tif and changes.gpkg with what\n"
    "changed. -east and -north displace the second raster.\n";

/// Options that may precede the folder.
struct Choices {
    std::uint64_t seed = 1;
    std::optional<double> cell;
    std::optional<double> pulses;
    std::string later;  ///< survey; "": none
    double east = 0;
    double north = 0;
};

bool read(const std::string& word, std::uint64_t& number) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && *end == '\0';
}

/// Reads a number with a decimal point in any locale.
bool read(const std::string& word, double& number) {
    char* end = nullptr;
    number = CPLStrtod(word.c_str(), &end);
    return !word.empty() && *end == '\0';
}

constexpr std::array number_options{"-cell", "-pulses", "-east", "-north"};

bool is_option(const std::string& word) {
    return word == "-seed" || word == "-later" ||
           std::find(number_options.begin(), number_options.end(), word) != number_options.end();
}

/// Takes an option and its value off the words. @return the fault in it; "" if there is none
std::string take_option(std::vector<std::string>& words, Choices& choices) {
    const std::string option = words[0];
    const std::string value = words[1];
    words.erase(words.begin(), words.begin() + 2);
    if (option == "-seed")
        return read(value, choices.seed) ? "" : "-seed needs a whole number, not " + value + ".";
    if (option == "-later") {
        choices.later = value;
        return "";
    }
    double number = 0;
    const bool good = read(value, number) && number <= 1000;
    if (option == "-cell") {
        choices.cell = number;
        return good && number >= 0.1 ? "" : "-cell needs a number of 0.1 to 1000, not " + value + ".";
    }
    if (option == "-pulses") {
        choices.pulses = number;
        return good && number >= 0 ? "" : "-pulses needs a number of 0 to 1000, not " + value + ".";
    }
    (option == "-east" ? choices.east : choices.north) = number;
    return good && number >= -1000 ? "" : option + " needs a number of -1000 to 1000, not " + value + ".";
}

void make_scenes(const std::vector<std::string>& words, const Choices& choices) {
    using namespace d2b::sample;
    GDALAllRegister();
    std::vector<SceneChoice> chosen;
    for (std::size_t i = 1; i < words.size(); ++i)
        chosen.push_back(choose_scene(words[i]));
    if (chosen.empty())
        chosen = measured_scenes();
    for (SceneChoice& choice : chosen) {
        choice.survey.cell = choices.cell.value_or(choice.survey.cell);
        choice.survey.pulses = choices.pulses.value_or(choice.survey.pulses);
        if (choices.later.empty())
            make_scene(words[0], choice, choices.seed);
        else
            make_changed_scene(words[0], choice, {choose_survey(choices.later), choices.east, choices.north},
                               choices.seed);
        std::cout << choice.name() << std::endl;
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    Choices choices;
    while (words.size() > 2 && is_option(words[0]))
        if (const std::string wrong = take_option(words, choices); !wrong.empty()) {
            std::cerr << "d2b_make_scenes: " << wrong << '\n';
            return 2;
        }
    if (words.empty() || words[0].starts_with("-")) {
        std::cerr << usage;
        return 2;
    }
    try {
        make_scenes(words, choices);
    } catch (const std::exception& error) {
        std::cerr << "d2b_make_scenes: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
