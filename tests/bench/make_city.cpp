// Makes a square synthetic city of any size for benchmarks.
#include <cmath>
#include <exception>
#include <iostream>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "city_file.hpp"
#include "core/number_from_chars.hpp"

namespace {

constexpr std::string_view usage =
    "Usage: make_city [-cell <m>] [-seed <n>] [-threads <n>] <million points> <out.tif>\n"
    "Makes a square synthetic city: a DEM with so many points, or as many as a square has.\n";

struct Arguments {
    double million = 0;
    std::string path;
    d2b::bench::CitySpec city;
    int threads = static_cast<int>(std::thread::hardware_concurrency());
};

template <typename Number>
bool parse(std::string_view text, Number& number) {
    const auto [end, error] = d2b::number_from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size();
}

bool set(Arguments& arguments, std::string_view name, std::string_view value) {
    if (name == "-cell")
        return parse(value, arguments.city.cell) && arguments.city.cell > 0;
    if (name == "-seed")
        return parse(value, arguments.city.seed);
    return name == "-threads" && parse(value, arguments.threads) && arguments.threads > 0;
}

bool parse(std::span<char* const> words, Arguments& arguments) {
    std::vector<std::string_view> places;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string_view word = words[i];
        if (!word.starts_with('-'))
            places.push_back(word);
        else if (++i == words.size() || !set(arguments, word, words[i]))
            return false;
    }
    if (places.size() != 2 || !parse(places[0], arguments.million))
        return false;
    arguments.path = places[1];
    // Above this, rows would no longer fit into the bounds that the program promises.
    if (!(arguments.million > 0 && arguments.million <= 10000))
        return false;
    arguments.city.side = std::max(1, static_cast<int>(std::lround(1000 * std::sqrt(arguments.million))));
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    arguments.threads = std::max(arguments.threads, 1);
    if (!parse({argv, static_cast<std::size_t>(argc)}, arguments)) {
        std::cerr << usage;
        return 2;
    }
    try {
        d2b::bench::write_city(arguments.path, arguments.city, arguments.threads);
    } catch (const std::exception& error) {
        std::cerr << "make_city: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
