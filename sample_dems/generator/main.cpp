#include <exception>
#include <iostream>
#include <string_view>

#include "samples.hpp"

int main(int argc, char** argv) {
    if (argc != 2 || std::string_view(argv[1]).starts_with("-")) {
        std::cerr << "Usage: d2b_make_samples <folder>\nWrites the sample DEMs and their true footprints "
                     "into a folder "
                     "that exists.\n";
        return 2;
    }
    try {
        d2b::sample::make_samples(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << "d2b_make_samples: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
