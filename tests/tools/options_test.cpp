#include <array>
#include <clocale>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "options/gdal_contour_options.hpp"
#include "options/option_checks.hpp"
#include "options/option_values.hpp"
#include "tools/parse.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;
using Four = std::array<double, 4>;

TEST(OptionTable, saysAllOfEveryOption) {
    std::set<std::string> names;
    for (const OptionRow& row : option_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        for (const std::string& alias : row.aliases)
            EXPECT_TRUE(names.insert(alias).second) << alias;
        EXPECT_FALSE(row.help.empty()) << row.name;
        EXPECT_EQ(row.help.back(), '.') << row.name;
        EXPECT_EQ(row.title.empty(), row.hidden) << row.name;
        EXPECT_TRUE(row.details.empty() || row.details.back() == '.') << row.name;
        EXPECT_EQ(row.values.empty(), row.arity == Arity::none) << row.name;
        EXPECT_TRUE(row.apply) << row.name;
        EXPECT_TRUE(row.texts) << row.name;
        EXPECT_EQ(row.kind == OptionKind::toggle, row.arity == Arity::none) << row.name;
        EXPECT_EQ(row.has_meaning(Preset::thesis), row.scope.why.empty()) << row.name;
        EXPECT_TRUE(row.has_meaning(Preset::buildings)) << row.name;
    }
}

TEST(OptionTable, namesEachWordOfAChoiceOnce) {
    const auto choices = [](const char* name) { return find_option(name)->choices; };
    EXPECT_EQ(choices("preset"), (Texts{"buildings", "thesis"}));
    EXPECT_EQ(choices("ground"), (Texts{"auto", "none"}));
    EXPECT_EQ(find_option("ground")->values, "auto|none|<terrain model>");
    EXPECT_EQ(choices("zunit"), (Texts{"m", "ft", "us-ft"}));
    for (const OptionRow& row : option_table()) {
        if (row.kind != OptionKind::choice)
            continue;
        EXPECT_EQ(row.values, joined(row.choices, "|")) << row.name;
        EXPECT_EQ(row.range, alternatives(row.choices)) << row.name;
        EXPECT_TRUE(row.choice_titles.empty() || row.choice_titles.size() == row.choices.size()) << row.name;
        for (const std::string& word : row.choices) {
            Request request;
            const Texts text{word};
            apply_option(row, request, text);
            EXPECT_EQ(row.show(request), word) << row.name;
        }
    }
}

/// Titles that a dialog shows in place of the names of options.
TEST(OptionTable, hasTitlesThatADialogTellsApart) {
    std::set<std::string> titles;
    for (const OptionRow& row : option_table()) {
        if (row.hidden)
            continue;
        EXPECT_TRUE(titles.insert(row.title).second) << row.title;
        EXPECT_TRUE(std::isupper(row.title.front())) << row.title;
        EXPECT_EQ(row.title.find_first_of(".-\""), std::string::npos) << row.title;
    }
}

/// Names of arguments of Python: none is a keyword, or a parameter of extract() itself.
TEST(OptionTable, hasNamesThatPythonCanSpell) {
    const std::set<std::string> taken{"if",  "in",  "is",  "as",        "or",       "not", "and", "lambda",
                                      "for", "def", "dem", "transform", "progress", "src", "dst"};
    std::set<std::string> names;
    for (const OptionRow& row : option_table()) {
        const PythonUse& python = row.python;
        EXPECT_EQ(python.name.empty(), !python.extract && !python.extract_file) << row.name;
        EXPECT_TRUE(!python.extract || python.extract_file) << row.name;
        if (python.name.empty())
            continue;
        EXPECT_TRUE(std::regex_match(python.name, std::regex("[a-z][a-z_0-9]*"))) << row.name;
        EXPECT_FALSE(taken.contains(python.name)) << row.name;
        EXPECT_TRUE(names.insert(python.name).second) << row.name;
    }
}

TEST(OptionTable, knowsWhatWasGiven) {
    const OptionRow& row = *find_option("min_height");
    Request request;
    EXPECT_FALSE(row.is_given(request));
    request.options.detect.min_height = 3;
    EXPECT_TRUE(row.is_given(request));
    Request by_name;
    const Texts text{"2"};  // its default
    apply_option(row, by_name, text);
    EXPECT_TRUE(row.is_given(by_name));
    EXPECT_EQ(row.show(by_name), row.standard);
}

TEST(OptionTable, findsNamesWithDashesAndAliases) {
    EXPECT_EQ(find_option("lod")->name, "lod");
    EXPECT_EQ(find_option("-lod")->name, "lod");
    EXPECT_EQ(find_option("--output_format")->name, "f");
    EXPECT_EQ(find_option("lo"), nullptr);
    EXPECT_EQ(find_option("---lod"), nullptr);
    EXPECT_EQ(find_option(""), nullptr);
}

TEST(OptionTable, defaultAsTextSetsTheDefault) {
    for (const OptionRow& row : option_table()) {
        if (row.standard.empty())
            continue;
        Request request;
        const Texts text{row.standard};
        apply_option(row, request, text);
        EXPECT_EQ(row.show(request), row.standard) << row.name;
    }
}

TEST(Options, withoutAnyAreTheDefaults) {
    const Request request = parse({});
    for (const OptionRow& row : option_table())
        EXPECT_EQ(row.show(request), row.standard) << row.name;
    EXPECT_EQ(request.options.read.source, "in.tif");
    EXPECT_EQ(request.options.write.destination, "out.gpkg");
    EXPECT_EQ(request.options.write.layers, std::nullopt);
}

TEST(Options, gapsAndWallsFollowFlowReady) {
    const auto outline = [](const Texts& arguments) { return parse(arguments).options.outline; };
    EXPECT_EQ(outline({"-flow_ready", "1.5"}).narrowest_gap(), 1.5);
    EXPECT_EQ(outline({"-flow_ready", "1.5"}).shortest_wall(), 1.5);
    EXPECT_EQ(outline({"-flow_ready", "1.5", "-min_gap", "0"}).narrowest_gap(), 0);
    EXPECT_EQ(outline({"-min_wall", "0.5"}).shortest_wall(), 0.5);
    EXPECT_EQ(outline({"-min_wall", "0.5"}).narrowest_gap(), 0);
}

TEST(Options, ofTheGround) {
    const auto ground = [](const Texts& arguments) { return parse(arguments).options.ground; };
    EXPECT_EQ(ground({}).mode, std::nullopt);
    EXPECT_EQ(ground({"-ground", "auto"}).mode, GroundMode::automatic);
    EXPECT_EQ(ground({"-ground", "none"}).mode, GroundMode::none);
    EXPECT_EQ(ground({"-ground", "none"}).terrain, "");
    for (const char* file : {"dtm.tif", "./auto", "./none"}) {
        EXPECT_EQ(ground({"-ground", file}).mode, GroundMode::given) << file;
        EXPECT_EQ(ground({"-ground", file}).terrain, file);
        EXPECT_EQ(find_option("ground")->show(parse({"-ground", file})), file);
    }
    EXPECT_EQ(ground({"-max_building_width", "120.5"}).max_building_width, 120.5);
}

TEST(Options, aSweepIsEveryPairOfItsNumbers) {
    const auto sweep_of = [](const std::string& text) { return parse_sweep(text); };
    using Values = std::vector<std::string>;
    const auto values_of = [&](const std::string& text) {
        const SweepPlan plan = sweep_of(text);
        return plan.options.empty() ? Values{} : plan.options.front().values;
    };
    const SweepPlan both = sweep_of("lod=1..6,nf=5..60");
    ASSERT_EQ(both.options.size(), 2U);
    EXPECT_EQ(both.options[0], (SweptOption{"lod", {"1", "2", "3", "4", "5", "6"}}));
    EXPECT_EQ(both.options[1], (SweptOption{"nf", {"5", "16", "27", "38", "49", "60"}}));
    EXPECT_EQ(both.trials(), 36U);
    EXPECT_EQ(values_of("nf=5..21..5"), (Values{"5", "10", "15", "20"}));
    EXPECT_EQ(values_of("nf=7"), Values{"7"});
    EXPECT_EQ(values_of("lod=3..3"), Values{"3"});
    EXPECT_EQ(values_of("nf=0..1000000000..1000000000"), (Values{"0", "1000000000"}));
    EXPECT_EQ(values_of("detail=0..2..0.5,lod=4"), (Values{"0", "0.5", "1", "1.5", "2"}));
    EXPECT_EQ(values_of("detail=0..1..0.1").size(), 11U);
    EXPECT_EQ(values_of("detail=0..3"), (Values{"0", "1", "2", "3"}));
    EXPECT_EQ(values_of("detail=0.5..3"), (Values{"0.5", "1", "1.5", "2", "2.5", "3"}));
    EXPECT_EQ(values_of("detail=1.5"), Values{"1.5"});
    EXPECT_EQ(values_of("min_confidence=0.5..0.9..0.2"), (Values{"0.5", "0.7", "0.9"}));
    EXPECT_EQ(values_of("wall_inset=0..0.3..0.1"), (Values{"0", "0.1", "0.2", "0.3"}));
    EXPECT_EQ(sweep_values(sweep_of("lod=1..2,min_area=10..20..10")),
              (std::vector<Values>{{"1", "10"}, {"1", "20"}, {"2", "10"}, {"2", "20"}}));
    for (const std::string wrong : {"detail=",
                                    "detail=-1..2",
                                    "detail=2..1",
                                    "detail=0..1..0",
                                    "detail=0..1000..0.1",
                                    "detail=0,detail=1",
                                    "detail=0..1..0.5..2",
                                    "detail=nan",
                                    "lod",
                                    "lod=",
                                    "lod=0..3",
                                    "lod=3..1",
                                    "nf=1..2..0",
                                    "lod=1..2..3..4",
                                    "x=1",
                                    "=1",
                                    "threads=1..2",
                                    "preview_size=400..800..400",
                                    "regularize=1",
                                    "min_confidence=0..2",
                                    "lod=1,lod=2",
                                    "lod=1..2,",
                                    "nf=1.5",
                                    "nf=0..1000000000..1",
                                    "lod=1..20..1,nf=0..30..1"})
        EXPECT_THROW((void)sweep_of(wrong), OptionError) << wrong;
}

TEST(Sweep, aSheetHoldsWhatCanBeRead) {
    EXPECT_NO_THROW(require_legible(16, 1600));
    EXPECT_NO_THROW(require_legible(17, 2000));
    EXPECT_NO_THROW(require_legible(1, 200));
    EXPECT_EQ(refusal_of_all({"-sweep", "lod=1..6,nf=5..60", "-preview", "p.png", "in.tif"}), "(no error)");
    EXPECT_EQ(legible_side(36), 2400);
    EXPECT_EQ(legible_side(37), 2800);
    EXPECT_EQ(refusal_of_all(
                  {"-sweep", "lod=1..6,nf=5..60", "-preview", "p.png", "-preview_size", "1600", "in.tif"}),
              "-sweep names 36 trials, and a picture of 1600 pixels has room for 16 that can be read; name "
              "fewer values, or give -preview_size 2400.");
    EXPECT_EQ(
        refusal_of_all({"-sweep", "lod=1..2", "-preview", "p.png", "-preview_size", "300", "in.tif"}),
        "-sweep names 2 trials, and a picture of 300 pixels has room for 1 that can be read; name fewer "
        "values, or give -preview_size 800.");
    EXPECT_EQ(refusal_of_all({"-sweep", "lod=1..6,nf=5..60", "in.tif"}), "(no error)");
    EXPECT_EQ(refusal_of_all(
                  {"-sweep", "lod=1..6,nf=5..60", "-preview", "p.png", "-preview_size", "2400", "in.tif"}),
              "(no error)");
}

TEST(Options, showFourNumbersAndLists) {
    const Request request =
        parse({"-te", "-1.5", "0", "1", "2", "-fl", "3", "4.25", "-oo", "A=1", "-oo", "B=2"});
    EXPECT_EQ(find_option("te")->show(request), "-1.5 0 1 2");
    EXPECT_EQ(find_option("fl")->show(request), "3 4.25");
    EXPECT_EQ(find_option("oo")->show(request), "A=1 B=2");
}

TEST(OptionValues, doNotDependOnTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* locale : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"})
        if (std::setlocale(LC_ALL, locale) != nullptr)
            break;
    EXPECT_EQ(parse({"-i", "2.5"}).options.levels.interval, 2.5);
    EXPECT_EQ(refusal({"-i", "2,5"}), "-i must be a number above 0, not '2,5'.");
    EXPECT_EQ(number_text(0.1), "0.1");
    std::setlocale(LC_ALL, before.c_str());
}

TEST(OptionValues, areShortestAndReadBack) {
    EXPECT_EQ(number_text(10), "10");
    EXPECT_EQ(number_text(-0.25), "-0.25");
    EXPECT_EQ(number_text(1000000), "1000000");
    EXPECT_EQ(number_text(1e300), "1e+300");
    EXPECT_EQ(read_number({}, number_text(1.0 / 3)), 1.0 / 3);
}

TEST(OptionValues, lookLikeNumbers) {
    for (const char* text : {"1", "-1", "+1", "1.", ".5", "-.5", "1e5", "1E-5", "nan", "-inf", "1e999"})
        EXPECT_TRUE(looks_like_number(text)) << text;
    for (const char* text : {"", "-", "+", "+-1", "1m", "0x10", "./1", "1,5", " 1", "1 ", "dsm.tif"})
        EXPECT_FALSE(looks_like_number(text)) << text;
}

TEST(NearestName, isTheOneThatWasMeant) {
    const Texts names{"lod", "overwrite", "quiet", "te", "b", "srcwin"};
    EXPECT_EQ(nearest_name("lodd", names), "lod");
    EXPECT_EQ(nearest_name("LOD", names), "lod");
    EXPECT_EQ(nearest_name("quite", names), "quiet");     // neighbours swapped
    EXPECT_EQ(nearest_name("over", names), "overwrite");  // a beginning
    EXPECT_EQ(nearest_name("overwite", names), "overwrite");
    EXPECT_EQ(nearest_name("scrwin", names), "srcwin");
    EXPECT_EQ(nearest_name("B", names), "b");
    EXPECT_EQ(nearest_name("x", names), "");  // any other letter is not near
    EXPECT_EQ(nearest_name("frobnicate", names), "");
}

using Case = std::pair<Texts, std::string>;

void expect_refusals(const std::vector<Case>& cases) {
    for (const auto& [arguments, message] : cases)
        EXPECT_EQ(refusal(arguments), message) << arguments.front();
}

// Found by tests/fuzz: it came through as an exception of Boost's that named all options there are.
TEST(OptionErrors, anOptionWithoutAName) {
    for (const char* option : {"-=", "--=", "-=rcwin", "--=x"})
        EXPECT_EQ(refusal({option, "a.tif", "b.gpkg"}),
                  "An option has no name before its =; dem2buildings --help_all lists all.");
}

TEST(OptionErrors, numbers) {
    for (const char* text : {"x", "nan", "inf", "-inf", "1e999", "5m", "1,5"})
        EXPECT_EQ(refusal({"-snodata", text}), std::string("-snodata must be a number, not '") + text + "'.");
    expect_refusals({{{"-b", "one"}, "-b must be a whole number from 1 to 65536, not 'one'."},
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
          "-lod cannot be used together with -fl; the listed levels replace those of -lod."},
         {{"-lod", "4", "-i", "1"}, "-lod cannot be used together with -i; the interval replaces -lod."},
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
                     {{"-frobnicate"}, "There is no option -frobnicate; dem2buildings --help_all lists all."},
                     {{"--x="}, "There is no option --x; dem2buildings --help_all lists all."},
                     {{"-5"}, "There is no option -5; dem2buildings --help_all lists all."}});
}

TEST(OptionErrors, fileNames) {
    const std::string usage = "usage: dem2buildings [options] <src_raster>... <dst_vector>.";
    EXPECT_EQ(refusal_of_all({}), "The source and the destination are missing; " + usage);
    EXPECT_EQ(refusal_of_all({"-q"}), "The source and the destination are missing; " + usage);
    EXPECT_EQ(refusal_of_all({"a.tif"}), "The destination is missing, there is only 'a.tif'; " + usage);
    EXPECT_EQ(refusal_of_all({"a", "b", "", "c"}), "A file name is empty; " + usage);
    EXPECT_EQ(refusal_of_all({"a", "b", "b"}), "The destination 'b' is the source; give another name.");
    EXPECT_EQ(
        refusal_of_all({"a", "b\nc", "d"}),
        "The name of one of several sources has a line break; rename it, or join them with gdalbuildvrt "
        "and give its mosaic.");
    EXPECT_EQ(refusal_of_all({"", "b"}), "A file name is empty; " + usage);
    EXPECT_EQ(refusal_of_all({"-", "b"}), "'-' is not a file name here; write /vsistdin/ or /vsistdout/.");
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
