#include "common/roff.hpp"
#include "dem2buildings/help.hpp"
#include "dem2buildings/version.hpp"
#include "options/gdal_contour_options.hpp"

namespace d2b {
namespace {

std::string options() {
    std::string text = roff_section("OPTIONS");
    for (std::size_t group = 0; group < option_group_names.size(); ++group) {
        text += ".SS " + std::string(option_group_names[group]) + "\n";
        for (const OptionRow& row : option_table()) {
            if (row.hidden || row.group != static_cast<OptionGroup>(group))
                continue;
            const std::string facts = option_facts(row);
            text += roff_item(option_heading(row), row.help,
                              row.details + (row.details.empty() ? "" : " ") + facts);
        }
    }
    return text + gdal_man_section();
}

std::string contour_table() {
    std::string text =
        roff_section("OPTIONS OF GDAL_CONTOUR") +
        roff_paragraph("Command lines of gdal_contour(1) work where the option is the same or accepted.");
    for (const GdalContourOption& option : gdal_contour_options()) {
        const auto fate = std::string(option_support_names[static_cast<std::size_t>(option.fate)]);
        text += roff_item(option.synopsis,
                          fate + (option.note.empty() ? "" : ": ") + std::string(option.note) + ".");
    }
    return text;
}

}  // namespace

std::string man_page() {
    // Has no date, because the same sources must give the same page.
    std::string text =
        ".TH DEM2BUILDINGS 1 \"\" \"dem2buildings " + std::string(version) + "\"\n" + roff_section("NAME") +
        "dem2buildings \\- building footprints from an elevation raster\n" + roff_section("SYNOPSIS") +
        ".B dem2buildings\n[options] <src_raster>... <dst_vector>\n" + roff_section("DESCRIPTION") +
        roff_paragraph(
            "Finds the buildings of a city in an elevation raster (a digital surface model, DSM). Writes one "
            "polygon per building, and the contours of its parts from low to high.") +
        roff_paragraph(
            "The source is any raster that GDAL reads, or a folder of rasters, or several rasters on one "
            "grid, of which later ones cover earlier ones; the last file name is the destination, in any "
            "vector format that GDAL writes. An existing destination is refused without -overwrite or "
            "-append. After a failure a "
            "local destination keeps its old content.") +
        roff_paragraph(
            "Options may stand anywhere and begin with one dash or two; values follow after a "
            "blank or an equals sign. The sources stand before the destination. After -- only "
            "file names follow.");
    text += options() + contour_table();
    text += roff_section("EXIT STATUS") + roff_item("0", "Done; also if nothing was found, with a warning.") +
            roff_item("1", "Failed: the input cannot be read, the output not written, or memory is short.") +
            roff_item("2", "Wrong usage: an option, or one that does not fit the input or the destination.") +
            roff_item("130", "Interrupted (SIGINT); 143 after SIGTERM, 129 after SIGHUP.");
    text += roff_section("EXAMPLES") + roff_example("dem2buildings dsm.tif buildings.gpkg") +
            roff_example("dem2buildings -fl 10 20 30 -te 84000 446000 85000 447000 dsm.tif buildings.gpkg") +
            roff_example("dem2buildings -layers buildings -t_srs EPSG:4326 dsm.tif buildings.geojson");
    return text + roff_section("SEE ALSO") + "gdal_contour(1), gdalinfo(1), ogrinfo(1)\n";
}

}  // namespace d2b
