#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "options/gdal_contour_options.hpp"
#include "tools/parse.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;
using Case = std::pair<Texts, std::string>;

void expect_refusals(const std::vector<Case>& cases) {
    for (const auto& [arguments, message] : cases)
        EXPECT_EQ(refusal(arguments), message) << arguments.front();
}

TEST(OptionErrors, wholeNumbers) {
    for (const char* text :
         {"x", "0", "10001", "-4", "4.0", "4x", "1e2", "nan", "99999999999999999999", "0x4", "++4"})
        EXPECT_EQ(refusal({"-lod", text}),
                  std::string("-lod must be a whole number from 1 to 10000, not '") + text + "'.");
    expect_refusals(
        {{{"-b", "0"}, "-b must be a whole number from 1 to 65536, not '0'."},
         {{"-b", "one"}, "-b must be a whole number from 1 to 65536, not 'one'."},
         {{"-nf", "-1"}, "-nf must be a whole number from 0 to 1000000000, not '-1'."},
         {{"-nf", "2147483648"}, "-nf must be a whole number from 0 to 1000000000, not '2147483648'."}});
}

// Found by tests/fuzz: it came through as an exception of Boost's that named all options there are.
TEST(OptionErrors, anOptionWithoutAName) {
    for (const char* option : {"-=", "--=", "-=rcwin", "--=x"})
        EXPECT_EQ(refusal({option, "a.tif", "b.gpkg"}),
                  "An option has no name before its =; dem2buildings --help lists all.");
}

TEST(OptionErrors, numbers) {
    for (const char* text : {"x", "nan", "inf", "-inf", "1e999", "5m", "1,5"})
        EXPECT_EQ(refusal({"-snodata", text}), std::string("-snodata must be a number, not '") + text + "'.");
    expect_refusals(
        {{{"-i", "0"}, "-i must be a number above 0, not '0'."},
         {{"-i", "-2"}, "-i must be a number above 0, not '-2'."},
         {{"-i", "2", "-off", "x"}, "-off must be a number, not 'x'."},
         {{"-min_area", "-0.5"}, "-min_area must be a number of at least 0, not '-0.5'."},
         {{"-simplify", "-1"}, "-simplify must be a number of at least 0, not '-1'."},
         {{"-min_height", "-1"}, "-min_height must be a number of at least 0, not '-1'."},
         {{"-split_height", "-1"}, "-split_height must be a number of at least 0, not '-1'."},
         {{"-min_confidence", "1.5"}, "-min_confidence must be a number from 0 to 1, not '1.5'."},
         {{"-min_confidence", "-0.1"}, "-min_confidence must be a number from 0 to 1, not '-0.1'."},
         {{"-max_building_width", "0"},
          "-max_building_width must be a number above 0 and at most 100000, not '0'."},
         {{"-regularize_tolerance", "101"},
          "-regularize_tolerance must be a number above 0 and at most 100, not '101'."},
         {{"-wall_inset", "-0.1"}, "-wall_inset must be a number from 0 to 1, not '-0.1'."},
         {{"-wall_inset", "1.1"}, "-wall_inset must be a number from 0 to 1, not '1.1'."},
         {{"-zunit", "yard"},
          "-zunit must be m, ft, us-ft or a number above 0 (metres in one unit), not 'yard'."},
         {{"-zunit", "0"},
          "-zunit must be m, ft, us-ft or a number above 0 (metres in one unit), not '0'."}});
}

TEST(OptionErrors, twoNumbers) {
    const std::string zrange = "-zrange must be two numbers, the lowest below the highest, not ";
    expect_refusals({{{"-zrange", "5", "5"}, zrange + "'5 5'."},
                     {{"-zrange", "5", "-5"}, zrange + "'5 -5'."},
                     {{"-zrange", "0", "nan"}, zrange + "'0 nan'."},
                     {{"-zrange", "0", "1e999"}, zrange + "'0 1e999'."},
                     {{"-zrange", "0", "9,5"}, zrange + "'0 9,5'."}});
}

TEST(OptionErrors, fourNumbers) {
    const std::string srcwin = "-srcwin must be four whole numbers, columns and rows above 0, not ";
    const std::string projwin = "-projwin must be four numbers, ulx below lrx and uly above lry, not ";
    const std::string te = "-te must be four numbers, xmin below xmax and ymin below ymax, not ";
    expect_refusals(
        {{{"-srcwin", "0", "0", "0", "5"}, srcwin + "'0 0 0 5'."},
         {{"-srcwin", "0", "0", "5", "-1"}, srcwin + "'0 0 5 -1'."},
         {{"-srcwin", "0.5", "0", "5", "5"}, srcwin + "'0.5 0 5 5'."},
         {{"-srcwin", "0", "a", "5", "5"}, srcwin + "'0 a 5 5'."},
         {{"-projwin", "1", "1", "1", "0"}, projwin + "'1 1 1 0'."},
         {{"-projwin", "0", "0", "1", "1"}, projwin + "'0 0 1 1'."},
         {{"-te", "0", "0", "nan", "1"}, te + "'0 0 nan 1'."},
         {{"-te", "0", "0", "0", "1"}, te + "'0 0 0 1'."},
         {{"-te", "1", "0", "0", "1"}, te + "'1 0 0 1'."},
         {{"-te", "0", "2", "1", "1"},
          "-te takes xmin ymin xmax ymax, and 0 2 1 1 is the upper left and the lower right corner, as "
          "-projwin takes them; write -te 0 1 1 2."},
         {{"-te", "1", "2", "3"}, te + "'1 2 3 in.tif'."}});
}

TEST(OptionErrors, words) {
    expect_refusals({{{"-preset", "other"}, "-preset must be buildings or thesis, not 'other'."},
                     {{"-trace", "lines"}, "-trace must be points or cells, not 'lines'."},
                     {{"-layers", "all"}, "-layers must be buildings, contours or both, not 'all'."},
                     {{"-levels", "all"}, "-levels must be building, natural or global, not 'all'."},
                     {{"-regularize", "yes"}, "-regularize must be auto, off, right or free, not 'yes'."},
                     {{"-fields", "gml"}, "-fields must be own, urock, city4cfd or osm, not 'gml'."},
                     {{"-oo", "NAME"}, "-oo must be NAME=VALUE, not 'NAME'."},
                     {{"-oo", "=1"}, "-oo must be NAME=VALUE, not '=1'."},
                     {{"-dsco", "NAME"}, "-dsco must be NAME=VALUE, not 'NAME'."},
                     {{"-co", "NAME"}, "-dsco must be NAME=VALUE, not 'NAME'."},
                     {{"-lco", "NAME"}, "-lco must be NAME=VALUE, not 'NAME'."}});
}

TEST(OptionErrors, levels) {
    expect_refusals({{{"-fl", "1", "nan"}, "-fl must be numbers, not 'nan'."},
                     {{"-fl", "MIN", "1"}, "-fl must be numbers, not 'MIN'."},
                     {{"-fl", "1", "MAX"}, "-fl must be numbers, not 'MAX'."},
                     {{"-fl=x"}, "-fl must be numbers, not 'x'."},
                     {{"-fl", "1e999"}, "-fl must be numbers, not '1e999'."},
                     {{"-fl"}, "-fl must be numbers, not 'in.tif'."},
                     {{"-fl", "-q"}, "-fl needs at least one value: -fl <level> [<level>...]."}});
}

TEST(OptionErrors, missingValues) {
    expect_refusals({{{"-nln", "-q"}, "-nln needs a value: -nln <name>."},
                     {{"-nln", "-te", "0", "0", "1", "1"}, "-nln needs a value: -nln <name>."},
                     {{"-nln="}, "-nln needs a value: -nln <name>."},
                     {{"-nln", ""}, "-nln needs a value: -nln <name>."},
                     {{"-lod", "-x"}, "-lod needs a value: -lod <n>."},
                     {{"-te", "0", "0", "-q"}, "-te needs 4 values: -te <xmin> <ymin> <xmax> <ymax>."},
                     {{"-te="}, "-te needs 4 values: -te <xmin> <ymin> <xmax> <ymax>."},
                     {{"-te", "0", "", "1", "1"}, "-te needs 4 values: -te <xmin> <ymin> <xmax> <ymax>."}});
    const Texts at_the_end{"in.tif", "out.gpkg"};
    const auto last = [&at_the_end](const std::string& option) {
        Texts arguments = at_the_end;
        arguments.push_back(option);
        return refusal_of_all(arguments);
    };
    EXPECT_EQ(last("-nln"), "-nln needs a value: -nln <name>.");
    EXPECT_EQ(last("--of"), "-f needs a value: -f <format>.");
    EXPECT_EQ(last("-fl"), "-fl needs at least one value: -fl <level> [<level>...].");
    EXPECT_EQ(last("-srcwin"), "-srcwin needs 4 values: -srcwin <column> <row> <columns> <rows>.");
    EXPECT_EQ(refusal_of_all({"-nln", "--", "in.tif", "out.gpkg"}), "-nln needs a value: -nln <name>.");
}

TEST(OptionErrors, everyOptionThatNeedsAValueSaysSo) {
    for (const OptionRow& row : option_table())
        if (row.arity != Arity::none) {
            const std::string message = refusal_of_all({"in.tif", "out.gpkg", "-" + row.name});
            EXPECT_TRUE(message.starts_with("-" + row.name + " needs ")) << message;
            EXPECT_TRUE(message.ends_with(": -" + row.name + " " + row.values + ".")) << message;
        }
}

TEST(OptionErrors, switchesTakeNoValue) {
    expect_refusals({{{"-q=1"}, "-q takes no value."},
                     {{"--overwrite=yes"}, "-overwrite takes no value."},
                     {{"-3d="}, "-3d takes no value."}});
}

TEST(OptionErrors, givenTwice) {
    expect_refusals({{{"-lod", "4", "-lod", "5"}, "-lod is given twice; give it once."},
                     {{"-f", "GPKG", "-of", "GPKG"}, "-f is given twice; give it once."}});
    EXPECT_TRUE(parse({"-q", "-q"}).tool.quiet);
}

TEST(OptionErrors, conflicts) {
    const std::string one_window = "; give one of -srcwin, -projwin and -te.";
    expect_refusals(
        {{{"-fl", "1", "-i", "2"},
          "-fl cannot be used together with -i; list the levels or give an interval."},
         {{"-lod", "4", "-fl", "1"},
          "-lod cannot be used together with -fl; the listed levels take the place of those of -lod."},
         {{"-lod", "4", "-i", "1"},
          "-lod cannot be used together with -i; the interval takes the place of -lod."},
         {{"-off", "0"}, "-off needs -i <interval>; it is the elevation that the intervals count from."},
         {{"-fl", "1", "-off", "2"},
          "-off needs -i <interval>; it is the elevation that the intervals count from."},
         {{"-overwrite", "-append"},
          "-overwrite cannot be used together with -append; replace the layers or add to them."},
         {{"-snodata", "0", "-inodata"},
          "-snodata cannot be used together with -inodata; set a NoData value or ignore it."},
         {{"-te", "0", "0", "1", "1", "-srcwin", "0", "0", "1", "1"},
          "-srcwin cannot be used together with -te" + one_window},
         {{"-projwin", "0", "1", "1", "0", "-srcwin", "0", "0", "1", "1"},
          "-srcwin cannot be used together with -projwin" + one_window},
         {{"-projwin", "0", "1", "1", "0", "-te", "0", "0", "1", "1"},
          "-projwin cannot be used together with -te" + one_window}});
}

TEST(OptionErrors, unknownOptions) {
    expect_refusals({{{"-lodd", "4"}, "There is no option -lodd; did you mean -lod?"},
                     {{"--LOD=4"}, "There is no option --LOD; did you mean -lod?"},
                     {{"-min-area", "4"}, "There is no option -min-area; did you mean -min_area?"},
                     {{"-over"}, "There is no option -over; did you mean -overwrite?"},
                     {{"-config", "A=B"}, "There is no option -config; did you mean --config?"},
                     {{"-frobnicate"}, "There is no option -frobnicate; dem2buildings --help lists all."},
                     {{"--x="}, "There is no option --x; dem2buildings --help lists all."},
                     {{"-5"}, "There is no option -5; dem2buildings --help lists all."}});
}

TEST(OptionErrors, optionsOfGdalContour) {
    expect_refusals(
        {{{"-a", "ELEV"},
          "-a of gdal_contour has no use here: elevations are always in the fields threshold, base and top."},
         {{"-amin", "LOW"},
          "-amin of gdal_contour has no use here: the lowest elevation is always in the field elev_min."},
         {{"--amax=HIGH"},
          "-amax of gdal_contour has no use here: the highest elevation is always in the field elev_max."},
         {{"-e", "2"}, "-e of gdal_contour has no use here: list the levels with -fl."},
         {{"-gt", "unlimited"},
          "-gt of gdal_contour has no use here: the result is written as a whole or not at all."}});
}

TEST(OptionErrors, everyOptionOfGdalContourHasItsFate) {
    for (const GdalContourOption& option : gdal_contour_options()) {
        const bool known = find_option(option.name) != nullptr;
        EXPECT_EQ(known, option.fate != OptionSupport::refused) << option.name;
        EXPECT_EQ(gdal_contour_refusal(option.name).empty(), option.fate != OptionSupport::refused)
            << option.name;
    }
}

TEST(OptionErrors, fileNames) {
    const std::string usage = "usage: dem2buildings [options] <src_raster> <dst_vector>.";
    EXPECT_EQ(refusal_of_all({}), "The source and the destination are missing; " + usage);
    EXPECT_EQ(refusal_of_all({"-q"}), "The source and the destination are missing; " + usage);
    EXPECT_EQ(refusal_of_all({"a.tif"}), "The destination is missing, there is only 'a.tif'; " + usage);
    EXPECT_EQ(refusal_of_all({"a", "b", "c"}),
              "There are too many file names, 'a', 'b' and 'c'; give one source and one destination.");
    EXPECT_EQ(refusal_of_all({"", "b"}), "A file name is empty; " + usage);
    EXPECT_EQ(refusal_of_all({"-", "b"}), "'-' is no file name here; write /vsistdin/ or /vsistdout/.");
    EXPECT_EQ(refusal_of_all({"a.tif", "a.tif"}),
              "The destination 'a.tif' is the source; give another name.");
    EXPECT_EQ(refusal_of_all({"-json", "a.tif", "/vsistdout/"}),
              "-json cannot be used with a destination in /vsistdout/; both would write to stdout.");
}

TEST(OptionErrors, leaveWhatWasSetBefore) {
    Request request;
    const Texts good{"1", "2"};
    const Texts bad{"3", "x"};
    apply_option(*find_option("fl"), request, good);
    EXPECT_THROW(apply_option(*find_option("fl"), request, bad), OptionError);
    EXPECT_EQ(request.options.levels.fixed, (std::vector<double>{1, 2}));
}

}  // namespace
}  // namespace d2b::test
