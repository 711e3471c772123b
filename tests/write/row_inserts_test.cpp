#include <array>

#include "dem2buildings/error.hpp"
#include "write/geopackage/spatial_index.hpp"
#include "write/sql.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {
namespace {

/// Both ways: whether SQLite is the copy that the library runs on depends on how GDAL was built.
class RowInsertsTest : public WriteTest, public testing::WithParamInterface<bool> {
  protected:
    void SetUp() override {
        WriteTest::SetUp();
        write(to("a.gpkg"), 1);
        dataset_ = open_dataset(path("a.gpkg"), true);
        sql_run(dataset_.get(), "CREATE TABLE t (a INTEGER PRIMARY KEY, b BLOB, c INTEGER)");
    }
    [[nodiscard]] RowInserts rows() const {
        return {dataset_.get(), GetParam() ? sqlite_handle(dataset_.get()) : nullptr, target_,
                "INSERT INTO t VALUES", "filling a table"};
    }
    [[nodiscard]] std::string value(const std::string& sql) const {
        return sql_value(dataset_.get(), sql).value_or("none");
    }

    Dataset dataset_;
    WriteTarget target_{.name = "a.gpkg", .hidden_folder = ""};
};

TEST_P(RowInsertsTest, AreAsTheyWereGiven) {
    constexpr std::int64_t large = 5'000'000'000;
    const std::vector<std::byte> long_one(5000, std::byte{0xA7});
    const std::array<std::byte, 3> bytes{std::byte{0}, std::byte{0x1F}, std::byte{0xFF}};
    RowInserts inserts = rows();
    inserts.add({large, std::span(bytes), std::int64_t{-1}});
    for (std::int64_t i = 0; i < 50; ++i)  // in text more than a statement
        inserts.add({i, std::span(long_one), 2 * i});
    inserts.finish();
    EXPECT_EQ(value("SELECT COUNT(*) FROM t"), "51");
    EXPECT_EQ(value("SELECT hex(b) || c FROM t WHERE a = 5000000000"), "001FFF-1");
    EXPECT_EQ(value("SELECT COUNT(*) FROM t WHERE b = CAST(replace(hex(zeroblob(2500)), '00', x'A7A7') AS "
                    "BLOB) AND c = 2 * a"),
              "50");
    EXPECT_EQ(value("SELECT group_concat(DISTINCT typeof(a) || typeof(b) || typeof(c)) FROM t"),
              "integerblobinteger");
}

/// GDAL does not say why without all of the statement.
TEST_P(RowInsertsTest, ARowThatIsRefusedIsAnError) {
    EXPECT_EQ(thrown<OutputError>([&] {
                  RowInserts inserts = rows();
                  inserts.add({std::int64_t{1}, std::span<const std::byte>(), std::int64_t{1}});
                  inserts.add({std::int64_t{1}, std::span<const std::byte>(), std::int64_t{2}});
                  inserts.finish();
              }),
              std::string("Cannot write \"a.gpkg\": filling a table failed (") +
                  (GetParam() ? "UNIQUE constraint failed: t.a" : "GDAL gives no reason") + ").");
}

TEST_P(RowInsertsTest, ATableThatIsNotThereIsAnError) {
    sql_run(dataset_.get(), "DROP TABLE t");
    EXPECT_EQ(thrown<OutputError>([&] {
                  RowInserts inserts = rows();
                  inserts.add({std::int64_t{1}});
                  inserts.finish();
              }),
              std::string("Cannot write \"a.gpkg\": filling a table failed (") +
                  (GetParam() ? "no such table: t" : "GDAL gives no reason") + ").");
}

INSTANTIATE_TEST_SUITE_P(BoundOrText, RowInsertsTest, testing::Bool());

}  // namespace
}  // namespace d2b::test
