// Build tool: writes GLSL readers of the records in a header, and a list of their layouts.
//     scree_generate_readers RECORDS.h READERS.glsl LAYOUTS.h SHOWN
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "host/files/file.h"
#include "host/tools/record_readers.h"

int main(int count, char** values) {
    using namespace scree::host;
    const std::vector<std::string> arguments(values + 1, values + count);
    if (arguments.size() != 4) {
        std::cerr << "usage: scree_generate_readers RECORDS.h READERS.glsl LAYOUTS.h SHOWN\n";
        return 2;
    }
    try {
        const std::vector<Record> records = records_of(read_text(arguments[0]), arguments[0]);
        write_atomically(arguments[1], readers_of(records, arguments[3]));
        write_atomically(arguments[2], layouts_of(records, arguments[3]));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
