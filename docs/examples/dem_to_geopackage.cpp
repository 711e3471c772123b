// From a file to a GeoPackage, with options: what the program does with them, in a program of one's own.
//   dem_to_geopackage <dem> <destination>

#include <dem2buildings/dem2buildings.hpp>
#include <exception>
#include <iostream>
#include <memory>
#include <string>

namespace {

void convert(const std::string& source, const std::string& destination) {
    d2b::Options options;
    options.read.source = source;
    options.write.destination = destination;
    options.write.overwrite = true;
    options.filter.min_area_m2 = 50;         // by field ...
    d2b::set_option(options, "lod", {"3"});  // ... or as on the command line, checked in the same way

    d2b::Callbacks callbacks;
    callbacks.on_warning = [](const std::string& text) { std::cerr << "Warning: " << text << '\n'; };
    callbacks.make_spool = [] { return std::make_unique<d2b::FileSpool>(); };

    const auto dem = d2b::open_dem(options.read, callbacks);
    const auto sink = d2b::open_sink(options.write, callbacks);
    const d2b::RunReport report = d2b::run(options, {*dem}, {*sink}, callbacks);
    std::cout << report.buildings << " buildings, " << report.contours << " contours in '" << report.output
              << "'\n";
}

}  // namespace

int main(int argc, char* argv[]) {
    if (argc != 3) {
        std::cerr << "usage: dem_to_geopackage <dem> <destination>\n";
        return 2;
    }
    try {
        convert(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
