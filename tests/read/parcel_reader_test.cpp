#include "read/parcel_reader.hpp"

#include <random>

#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "read/rasters.hpp"
#include "support/error_of.hpp"
#include "support/vector_file.hpp"

namespace d2b::reading {
namespace {

using namespace test;

std::vector<ParcelCell> burnt(const std::vector<PixelParcel>& parcels, const Window& part) {
    std::vector<ParcelCell> cells(static_cast<std::size_t>(part.points()));
    for (const PixelParcel& parcel : parcels)
        burn(parcel, part, cells);
    return cells;
}

std::string drawn(const std::vector<ParcelCell>& cells, std::size_t cols) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        text += cells[i].parcel == ParcelCell::no_parcel ? '.' : static_cast<char>('0' + cells[i].parcel);
        if ((i + 1) % cols == 0)
            text += ' ';
    }
    return text;
}

PixelParcel polygon(std::int64_t number, const WorldRing& ring) {
    return {number, true, {{ring}}, {}};
}

TEST(ParcelCells, AreThoseWhoseMiddlesArePassed) {
    // To 0.4 of the third column: its middle is outside. To 0.6 of the second row: inside.
    const PixelParcel one = polygon(1, {{0, 0}, {2.4, 0}, {2.4, 1.6}, {0, 1.6}, {0, 0}});
    EXPECT_EQ(drawn(burnt({one}, {0, 0, 3, 4}), 4), "11.. 11.. .... ");
    PixelParcel hole = one;
    hole.polygons[0].push_back({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
    EXPECT_EQ(drawn(burnt({hole}, {0, 0, 3, 4}), 4), ".1.. 11.. .... ");
    const auto both = burnt({one, polygon(2, {{1, 0}, {4, 0}, {4, 3}, {1, 3}, {1, 0}})}, {0, 0, 3, 4});
    EXPECT_EQ(drawn(both, 4), "1122 1122 .222 ");
    EXPECT_TRUE(both[1].several);
    EXPECT_FALSE(both[0].several || both[2].several);
}

TEST(ParcelCells, LinesPartTheMiddlesThatTheyPassBetween) {
    PixelParcel line;
    line.lines = {{{1.2, -1}, {1.2, 1.2}, {5, 1.2}}};
    const auto cells = burnt({line}, {0, 0, 3, 3});
    std::string right;
    std::string below;
    for (const ParcelCell& cell : cells) {
        right += cell.cut_right ? '|' : ' ';
        below += cell.cut_below ? '_' : ' ';
        EXPECT_EQ(cell.parcel, ParcelCell::no_parcel);
    }
    EXPECT_EQ(right, "|        ");
    EXPECT_EQ(below, " __      ");
}

/// Triangles around a place in the middle share edges only.
TEST(ParcelCells, NeighboursLeaveOutNoCellAndShareNone) {
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        const auto any = [&] { return static_cast<double>(random() % 160) / 8; };
        const Position middle{any(), any()};
        const WorldRing corners{{-1, -1}, {21, -1}, {21, 21}, {-1, 21}, {-1, -1}};
        std::vector<PixelParcel> parcels;
        for (std::size_t i = 0; i < 4; ++i)
            parcels.push_back(polygon(static_cast<std::int64_t>(i),
                                      i % 2 == 0
                                          ? WorldRing{middle, corners[i], corners[i + 1], middle}
                                          : WorldRing{corners[i + 1], corners[i], middle, corners[i + 1]}));
        const auto cells = burnt(parcels, {0, 0, 20, 20});
        for (const ParcelCell& cell : cells) {
            EXPECT_NE(cell.parcel, ParcelCell::no_parcel);
            EXPECT_FALSE(cell.several);
        }
        // A part of the window says the same.
        const auto part = burnt(parcels, {7, 5, 6, 9});
        for (std::int32_t r = 0; r < 6; ++r)
            for (std::int32_t c = 0; c < 9; ++c)
                EXPECT_EQ(part[static_cast<std::size_t>(r * 9 + c)].parcel,
                          cells[static_cast<std::size_t>((r + 7) * 20 + c + 5)].parcel);
    }
}

class ParcelReaderTest : public ReadTest {
  protected:
    std::unique_ptr<ParcelSource> read_from(ParcelChoice choice = {}) {
        choice.dataset = path("p.gpkg");
        return open_parcels(choice, metre_grid(), callbacks_);
    }
    template <typename E>
    std::string refusal(const ParcelChoice& choice = {}) {
        return error_of<E>([&] { static_cast<void>(read_from(choice)); });
    }
    std::vector<std::string> heard_of_;
    Callbacks callbacks_ = [this] {
        Callbacks callbacks;
        callbacks.on_warning = [this](const std::string& text) { heard_of_.push_back(text); };
        return callbacks;
    }();
};

constexpr const char* west =
    "POLYGON((500000 5700000,500010 5700000,500010 5700020,500000 5700020,500000 5700000))";
constexpr const char* east =
    "POLYGON((500010 5700000,500020 5700000,500020 5700020,500010 5700020,500010 5700000))";

TEST_F(ParcelReaderTest, saysWhoseACellIs) {
    write_layer(path("p.gpkg"),
                {"parcels", {{west, 7.5}, {east}, {"LINESTRING(500005 5699990,500005 5700030)"}}});
    const auto parcels = read_from();
    std::vector<ParcelCell> cells(4 * 20);
    parcels->read({8, 0, 4, 20}, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        EXPECT_EQ(cells[i].parcel, i % 20 < 10 ? 1 : 2);
        EXPECT_EQ(cells[i].cut_right, i % 20 == 4);
    }
    EXPECT_EQ(parcels->name(2), "2");
    EXPECT_EQ(parcels->name(ParcelCell::no_parcel), "");
    const auto named = read_from({.dataset = "", .layer = "parcels", .field = "height"});
    EXPECT_EQ(named->name(1), "7.5");  // not read before
    EXPECT_EQ(named->name(2), "");
    EXPECT_TRUE(heard_of_.empty());
}

/// Parcels in longitude and latitude; a metre is 1.4e-5 degrees of longitude there.
TEST_F(ParcelReaderTest, bringsThemToTheCrsOfTheDem) {
    write_layer(path("p.gpkg"),
                {"parcels", {{"POLYGON((8.9 51.4,9.000143 51.4,9.000143 51.5,8.9 51.5,8.9 51.4))"}}, 4326});
    const auto parcels = read_from();
    std::vector<ParcelCell> cells(20 * 20);
    parcels->read({0, 0, 20, 20}, cells);
    EXPECT_EQ(cells[5].parcel, 1);
    EXPECT_EQ(cells[14].parcel, ParcelCell::no_parcel);
}

TEST_F(ParcelReaderTest, takesSurfacesOfValidPolygons) {
    const std::string ring = "((500000 5700000,500020 5700000,500020 5700020,500000 5700020,500000 5700000))";
    const std::string triangle = "((500000 5700000,500020 5700000,500020 5700020,500000 5700000))";
    const std::string crossed =
        "((500000 5700000,500020 5700020,500020 5700000,500000 5700020,500000 5700000))";
    for (const auto& [wkt, valid] :
         {std::pair("POLYHEDRALSURFACE(" + ring + ")", true), std::pair("TIN(" + triangle + ")", true),
          std::pair("POLYHEDRALSURFACE(" + crossed + ")", false)}) {
        write_layer(path("p.gpkg"), {"parcels", {{wkt}}});
        std::vector<ParcelCell> cells(20 * 20);
        read_from()->read({0, 0, 20, 20}, cells);
        EXPECT_EQ(cells[10 * 20 + 17].invalid, !valid) << wkt;
        EXPECT_EQ(cells[10 * 20 + 17].parcel, 1) << wkt;
        VSIUnlink(path("p.gpkg").c_str());
    }
}

TEST_F(ParcelReaderTest, knowsWhatIsNotValid) {
    write_layer(
        path("p.gpkg"),
        {"parcels",
         {{"POLYGON((500000 5700000,500020 5700020,500020 5700000,500000 5700020,500000 5700000))"}}});
    std::vector<ParcelCell> cells(20 * 20);
    read_from()->read({0, 0, 20, 20}, cells);
    EXPECT_TRUE(cells[10 * 20 + 1].invalid);
    EXPECT_EQ(cells[10].parcel, ParcelCell::no_parcel);
}

TEST_F(ParcelReaderTest, refusesWhatItCannotTake) {
    EXPECT_TRUE(
        refusal<InputError>().starts_with("The parcel dataset " + quoted("p.gpkg") + " cannot be opened: "));
    write_layer(path("p.gpkg"), {"parcels", {{west}}});
    EXPECT_EQ(refusal<OptionError>({.dataset = "", .layer = "roads", .field = ""}),
              "The parcel dataset " + quoted("p.gpkg") + " has no layer 'roads'; it has 'parcels'.");
    EXPECT_EQ(refusal<OptionError>({.dataset = "", .layer = "", .field = "lot"}),
              "The layer 'parcels' of the parcel dataset " + quoted("p.gpkg") +
                  " has no field 'lot' for -split_field; its fields are 'height'.");
    write_layer(path("p.gpkg"),
                {"far", {{"POLYGON((600000 5700000,600010 5700000,600010 5700010,600000 5700000))"}}});
    write_layer(path("p.gpkg"), {"trees", {{"POINT(500005 5700005)"}}});
    for (const std::string name : {"far", "trees"})
        EXPECT_EQ(
            refusal<InputError>({.dataset = "", .layer = name, .field = ""}),
            "The layer '" + name + "' of the parcel dataset " + quoted("p.gpkg") +
                " has no polygon and no line in the part of 'dem.tif' that is used; give the parcels of "
                "the same place, or another layer with -split_layer.");
    static_cast<void>(read_from());
    ASSERT_EQ(heard_of_.size(), 1U);
    EXPECT_EQ(heard_of_[0], "The parcel dataset " + quoted("p.gpkg") +
                                " has the layers 'parcels', 'far' and 'trees'; 'parcels' is taken, and "
                                "-split_layer takes another.");
}

}  // namespace
}  // namespace d2b::reading
