#include "view/page/page_sink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <nlohmann/json.hpp>

#include "dem2buildings/error.hpp"
#include "dem2buildings/report.hpp"
#include "view/page_parts.hpp"
#include "write/write_fixture.hpp"
#include "write/zlib.hpp"

namespace d2b::view {
namespace {

using namespace test;

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Takes numbers as their description has them.
class Unpacked {
  public:
    explicit Unpacked(std::string bytes) : bytes_(std::move(bytes)) {}

    std::uint64_t take() {
        std::uint64_t number = 0;
        for (unsigned shift = 0;; shift += 7) {
            const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
            number |= std::uint64_t{byte & 0x7FU} << shift;
            if (byte < 0x80)
                return number;
        }
    }
    std::int64_t take_signed() { return signed_of(take()); }
    static std::int64_t signed_of(std::uint64_t packed) {
        const auto half = static_cast<std::int64_t>(packed / 2);
        return packed % 2 == 0 ? half : -half - 1;
    }
    [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }
    [[nodiscard]] std::string rest() const { return bytes_.substr(at_); }

  private:
    std::string bytes_;
    std::size_t at_ = 0;
};

TEST(VarintBuffer, areThoseThatWerePut) {
    std::mt19937_64 random(3);
    VarintBuffer numbers;
    std::vector<std::int64_t> put{0,
                                  -1,
                                  1,
                                  63,
                                  -64,
                                  64,
                                  std::numeric_limits<std::int64_t>::min(),
                                  std::numeric_limits<std::int64_t>::max()};
    for (int digits = 1; digits < 64; ++digits)
        put.push_back(static_cast<std::int64_t>(random() >> static_cast<unsigned>(digits)) *
                      (digits % 2 == 0 ? 1 : -1));
    for (const std::int64_t number : put)
        numbers.put_zigzag(number);
    numbers.put(300);
    EXPECT_EQ(numbers.bytes().substr(0, 4), std::string("\0\1\2\x7E", 4));  // 0, -1, 1, 63
    Unpacked unpacked(numbers.bytes());
    for (const std::int64_t number : put)
        EXPECT_EQ(unpacked.take_signed(), number);
    EXPECT_EQ(unpacked.rest(), "\xAC\x02");  // as the description of LEB128 has it
}

TEST(Base64, asTheStandardHasIt) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xFB\xFF"), "+/8=");
    EXPECT_EQ(hex_decoded("00ff1a"), std::string("\0\xFF\x1A", 3));
}

TEST(Deflated, isInflatedAgain) {
    const std::string text(100000, 'x');
    const std::string packed = writing::zlib_compressed(text);
    EXPECT_LT(packed.size(), 1000U);
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&VSIFree)> bytes(
        CPLZLibInflate(packed.data(), packed.size(), nullptr, 0, &size), &VSIFree);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(std::string(static_cast<const char*>(bytes.get()), size), text);
}

/// A house with a hole, a tier upon it and one upon that.
SurfaceBuilding house() {
    SurfaceBuilding building;
    building.id = 7;
    building.base = 1000;
    building.roof = 4000;
    building.tiers = {{1,
                       -1,
                       3000,
                       {{{0, 0, 3000}, {100, 0, 3000}, {100, 90, 3000}, {0, 90, 3000}},
                        {{10, 10, 3000}, {10, 20, 3000}, {20, 20, 3000}}}},
                      {2, 0, 5000, {{{30, 30, 5000}, {60, 30, 5000}, {60, 60, 5000}}}},
                      {3, 1, 5000, {{{40, 40, 5000}, {50, 40, 5000}, {50, 45, 5000}}}}};
    return building;
}

TEST(PageStack, asItsDescriptionSays) {
    PageStack stack;
    stack.add(house());
    SurfaceBuilding lower = house();
    lower.id = 9;
    lower.base = 990;
    lower.tiers.resize(1);
    stack.add(lower);
    EXPECT_EQ(stack.buildings(), 2);
    const auto counts = stack.counts();
    ASSERT_EQ(counts.size(), 3U);
    EXPECT_EQ(counts[0].contours, 2);
    EXPECT_EQ(counts[0].corners, 14);
    EXPECT_EQ(counts[1].contours, 3);
    EXPECT_EQ(counts[1].corners, 17);
    EXPECT_EQ(counts[2].contours, 4);
    EXPECT_EQ(counts[2].corners, 20);

    Unpacked numbers(stack.packed().bytes());
    SurfacePoint at;
    const auto expect_building = [&](const SurfaceBuilding& building, std::int64_t id, std::int64_t base) {
        EXPECT_EQ(numbers.take_signed(), building.id - id);
        EXPECT_EQ(numbers.take_signed(), building.base - base);
        EXPECT_EQ(numbers.take_signed(), building.roof - building.base);
        ASSERT_EQ(numbers.take(), building.tiers.size());
        for (std::size_t i = 0; i < building.tiers.size(); ++i) {
            const SurfaceTier& tier = building.tiers[i];
            EXPECT_EQ(numbers.take(), static_cast<std::uint64_t>(tier.level));
            EXPECT_EQ(numbers.take(), i == 0 ? 0U : 1U);
            EXPECT_EQ(numbers.take_signed(), tier.top - (i == 0 ? building.base : building.tiers[i - 1].top));
            ASSERT_EQ(numbers.take(), tier.rings.size());
            for (const auto& ring : tier.rings) {
                ASSERT_EQ(numbers.take(), ring.size());
                for (const SurfacePoint& point : ring) {
                    EXPECT_EQ(at.x += numbers.take_signed(), point.x);
                    EXPECT_EQ(at.y += numbers.take_signed(), point.y);
                }
            }
        }
    };
    expect_building(house(), 0, 0);
    EXPECT_EQ(numbers.take(), 0U);  // faces of roofs
    expect_building(lower, 7, 1000);
    EXPECT_EQ(numbers.take(), 0U);
    EXPECT_TRUE(numbers.is_at_end());
}

TEST(PageStack, hasFacesOfRoofsBehindTheTiers) {
    SurfaceBuilding building = house();
    building.tiers.resize(1);
    // A level face with a hole, and a slanted one beside it.
    const std::vector<SurfacePoint> points{{0, 0, 3000},   {60, 0, 3000},  {60, 90, 3000},
                                           {0, 90, 3000},  {10, 10, 3000}, {10, 20, 3000},
                                           {20, 20, 3000}, {100, 0, 2500}, {100, 90, 2500}};
    building.faces = {{FaceKind::roof, {0, 1, 2, 3}, {{4, 5, 6}}}, {FaceKind::roof, {1, 7, 8, 2}, {}, 0}};
    PageStack stack;
    stack.add(building, points);
    EXPECT_EQ(stack.faces().contours, 2);
    EXPECT_EQ(stack.faces().corners, 11);

    // The triangles of a divided plane count once.
    SurfaceBuilding divided = building;
    divided.faces.back().exterior = {1, 7, 8};
    divided.faces.push_back({FaceKind::roof, {1, 8, 2}, {}, 0});
    PageStack triangles;
    triangles.add(divided, points);
    EXPECT_EQ(triangles.faces().contours, 2);
    EXPECT_EQ(triangles.faces().corners, 13);

    PageStack tiers;
    building.faces.clear();
    tiers.add(building);
    EXPECT_EQ(tiers.faces().contours, 0);
    std::string as_tiers = tiers.packed().bytes();
    ASSERT_EQ(as_tiers.back(), 0);
    as_tiers.pop_back();
    ASSERT_EQ(stack.packed().bytes().substr(0, as_tiers.size()), as_tiers);

    Unpacked numbers(stack.packed().bytes().substr(as_tiers.size()));
    SurfacePoint at{20, 20, building.base};  // the last vertex of the tier, and the base
    const auto expect_ring = [&](const std::vector<std::uint32_t>& ring) {
        ASSERT_EQ(numbers.take(), ring.size());
        for (const std::uint32_t point : ring) {
            EXPECT_EQ(at.x += numbers.take_signed(), points[point].x);
            EXPECT_EQ(at.y += numbers.take_signed(), points[point].y);
            EXPECT_EQ(at.z += numbers.take_signed(), points[point].z);
        }
    };
    EXPECT_EQ(numbers.take(), 2U);
    EXPECT_EQ(numbers.take(), 2U);
    expect_ring({0, 1, 2, 3});
    expect_ring({4, 5, 6});
    EXPECT_EQ(numbers.take(), 1U);
    expect_ring({1, 7, 8, 2});
    EXPECT_TRUE(numbers.is_at_end());
}

TEST(PageRelief, isTheMeanOrTheLowest) {
    const Window window{10, 20, 1, 1602};
    for (const bool lowest : {false, true}) {
        PageRelief relief(window, lowest);
        ASSERT_EQ(relief.step(), 5);
        ASSERT_EQ(relief.cols(), 321);
        ASSERT_EQ(relief.rows(), 1);
        std::vector<float> values(1602, unknown);
        values[0] = 3;
        values[1] = 6;  // of two that are known
        values[10] = -1.5F;
        values[1600] = 2;
        values[1601] = 1;
        // Goes from right to left, as units may come.
        for (const auto& [col, cols] : {std::pair{800, 802}, std::pair{0, 800}})
            relief.write({10, 20 + col, 1, cols}, std::span(values).subspan(static_cast<std::size_t>(col),
                                                                            static_cast<std::size_t>(cols)));
        Unpacked numbers(relief.packed().bytes());
        EXPECT_EQ(Unpacked::signed_of(numbers.take() - 1), lowest ? 300 : 450);
        EXPECT_EQ(numbers.take(), 0U);
        EXPECT_EQ(Unpacked::signed_of(numbers.take() - 1), -150 - (lowest ? 300 : 450));
        for (int i = 3; i < 320; ++i)
            EXPECT_EQ(numbers.take(), 0U);
        EXPECT_EQ(Unpacked::signed_of(numbers.take() - 1), (lowest ? 100 : 150) + 150);
        EXPECT_TRUE(numbers.is_at_end());
    }
}

class PageTest : public WriteTest {
  protected:
    PageTest() {
        dem_.name = "/data/</script>.tif";
        dem_.window = {0, 0, 10, 10};
        meta_.frame.scale = {0.5 / 1024, 0.5 / 1024, 0.001};
        meta_.fields = {{"id", "Building", FieldType::integer, "", "its number"},
                        {"p90", "90 % height", FieldType::real, "m", "</script>"}};
        meta_.first_fields = {"p90"};
    }
    void SetUp() override {
        WriteTest::SetUp();
        if (page_parts() == nullptr)
            GTEST_SKIP() << "built without pages";
    }
    [[nodiscard]] writing::FileDestination place(const std::string& name, bool overwrite = false) const {
        return writing::resolve_file_target({path(name), overwrite, {}, writing::FileKind::page});
    }
    static SurfacePart part(std::int64_t id) {
        SurfacePart part;
        part.buildings.push_back(house());
        part.buildings[0].id = id;
        part.buildings[0].values = {id, 12.34567};
        return part;
    }
    /// Writes the whole file, with the third building.
    std::string written(const std::string& name) {
        const Page page = open_page(place(name), {dem_});
        page.surface->begin(meta_);
        page.surface->add(part(3));
        RunReport report;
        report.cuts = {{1, 2.5}, {2, 1.5}, {3, 0.5}};
        page.surface->take_report(report);
        page.surface->finish();
        return bytes(name);
    }

    DemInfo dem_;
    SurfaceMeta meta_;
};

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin) + begin.size();
    return text.substr(from, text.find(end, from) - from);
}

TEST_F(PageTest, namesAreTextAndNothingComesFromOutside) {
    const std::string page = written("<script>alert(1)&.html");
    EXPECT_TRUE(writing::looks_like_page(page));
    EXPECT_EQ(between(page, "<title>", "</title>"), "&lt;script&gt;alert(1)&amp;");
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_EQ(std::ranges::count(page, '@'), std::ranges::count(std::string(page_parts()->script), '@') +
                                                 std::ranges::count(std::string(page_parts()->style), '@'));
    const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\"");
    EXPECT_TRUE(policy.starts_with("default-src 'none'; script-src 'sha256-")) << policy;
    EXPECT_EQ(policy.find("unsafe"), std::string::npos);
    EXPECT_EQ(page.find(" src="), std::string::npos);
    EXPECT_EQ(page.find("<link"), std::string::npos);
    EXPECT_NE(page.find("three.js authors"), std::string::npos);
}

/// Unpacks the description of a page.
nlohmann::json about_of(const std::string& page) {
    const std::string letters = between(page, "id=\"data\">", "</script>");
    std::string packed;
    std::uint32_t bits = 0;
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < letters.size() && letters[i] != '='; ++i) {
        bits = bits << 6U | static_cast<std::uint32_t>(alphabet.find(letters[i]));
        if (i % 4 != 0)
            packed += static_cast<char>(bits >> (6 - 2 * (i % 4)) & 0xFFU);
    }
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&VSIFree)> bytes(
        CPLZLibInflate(packed.data(), packed.size(), nullptr, 0, &size), &VSIFree);
    EXPECT_TRUE(bytes);
    const std::string sections(static_cast<const char*>(bytes.get()), size);
    const auto about_size = static_cast<std::size_t>(static_cast<unsigned char>(sections[0])) +
                            256 * static_cast<std::size_t>(static_cast<unsigned char>(sections[1]));
    return nlohmann::json::parse(sections.substr(4, about_size));
}

TEST_F(PageTest, holdsWhatWasAdded) {
    const auto about = about_of(written("a.html"));
    EXPECT_EQ(about.at("title"), "a");
    EXPECT_EQ(about.at("buildings"), 1);
    EXPECT_EQ(about.at("fields").at(1).at("values").at(0), 12.346);
    EXPECT_EQ(about.at("levels").size(), 3U);
    EXPECT_EQ(about.at("levels").at(1).at("contours"), 2);
    EXPECT_EQ(about.at("levels").at(1).at("rmse"), 1.5);
    EXPECT_EQ(about.at("classes").size(), 9U);
    EXPECT_EQ(about.at("classes").at(0).at("label"), "below 3 m");
}

/// UTM: 500000 is the central meridian, 9 degrees east in zone 32; 5,540,000 m north are 50.01 degrees.
TEST_F(PageTest, saysWhatTheDataAreAndWhereTheyLie) {
    dem_.date = "2024-05-31";
    meta_.provenance.crs_wkt = Crs("EPSG:25832").wkt();
    meta_.corners = {{{499000, 5541000}, {499000, 5539000}, {501000, 5539000}, {501000, 5541000}}};
    const Page page =
        open_page(place("a.html"), {.dem = dem_, .title = "Old <town>", .credit = "City, CC BY"});
    page.surface->begin(meta_);
    page.surface->add(part(3));
    page.surface->finish();
    const std::string html = bytes("a.html");
    EXPECT_EQ(between(html, "<title>", "</title>"), "Old &lt;town&gt;");
    EXPECT_EQ(between(html, "<h1>", "</h1>"), "Old &lt;town&gt;");
    const auto about = about_of(html);
    EXPECT_EQ(about.at("credit"), "City, CC BY");
    EXPECT_EQ(about.at("date"), "2024-05-31");
    EXPECT_NEAR(about.at("position").at(0), 50.01, 0.011);
    EXPECT_NEAR(about.at("position").at(1), 9.0, 0.001);
}

TEST_F(PageTest, hasNoPositionWithoutACrs) {
    meta_.provenance.crs_wkt = "";
    EXPECT_TRUE(about_of(written("a.html")).at("position").is_null());
}

TEST_F(PageTest, isThereWholeOrNotAtAll) {
    {
        const Page page = open_page(place("a.html"), {dem_});
        page.surface->begin(meta_);
        page.surface->add(part(1));
    }
    EXPECT_EQ(entries(), Names{});
}

TEST_F(PageTest, aFileThatHasChangedMeanwhileIsLeftAlone) {
    const Page page = open_page(place("a.html"), {dem_});
    put("a.html", "of somebody else");
    page.surface->begin(meta_);
    EXPECT_NE(thrown<OutputError>([&] { page.surface->finish(); }).find("a.html"), std::string::npos);
    EXPECT_EQ(bytes("a.html"), "of somebody else");
}

TEST_F(PageTest, replacesAPageOfItsOwnAlone) {
    put("a.html", "<!DOCTYPE html>\n<p>Dear diary\n");
    EXPECT_NE(thrown<OptionError>([&] {
                  static_cast<void>(place("a.html"));
              }).find("exists; give another name, or -overwrite"),
              std::string::npos);
    EXPECT_NE(thrown<OptionError>([&] {
                  static_cast<void>(place("a.html", true));
              }).find("is not a page of dem2buildings"),
              std::string::npos);
    written("b.html");
    EXPECT_EQ(place("b.html", true).old.files.size(), 1U);
    EXPECT_EQ(thrown<OptionError>([&] { static_cast<void>(place("b.htm")); }),
              "Pages are written as HTML; give \"" + path("b.htm") + "\" a name that ends in .html.");
}

TEST_F(PageTest, isNoLongerThanBrowsersTake) {
    const Page page = open_page(place("a.html"), {dem_}, std::uint64_t{1} << 19);
    page.surface->begin(meta_);
    page.surface->add(part(1));
    const std::string said = thrown<OutputError>([&] { page.surface->finish(); });
    EXPECT_NE(said.find("would be longer than 0 MiB, which makes browsers slow; use a smaller window (-te, "
                        "-projwin or -srcwin), or fewer levels (a lower -lod)."),
              std::string::npos)
        << said;
    EXPECT_EQ(entries(), Names{});
}

TEST_F(WriteTest, pagesNeedThePartsOfTheBuild) {
    if (page_parts() != nullptr)
        GTEST_SKIP() << "built with pages";
    const DemInfo dem;
    EXPECT_EQ(
        thrown<OptionError>([&] {
            static_cast<void>(open_page(
                writing::resolve_file_target({path("a.html"), false, {}, writing::FileKind::page}), {dem}));
        }),
        "This dem2buildings was built without pages; leave -page out, or build it with -D "
        "D2B_BUILD_PAGE=ON.");
}

}  // namespace
}  // namespace d2b::view
