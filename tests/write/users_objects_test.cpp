#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "write/geopackage/dependent_objects.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

class DependentObjects : public WriteTest {
  protected:
    void run(const std::string& statement) const { sql(path("a.gpkg"), statement, true); }
    [[nodiscard]] std::string ask(const std::string& statement) const {
        return sql(path("a.gpkg"), statement);
    }
    [[nodiscard]] WriteOptions over() const {
        WriteOptions options = to("a.gpkg");
        options.overwrite = true;
        return options;
    }
    /// Message before the work where the field `height` is going to be called otherwise.
    std::string refusal_without_height() {
        const std::string before = bytes("a.gpkg");
        LayerSpec spec = layer_spec("buildings");
        spec.fields[1].name = "tallness";
        const auto sink = open_sink(over(), callbacks_);
        const std::string message = thrown<OutputError>([&] {
            sink->preflight({&spec, 1}, provenance(), {});
        });
        EXPECT_EQ(bytes("a.gpkg"), before);
        EXPECT_EQ(entries(), std::vector<std::string>{"a.gpkg"});
        return message;
    }
    void make_view(bool registered) const {
        run("CREATE VIEW tall AS SELECT fid, id, height, geom FROM buildings WHERE height > 2");
        if (!registered)
            return;
        run("INSERT INTO gpkg_contents (table_name, data_type, identifier, srs_id) VALUES ('tall', "
            "'features', "
            "'tall', 25832)");
        run("INSERT INTO gpkg_geometry_columns VALUES ('tall', 'geom', 'MULTIPOLYGON', 25832, 0, 0)");
    }
};

TEST_F(DependentObjects, AViewStays) {
    for (const bool registered : {false, true}) {
        std::filesystem::remove(path("a.gpkg"));
        write(to("a.gpkg"), 2);
        make_view(registered);
        EXPECT_EQ(ask("SELECT COUNT(*) FROM tall"), "0");
        write(over(), 6);
        EXPECT_EQ(ask("SELECT group_concat(id) FROM tall"), "3,5") << registered;
        EXPECT_EQ(count(path("a.gpkg"), "tall"), registered ? 2 : -1);
        EXPECT_EQ(ask("SELECT COUNT(*) FROM gpkg_contents WHERE table_name = 'tall'"),
                  registered ? "1" : "0");
    }
}

TEST_F(DependentObjects, AViewOnAFieldThatIsGoneIsNamed) {
    write(to("a.gpkg"), 2);
    make_view(true);
    const auto sink = open_sink(over(), callbacks_);
    LayerSpec spec = layer_spec("buildings");
    spec.fields[1].name = "tallness";
    sink->begin({&spec, 1}, provenance());
    sink->add(0, square(1));
    const std::string message = thrown<OutputError>([&] { sink->finish(); });
    EXPECT_TRUE(message.starts_with("Cannot write \"" + path("a.gpkg") +
                                    "\": its view \"tall\" does not fit the new layers ("))
        << message;
    EXPECT_NE(message.find("height"), std::string::npos) << message;
    EXPECT_TRUE(message.ends_with("); remove it first, or write to another destination.")) << message;
}

TEST_F(DependentObjects, WhatNeedsAFieldThatIsGoneIsNamedBeforeTheWork) {
    const std::string end = "); remove it first, or write to another destination.";
    for (const auto& [what, statement] : std::vector<std::pair<std::string, std::string>>{
             {"view \"tall\"", "CREATE VIEW tall AS SELECT fid, height FROM buildings"},
             {"view \"tall\"", "CREATE VIEW tall AS SELECT fid, height FROM main.buildings"},
             {"view \"tall\"", "CREATE VIEW tall AS SELECT fid, height FROM \"Main\" . [Buildings]"},
             {"view \"upper\"",
              "CREATE VIEW upper (h) AS SELECT b.height FROM buildings b JOIN contours c ON "
              "b.id = c.id"},
             {"index \"by_height\"", "create unique index if not exists by_height ON buildings (height)"},
             {"trigger \"noted\"",
              "CREATE TRIGGER noted AFTER DELETE ON buildings BEGIN INSERT INTO journal "
              "VALUES (OLD.height); END"}}) {
        std::filesystem::remove(path("a.gpkg"));
        write(to("a.gpkg"), 2);
        run("CREATE TABLE journal (what TEXT)");
        run(statement);
        const std::string message = refusal_without_height();
        EXPECT_TRUE(message.starts_with("Cannot write \"" + path("a.gpkg") + "\": its " + what +
                                        " does not fit the new layers ("))
            << message;
        EXPECT_NE(message.find("height"), std::string::npos) << message;
        EXPECT_TRUE(message.ends_with(end)) << message;
    }
}

TEST(WithoutDatabase, TakesItOffTheNamesOfTablesAlone) {
    const std::vector<std::string> tables{"buildings", "a b"};
    for (const auto& [sql, bare] : std::vector<std::pair<std::string, std::string>>{
             {"SELECT x FROM main.buildings", "SELECT x FROM buildings"},
             {"SELECT x FROM \"Main\" . [Buildings], `main`.'a b'", "SELECT x FROM [Buildings], 'a b'"},
             {"SELECT main.x FROM main.buildings main", "SELECT main.x FROM buildings main"},
             {"SELECT 'main.buildings', domain.buildings, main.buildings2 FROM main",
              "SELECT 'main.buildings', domain.buildings, main.buildings2 FROM main"},
             {"SELECT 'it''s main.buildings', \"a", "SELECT 'it''s main.buildings', \"a"},
             {"main.", "main."}})
        EXPECT_EQ(writing::strip_database_name(sql, tables), bare);
}

TEST_F(DependentObjects, AViewOnAViewIsLookedAtToo) {
    write(to("a.gpkg"), 2);
    make_view(true);
    run("CREATE VIEW taller AS SELECT * FROM tall WHERE height > 9");
    EXPECT_NE(refusal_without_height().find("its view \"tall\" does not fit"), std::string::npos);
}

TEST_F(DependentObjects, AViewOnAnotherLayerIsNoReason) {
    write(to("a.gpkg"), 2);
    run("CREATE VIEW high AS SELECT height FROM contours");
    LayerSpec spec = layer_spec("buildings");
    spec.fields[1].name = "tallness";
    const auto sink = open_sink(over(), callbacks_);
    sink->preflight({&spec, 1}, provenance(), {});
}

TEST_F(DependentObjects, LayerOptionsCount) {
    write(to("a.gpkg"), 2);
    make_view(false);
    const LayerSpec spec = layer_spec("buildings");
    WriteOptions options = over();
    options.layer_options = {"GEOMETRY_NAME=shape"};
    const auto sink = open_sink(options, callbacks_);
    const std::string message = thrown<OutputError>([&] { sink->preflight({&spec, 1}, provenance(), {}); });
    EXPECT_NE(message.find("its view \"tall\" does not fit the new layers ("), std::string::npos) << message;
}

TEST_F(DependentObjects, AViewThatNeverWorkedIsNoReason) {
    write(to("a.gpkg"), 2);
    run("CREATE VIEW broken AS SELECT absent FROM nowhere");
    write(over(), 3);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 3);
    EXPECT_EQ(ask("SELECT COUNT(*) FROM sqlite_master WHERE name = 'broken'"), "1");
}

TEST_F(DependentObjects, TriggersAndIndicesStay) {
    write(to("a.gpkg"), 2);
    run("CREATE TABLE journal (what TEXT)");
    run("CREATE TRIGGER noted AFTER UPDATE OF height ON buildings BEGIN INSERT INTO journal VALUES (NEW.id); "
        "END");
    run("CREATE INDEX by_height ON buildings (height)");
    const std::string triggers = ask("SELECT COUNT(*) FROM sqlite_master WHERE type = 'trigger'");
    for (int times = 0; times < 2; ++times)
        write(over(), 3);
    EXPECT_EQ(ask("SELECT COUNT(*) FROM sqlite_master WHERE type = 'trigger'"), triggers);
    EXPECT_EQ(ask("SELECT COUNT(*) FROM sqlite_master WHERE name = 'by_height'"), "1");
    EXPECT_EQ(ask("SELECT COUNT(*) FROM journal"), "0");
    run("UPDATE buildings SET height = 7 WHERE id = 3");
    EXPECT_EQ(ask("SELECT what FROM journal"), "3");
}

TEST_F(DependentObjects, ATriggerOnAFieldThatIsGoneIsNamed) {
    write(to("a.gpkg"), 2);
    run("CREATE TABLE journal (what TEXT)");
    run("CREATE TRIGGER noted AFTER UPDATE ON buildings BEGIN INSERT INTO journal VALUES (NEW.height); END");
    const auto sink = open_sink(over(), callbacks_);
    LayerSpec spec = layer_spec("buildings");
    spec.fields[1].name = "tallness";
    sink->begin({&spec, 1}, provenance());
    const std::string message = thrown<OutputError>([&] { sink->finish(); });
    EXPECT_NE(message.find("its trigger \"noted\" does not fit the new layers ("), std::string::npos)
        << message;
}

TEST_F(DependentObjects, RelationsAndForeignKeysAreRefused) {
    write(to("a.gpkg"), 2);
    const auto refusal = [&] {
        return thrown<OptionError>([&] { static_cast<void>(open_sink(over(), callbacks_)); });
    };
    const std::string end =
        "\" on layer \"buildings\", which -overwrite would break; remove it first, or write to another "
        "destination.";
    run("CREATE TABLE owners (name TEXT, building INTEGER REFERENCES buildings (fid))");
    EXPECT_EQ(refusal(), "\"" + path("a.gpkg") + "\" has a foreign key of table \"owners" + end);
    std::filesystem::remove(path("a.gpkg"));
    write(to("a.gpkg"), 2);
    run("CREATE TABLE gpkgext_relations (id INTEGER PRIMARY KEY, base_table_name TEXT NOT NULL, "
        "base_primary_column "
        "TEXT NOT NULL DEFAULT 'id', related_table_name TEXT NOT NULL, related_primary_column TEXT NOT NULL "
        "DEFAULT "
        "'id', relation_name TEXT NOT NULL, mapping_table_name TEXT NOT NULL UNIQUE)");
    run("CREATE TABLE owned (base_id INTEGER, related_id INTEGER)");
    run("INSERT INTO gpkgext_relations VALUES (1, 'buildings', 'fid', 'owners', 'id', 'simple_attributes', "
        "'owned')");
    EXPECT_EQ(refusal(), "\"" + path("a.gpkg") + "\" has a relation \"owned" + end);
    WriteOptions more = to("a.gpkg");
    more.append = true;
    EXPECT_EQ(write(more, 1), 3);
}

}  // namespace

}  // namespace d2b::test
