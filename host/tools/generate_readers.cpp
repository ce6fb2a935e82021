// Build tool: writes GLSL readers of the records in headers, the names of the offsets of tables, and a list of layouts.
//     scree_generate_readers READERS.glsl LAYOUTS.h SHOWN RECORDS.h...
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "host/files/file.h"
#include "host/tools/record_readers.h"
#include "shaders/stages/lib/tables.h"

namespace {

// Of each table of words or quads: ages_offset is table_offsets[2].x of the parameters; likewise of earlier contents.
std::string offset_names() {
    std::string text;
    std::size_t place = 0;
    const auto add = [&](const std::string& table) {
        text += "#define " + table + "_offset table_offsets[" + std::to_string(place / 4) + "]." + "xyzw"[place % 4] + "\n";
        ++place;
    };
#define SCREE_NAME(buffer, name, block, record, length) add(#name);
    SCREE_WORD_TABLES(SCREE_NAME)
    SCREE_QUAD_TABLES(SCREE_NAME)
#undef SCREE_NAME
#define SCREE_VIEW(table, view) text += "#define " #view "_offset " #table "_offset\n";
    SCREE_VIEWS(SCREE_VIEW)
#undef SCREE_VIEW
    return text;
}

}  // namespace

int main(int count, char** values) {
    using namespace scree::host;
    const std::vector<std::string> arguments(values + 1, values + count);
    if (arguments.size() < 4) {
        std::cerr << "usage: scree_generate_readers READERS.glsl LAYOUTS.h SHOWN RECORDS.h...\n";
        return 2;
    }
    try {
        std::vector<Record> records;
        for (std::size_t i = 3; i < arguments.size(); ++i) add_records(records, read_text(arguments[i]), arguments[i]);
        write_atomically(arguments[0], readers_of(records, arguments[2]) + offset_names());
        write_atomically(arguments[1], layouts_of(records, arguments[2]));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
