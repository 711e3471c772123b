#include "options/contour_options.hpp"

#include <algorithm>

namespace d2b {
namespace {

constexpr std::string_view elevations = "elevations are always in the fields threshold, base and top";
constexpr std::array gdal_contour_rows{
    ContourOption{"b", "-b <band>", Fate::same, "the band that holds the elevations"},
    ContourOption{"a", "-a <field>", Fate::refused, elevations},
    ContourOption{"amin", "-amin <field>", Fate::refused,
                  "the lowest elevation is always in the field elev_min"},
    ContourOption{"amax", "-amax <field>", Fate::refused,
                  "the highest elevation is always in the field elev_max"},
    ContourOption{"3d", "-3d", Fate::same, "the threshold as Z"},
    ContourOption{"inodata", "-inodata", Fate::same, "NaN and infinite elevations stay no data"},
    ContourOption{"snodata", "-snodata <value>", Fate::same, "the value that stands for no data"},
    ContourOption{"f", "-f <format>", Fate::same, "an unknown extension without -f is an error"},
    ContourOption{"of", "-of <format>", Fate::same, "another name of -f"},
    ContourOption{"i", "-i <interval>", Fate::same,
                  "optional here: without -i and -fl, -lod sets the thresholds"},
    ContourOption{"off", "-off <offset>", Fate::same, "only together with -i"},
    ContourOption{"fl", "-fl <level> [<level>...]", Fate::same,
                  "not together with -i; MIN and MAX are no levels"},
    ContourOption{"e", "-e <base>", Fate::refused, "list the levels with -fl"},
    ContourOption{"nln", "-nln <name>", Fate::same, "the name of the layer"},
    ContourOption{"q", "-q, --quiet", Fate::same, "no progress and no summary"},
    ContourOption{"p", "-p", Fate::ignored, "polygons are always written"},
    ContourOption{"dsco", "-dsco <NAME>=<VALUE>", Fate::same, "a creation option of the format"},
    ContourOption{"lco", "-lco <NAME>=<VALUE>", Fate::same, "a creation option of the layers"},
    ContourOption{"oo", "-oo <NAME>=<VALUE>", Fate::same, "an open option of the input's format"},
    ContourOption{"gt", "-gt <n>|unlimited", Fate::refused, "the result is written as a whole or not at all"},
};

}  // namespace

std::span<const ContourOption> contour_options() {
    return gdal_contour_rows;
}

std::string contour_option_refusal(std::string_view name) {
    const auto option = std::ranges::find(gdal_contour_rows, name, &ContourOption::name);
    if (option == gdal_contour_rows.end() || option->fate != Fate::refused)
        return "";
    return "-" + std::string(name) + " of gdal_contour has no use here: " + std::string(option->note) + ".";
}

}  // namespace d2b
