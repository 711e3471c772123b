#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "cli/option_effect.hpp"
#include "cli/town_errors.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
class PageErrors : public TownErrors {};

TEST_F(PageErrors, names) {
    refused(2, "Pages are written as HTML; give \"a.htm\" a name that ends in .html.", {"-page", "a.htm"});
    refused(1, "no file can be created in \"no/such\" (", {"-page", "no/such/a.html"});
    std::ofstream(path("other.html")) << "<!DOCTYPE html>\n<p>Dear diary\n";
    refused(2, "\"other.html\" exists; give another name, or -overwrite to replace it.",
            {"-page", "other.html"});
    refused(2, "\"other.html\" exists and is not a page of dem2buildings; remove it first.",
            {"-overwrite", "-page", "other.html"});
    std::filesystem::create_directory(path("folder.html"));
    refused(2, "is a folder, and a page is written as a file", {"-page", "folder.html"});
    refused(2, "'/vsimem/a.html' is in memory and lost when the program ends; give a file.",
            {"-page", "/vsimem/a.html"});
}

#ifdef D2B_PAGE

namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_F(OptionEffect, page) {
    find({"-page", "town.html"});
    const std::string page = text_of(path("town.html"));
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n<!-- A page of dem2buildings -->\n"));
    EXPECT_NE(page.find("<title>town</title>"), std::string::npos);
    EXPECT_TRUE(page.ends_with("</html>\n"));
    // The same on any number of threads.
    for (const char* threads : {"1", "4"}) {
        find({"-page", "town.html", "-threads", threads});
        EXPECT_EQ(text_of(path("town.html")), page);
    }
    // Layers are the same without it, and whatever of them is written the page has the stack.
    find({"-page", "blocks.html", "-layers", "buildings"});
    EXPECT_GT(text_of(path("blocks.html")).size(), page.size() - 1000);
    trace({"-overwrite", "-page", "thesis.html"});
    EXPECT_NE(text_of(path("thesis.html")).find("<title>"), std::string::npos);
}

TEST_F(PageErrors, coordinates) {
    refused(2,
            "-page needs coordinates in a unit of length, and those of 'WGS 84' are angles; convert them to "
            "a projected CRS with -t_srs, such as the UTM zone of the area.",
            {"-page", "a.html", "-t_srs", "EPSG:4326"});
}

TEST_F(PageErrors, replacesItsOwn) {
    find({"-page", "a.html"});
    run_well({"-preset", "buildings", "-q", "-overwrite", "-page", "a.html", "--", "town.tif", "o.gpkg"});
    EXPECT_FALSE(text_of(path("a.html")).empty());
}

#else

TEST_F(OptionEffect, page) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    expect_error(2,
                 "This dem2buildings was built without pages; leave -page out, or build it with -D "
                 "D2B_BUILD_PAGE=ON.",
                 {"-q", "-page", "a.html", "town.tif", "o.gpkg"});
}

#endif

}  // namespace d2b::test
