#include <gtest/gtest.h>

#include "options/provenance_text.hpp"

namespace d2b {
namespace {

TEST(SpokenDestination, leavesPasswordsOut) {
    EXPECT_EQ(redacted_destination("PG:host=gis dbname=town password=a,b user=me"),
              "PG:host=gis dbname=town password=... user=me");
    EXPECT_EQ(redacted_destination("PG:PASSWORD='my own' dbname=town"), "PG:PASSWORD=... dbname=town");
    EXPECT_EQ(redacted_destination("PG:postgresql://me:secret@gis:5432/town"),
              "PG:postgresql://me:...@gis:5432/town");
}

TEST(SpokenDestination, isTheNameWhereThereIsNone) {
    for (const char* name : {"town.gpkg", "a:b@c.gpkg", "PG:dbname=town", "PG:postgresql://me@gis/town"})
        EXPECT_EQ(redacted_destination(name), name);
}

}  // namespace
}  // namespace d2b
