// Lasting tables are declared once: what moves their records goes through the lists of shaders/stages/lib/tables.h.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "compute/plan/plan.h"
#include "compute/tables/lasting.h"
#include "tests/house/tree.h"

namespace {

using namespace scree;

std::string name_of(Table table) {
    return table_infos()[static_cast<std::size_t>(table)].name;
}

std::set<std::string> words_of(const std::string& code) {
    static const std::regex word("[A-Za-z_]\\w*");
    return {std::sregex_token_iterator(code.begin(), code.end(), word), std::sregex_token_iterator()};
}

// The lists in braces of a file that name most tables of rows.
bool lists_rows(const std::string& code) {
    static const std::regex braces("\\{[^{};]*\\}");
    return std::any_of(std::sregex_token_iterator(code.begin(), code.end(), braces), std::sregex_token_iterator(),
                       [](const std::string& list) {
                           const std::set<std::string> words = words_of(list);
                           const auto is_named = [&](Table table) { return words.contains(name_of(table)); };
                           return std::count_if(row_tables.begin(), row_tables.end(), is_named) >= 5;
                       });
}

}  // namespace

TEST_CASE("house: no file lists the lasting tables of rows by hand", "[house]") {
    CHECK(lists_rows("fetch({properties, poses, velocities, sleep_states, strains});"));
    CHECK_FALSE(lists_rows("fetch({properties, poses, velocities});"));
    for (const house::SourceFile& file : house::code_files())
        if (file.in("compute/") && lists_rows(house::without_comments(file.text)))
            FAIL_CHECK(house::at(file, 1, "lists them by hand; row_tables has them all"));
}

// So two files declare a new one, and its law's shader and loop use it: tests/house/add_table adds one. strains are of a law of
// two stages, and have a value at the start.
TEST_CASE("house: a lasting table of rows is named by its declarations and by the law that uses it", "[house]") {
    std::set<std::string> naming;
    for (const house::SourceFile& file : house::code_files())
        if (!file.in("tests/") && words_of(house::without_comments(file.text)).contains("strains")) naming.insert(file.path);
    CHECK(naming == std::set<std::string>{"shaders/stages/lib/tables.h", "compute/plan/stage_declarations.cpp",
                                          "shaders/stages/bodies/find_broken.comp", "shaders/stages/bodies/break_bodies.comp",
                                          "compute/cpu/fracture.cpp", "compute/compile/scene_compiler.cpp",
                                          "compute/compile/state_editor.cpp"});
}

TEST_CASE("house: what the plan makes last of rows and contacts is declared so", "[house]") {
    const std::vector<Table>& lasting = lasting_tables();
    const auto lasts = [&](Table table) { return std::find(lasting.begin(), lasting.end(), table) != lasting.end(); };
    for (const Table table : row_tables) {
        INFO(name_of(table));
        CHECK(lasts(table));
    }
    for (const Table table : contact_tables) {
        INFO(name_of(table));
        CHECK(lasts(other_parity(table)));
    }
    for (const Table table : lasting) {
        const BufferLength length = table_infos()[static_cast<std::size_t>(table)].length;
        INFO(name_of(table));
        if (length == BufferLength::bodies) CHECK((is_of_rows(table) || table == Table::ids));
        if (length == BufferLength::contacts || length == BufferLength::impacts) CHECK(is_of_contacts(other_parity(table)));
    }
}
