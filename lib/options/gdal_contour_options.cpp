#include "options/gdal_contour_options.hpp"

#include <algorithm>

namespace d2b {
namespace {

constexpr std::string_view elevations = "elevations are always in the fields threshold, base and top";
constexpr std::array gdal_contour_rows{
    GdalContourOption{"b", "-b <band>", OptionSupport::same, "the band that holds the elevations"},
    GdalContourOption{"a", "-a <field>", OptionSupport::refused, elevations},
    GdalContourOption{"amin", "-amin <field>", OptionSupport::refused,
                      "the lowest elevation is always in the field elev_min"},
    GdalContourOption{"amax", "-amax <field>", OptionSupport::refused,
                      "the highest elevation is always in the field elev_max"},
    GdalContourOption{"3d", "-3d", OptionSupport::same, "the threshold as Z"},
    GdalContourOption{"inodata", "-inodata", OptionSupport::same, "NaN and infinite elevations stay no data"},
    GdalContourOption{"snodata", "-snodata <value>", OptionSupport::same,
                      "the value that stands for no data"},
    GdalContourOption{"f", "-f <format>", OptionSupport::same, "an unknown extension without -f is an error"},
    GdalContourOption{"of", "-of <format>", OptionSupport::same, "another name of -f"},
    GdalContourOption{"i", "-i <interval>", OptionSupport::same,
                      "optional here: without -i and -fl, -lod sets the thresholds"},
    GdalContourOption{"off", "-off <offset>", OptionSupport::same, "only together with -i"},
    GdalContourOption{"fl", "-fl <level> [<level>...]", OptionSupport::same,
                      "not together with -i; MIN and MAX are no levels"},
    GdalContourOption{"e", "-e <base>", OptionSupport::refused, "list the levels with -fl"},
    GdalContourOption{"nln", "-nln <name>", OptionSupport::same, "the name of the layer"},
    GdalContourOption{"q", "-q, --quiet", OptionSupport::same, "no progress and no summary"},
    GdalContourOption{"p", "-p", OptionSupport::ignored, "polygons are always written"},
    GdalContourOption{"dsco", "-dsco <NAME>=<VALUE>", OptionSupport::same, "a creation option of the format"},
    GdalContourOption{"lco", "-lco <NAME>=<VALUE>", OptionSupport::same, "a creation option of the layers"},
    GdalContourOption{"oo", "-oo <NAME>=<VALUE>", OptionSupport::same,
                      "an open option of the input's format"},
    GdalContourOption{"gt", "-gt <n>|unlimited", OptionSupport::refused,
                      "the result is written as a whole or not at all"},
};

}  // namespace

std::span<const GdalContourOption> gdal_contour_options() {
    return gdal_contour_rows;
}

std::string gdal_contour_refusal(std::string_view name) {
    const auto option = std::ranges::find(gdal_contour_rows, name, &GdalContourOption::name);
    if (option == gdal_contour_rows.end() || option->fate != OptionSupport::refused)
        return "";
    return "-" + std::string(name) + " of gdal_contour has no use here: " + std::string(option->note) + ".";
}

}  // namespace d2b
